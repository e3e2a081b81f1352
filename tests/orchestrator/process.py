"""The command as a process of its own, from this tree."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
_CODE = "import sys; from orchestrator.cli.main import main; sys.argv[0] = 'bladeloss'; main()"


def command(*arguments, env=(), code=_CODE, **options):
    """Start ``bladeloss`` with these arguments."""
    return subprocess.Popen(
        [sys.executable, "-c", code, *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "200", **dict(env)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


def done(*arguments, timeout=60.0, **options):
    """Wait for its end; return exit status, stdout and stderr."""
    process = command(*arguments, **options)
    try:
        said, errors = process.communicate(timeout=timeout)
    finally:
        process.kill()
    return process.returncode, said, errors
