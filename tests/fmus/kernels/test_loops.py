"""Compiled loops: what is kept of them may be damaged, or not be written at all."""

import importlib.util
import sys

import pytest

from fmus.kernels.kept import KeptFile

SOURCE = """
from fmus.kernels.loops import compiled

@compiled
def twice(value):
    return 2.0 * value
"""


def twice_of(folder):
    """The function as a new process would import it."""
    sys.modules.pop("kept_example", None)
    spec = importlib.util.spec_from_file_location("kept_example", folder / "kept_example.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.twice


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "kept_example.py").write_text(SOURCE)
    return tmp_path


def test_code_that_is_kept_damaged_is_compiled_anew(folder):
    assert twice_of(folder)(1.5) == 3.0
    kept = [path for path in (folder / "__pycache__").iterdir() if path.suffix in (".nbi", ".nbc")]
    assert len(kept) == 2
    for path in kept:
        path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    again = twice_of(folder)
    assert again(1.5) == 3.0
    assert sum(again.stats.cache_misses.values()) == 1
    assert sum(twice_of(folder).stats.cache_misses.values()) == 0


def test_a_full_disk_does_not_matter(folder, monkeypatch):
    def full(self, key, data):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(KeptFile, "save", full)
    assert twice_of(folder)(1.5) == 3.0


def test_code_is_renewed_with_the_file_of_a_compiled_function_that_it_calls(folder, monkeypatch):
    calls = "from fmus.kernels.loops import compiled\nfrom kept_example import twice\n\n\n"
    calls += "@compiled\ndef more(value):\n    return twice(value) + 1.0\n"
    (folder / "kept_caller.py").write_text(calls)
    monkeypatch.syspath_prepend(folder)

    def more(value):
        for name in ("kept_example", "kept_caller"):
            sys.modules.pop(name, None)
        importlib.invalidate_caches()
        return importlib.import_module("kept_caller").more(value)

    assert more(1.5) == 4.0
    source = folder / "kept_example.py"
    source.write_text(source.read_text().replace("2.0 * value", "40.0 * value"))
    assert more(1.5) == 61.0
