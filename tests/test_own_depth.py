"""A depth that one file adds is everywhere: FMU, scenario, command line, figures, a run.

Each test runs in a process of its own, so that no other test knows of the depth.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.marks import slow

ROOT = Path(__file__).parents[1]
_PREFIX = "import sys; import tests.spring_film as added; "


def in_a_process(code: str, *arguments: str, folder: Path) -> str:
    """What code says that knows the added depth."""
    done = subprocess.run(
        [sys.executable, "-c", _PREFIX + code, *arguments],
        capture_output=True,
        text=True,
        cwd=folder,
        env={"PYTHONPATH": str(ROOT), "PATH": "", "XDG_CACHE_HOME": str(folder), "COLUMNS": "120"},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


MAIN = "from orchestrator.cli.main import main; main()"


def test_the_command_line_lists_it(tmp_path):
    from bearing_fmu import depths

    for command in ("run", "modes"):
        assert "|".join((*depths.names(), "spring")) in in_a_process(MAIN, command, "--help", folder=tmp_path)
    assert "spring spring and damper" in " ".join(
        in_a_process(MAIN, "run", "--help", folder=tmp_path).replace("│", " ").split()
    )


def test_scenarios_take_it_and_name_it_among_the_allowed(tmp_path):
    from bearing_fmu import depths

    said = in_a_process(
        """
from orchestrator.errors import ScenarioError
from orchestrator.scenario.file import load_scenario
print(load_scenario("small", {"depth": "spring"}).depth)
try:
    load_scenario("small", {"depth": "sprign"})
except ScenarioError as error:
    print(error)
""",
        folder=tmp_path,
    )
    assert said.startswith("spring\n")
    assert f"did you mean 'spring'? allowed are {', '.join(depths.names())}, spring" in said


def test_figures_give_it_a_colour_and_its_title(tmp_path):
    said = in_a_process(
        """
from orchestrator.results.figures import style
print(style.depth_name("spring"), len({style.colour_of(d) for d in ("v1", "v2", "v3", "spring", "mixed")}))
""",
        folder=tmp_path,
    )
    assert said == "SPRING: spring and damper 5\n"


RUN = """
import numpy as np
from pathlib import Path
from orchestrator.case.simulate import simulate
from orchestrator.case.threads import default_threads
from orchestrator.fmi.folder import ensure_fmus
from orchestrator.scenario.file import load_scenario, train_of
from rich.console import Console
scenario = load_scenario("small", {"depth": "spring", "end": 2e-3, "event": None})
train = train_of(scenario)
folder = Path(sys.argv[1])
ensure_fmus(folder, train, {"spring"}, Console(stderr=True))
assert default_threads(scenario, train) == 1
record = simulate(scenario, folder).record
assert record.attrs["status"] == "finished", record.attrs
force = record["force"].isel(time=0).values
np.savetxt(sys.stdout, np.hstack([force, record["displacement"].isel(time=0).values]))
"""


def test_it_is_built_and_run(tmp_path):
    """The FMU holds its film, and carries the train from the start to the end."""
    from zipfile import ZipFile

    in_a_process(RUN, "fmus", folder=tmp_path)
    (built,) = (tmp_path / "fmus").glob("bearing_spring-*.fmu")
    with ZipFile(built) as archive:
        assert "resources/packages/tests/spring_film.py" in archive.namelist()
        description = archive.read("modelDescription.xml").decode()
    assert 'name="film.scale"' in description and "a linear spring and damper" in description
    assert 'memoryless="true"' in description and "isotropic" not in description


START = """
import numpy as np
from pathlib import Path
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.folder import build
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import find_start
from orchestrator.master.start.journal_position import ALIGNED, aligned_positions
from orchestrator.scenario.file import load_scenario, train_of
scenario = load_scenario("small", {"depth": "spring"})
train = train_of(scenario)
build(Path("fmus"), [train], ["spring"])
clearances = np.array([seat.clearance for seat in train.bearings])
turn = np.array([[np.cos(%(angle)s), -np.sin(%(angle)s)], [np.sin(%(angle)s), np.cos(%(angle)s)]])
added.STIFFNESS[:] = turn @ added.STIFFNESS @ turn.T
with FmuStore() as store:
    system = assemble(scenario, train, Path("fmus"), store)
    system.set_speed(train.speed)
    loads = np.array([8.0e4, 5.0e4])
    found = aligned_positions(system, np.column_stack([0.0 * loads, loads]), clearances)
    expected = -np.linalg.solve(added.STIFFNESS, np.array([0.0 * loads, loads])).T
    error, size = (np.linalg.norm(x, axis=1) for x in (found[:, :2] - expected, expected))
    assert np.all(size < clearances) and np.all(error < 20 * ALIGNED * size), (error, size)
    start = find_start(system, train, train.speed)
    system.close()
relative = (start.static - start.offsets)[:, :2]
force = -(added.STIFFNESS @ relative.T).T
np.testing.assert_allclose(force, start.loads, rtol=1e-9, atol=1e-9 * abs(start.loads).max())
assert np.all(start.loads[:, 1] > 1e3)
"""


@pytest.mark.parametrize("angle", [1.0, slow(0.0), slow(2.5)])
def test_a_start_is_found_where_directions_are_unlike(angle, tmp_path):
    """Against the closed form, however the stiff direction lies."""
    in_a_process(START % {"angle": angle}, folder=tmp_path)


@pytest.mark.parametrize("name", ["v1", "Spring", "a-b", ""])
def test_names_that_are_taken_or_unfit_are_refused(name):
    from dataclasses import replace

    from bearing_fmu import depths

    with pytest.raises(ValueError, match=r"taken|allowed are small letters"):
        depths.register(replace(depths.find("v1"), name=name, title="another"))
