"""What a host without Python of its own needs to find this one: FMI tools that are native programs."""

import os
import sys
import sysconfig
from pathlib import Path


def libpython() -> Path | None:
    """The shared library of this very Python, which such a host needs in its process; None without one."""
    names = [sysconfig.get_config_var(key) for key in ("INSTSONAME", "LDLIBRARY")]
    folders = [sysconfig.get_config_var(key) for key in ("LIBDIR", "LIBPL")]
    for name in filter(None, names):
        for folder in filter(None, folders):
            if ".so" in name and (path := Path(folder) / name).is_file():
                return path
    return None


def environment(*more: str) -> dict[str, str]:
    """The environment of such a host: libpython preloaded, this Python's packages, folders besides."""
    installed = [path for path in sys.path if path.endswith("site-packages")]
    return os.environ | {
        "LD_PRELOAD": str(libpython() or ""),
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": os.pathsep.join([*more, *installed]),
        "OPENBLAS_NUM_THREADS": "1",
    }
