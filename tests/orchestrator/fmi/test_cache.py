"""What has not been used for long leaves the user's cache, and nothing else does."""

import os
import time

import pytest

from orchestrator.fmi.cache import prune, used
from tests.faults import fault

DAY = 86400.0


@pytest.fixture
def cache(tmp_path):
    """Six FMUs of 1000 bytes, from the oldest to one of today, and packages of two ages."""
    folder = tmp_path / "bladeloss" / "fmus"
    folder.mkdir(parents=True)
    for days in (0, 2, 4, 6, 8, 10):
        file = folder / f"rotor_a-{days:016x}.fmu"
        file.write_bytes(bytes(1000))
        os.utime(file, (0, time.time() - days * DAY))
    for name, days in (("fmus-" + "a" * 32, 10), ("rotor_fmu-" + "b" * 32, 40), ("of-the-user", 400)):
        (folder.parent / name).mkdir()
        os.utime(folder.parent / name, (0, time.time() - days * DAY))
    return folder


def left(folder):
    return sorted(int(path.stem[-16:], 16) for path in folder.glob("rotor_a-*.fmu"))


@fault(
    "machine",
    "a cache of FMUs that grows with every train and every version",
    "those used longest ago are removed, none of the last day, no file of another name",
    guard="orchestrator.fmi.cache:prune",
)
def test_the_longest_unused_go_first(cache):
    for name in ("mine.fmu", "rotor_a.fmu"):
        (cache / name).write_bytes(bytes(9000))
        os.utime(cache / name, (0, 0))
    prune(cache, 3000)
    assert left(cache) == [0, 2, 4] and (cache / "mine.fmu").exists() and (cache / "rotor_a.fmu").exists()
    assert {path.name[:9] for path in cache.parent.iterdir()} == {"fmus", "fmus-aaaa", "of-the-us"}


def test_what_a_run_is_about_to_load_stays(cache):
    used([cache / f"rotor_a-{10:016x}.fmu"])
    prune(cache, 0)
    assert left(cache) == [0, 10]


def test_a_cache_that_is_not_there(tmp_path):
    prune(tmp_path / "none" / "fmus")
