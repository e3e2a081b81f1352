"""Instances that are freed are gone: no memory, no Python object, no file; and a process ends cleanly."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.marks import slow

REPOSITORY = Path(__file__).parents[2]

CYCLES = """
import gc, sys
from pathlib import Path
from fmus.unit.slave import UnitSlave
from tests.fmus.host import Host

def resident():
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 1e6

host, sizes = Host(Path(sys.argv[1]), Path(sys.argv[2])), []
for cycle in range(20):
    instances = [host.open(f"unit{k}").start() for k in range(3)]
    for instance in instances:
        for step in range(5):
            assert instance.step(step * 1e-4, 1e-4), instance.said
        instance.restore(instance.state())
        instance.close()
    gc.collect()
    sizes.append(resident())
    alive = sum(isinstance(o, UnitSlave) for o in gc.get_objects())
    assert alive == 0, f"{alive} instances are alive after cycle {cycle}"
print(sizes)
steps = sorted(after - before for before, after in zip(sizes[9:], sizes[10:]))
print(steps[len(steps) // 2])
"""

UNTIDY = """
import sys
from pathlib import Path
from tests.fmus.host import Host
host = Host(Path(sys.argv[1]), Path(sys.argv[2]))
instances = [host.open(f"unit{k}").start() for k in range(3)]
sys.exit(3)
"""


def call(script, *arguments):
    command = [sys.executable, "-c", script, *map(str, arguments)]
    return subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("name", ["rotor_small.fmu", slow("bearing_v1.fmu")])
def test_twenty_cycles_of_load_and_free_do_not_grow(name, built, tmp_path):
    """Median growth of the resident memory from cycle to cycle, in MB.

    What is not freed is missing after every cycle.  The allocator asks the system for some MB at once
    now and then, at any cycle: the difference of two cycles says nothing.
    """
    done = call(CYCLES, built[name], tmp_path / "unzipped")
    assert done.returncode == 0, done.stdout + done.stderr
    assert float(done.stdout.splitlines()[-1]) < 0.05, done.stdout


def test_a_process_that_frees_nothing_ends_with_its_own_status(built, tmp_path):
    """And not with an abort: pythonfmu's library would free its state twice at exit."""
    done = call(UNTIDY, built["bearing_v3.fmu"], tmp_path / "unzipped")
    assert done.returncode == 3, done.stderr


def test_the_library_gives_up_its_state_at_exit(hosts):
    """One handler for each library, however many instances."""

    def libraries():
        loaders = [m for n, m in sys.modules.items() if n.startswith("bladeloss_loader_")]
        return {p for m in loaders for p in m._let_go if "bearing_v3" in p.name}

    hosts["bearing_v3.fmu"].open().start().close()
    first = libraries()
    hosts["bearing_v3.fmu"].open().start().close()
    assert {p.suffix for p in first} == {".so"}
    assert libraries() == first
