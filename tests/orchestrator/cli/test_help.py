"""What the command says of itself, and what it imports before it is asked for anything."""

import re
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from bearing_fmu import depths
from orchestrator.cli import options as cli
from orchestrator.cli.main import app
from orchestrator.outcome import Outcome
from orchestrator.results.figures.write import FORMATS
from orchestrator.scenario import scenario


@pytest.fixture(autouse=True)
def wide(monkeypatch):
    """A terminal that does not break lines."""
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setenv("TERM", "dumb")


def call(*arguments):
    return CliRunner().invoke(app, list(arguments), prog_name="bladeloss")


def test_help_mentions_every_option_and_exit_status():
    text = call("run", "--help").output
    options = (
        "--depth --depth-at --coupling --step --end --reduction --bearing --out --fmus --format --no-figures"
    )
    for option in options.split():
        assert f"{option} " in text
    for status in {0, 1, 2, *(outcome.status for outcome in Outcome)}:
        assert re.search(rf"\b{status}  ", text)
    assert "bladeloss run --depth-at LP2-front=v2" in text
    commands = call("--help").output
    assert all(name in commands for name in ("run", "build", "info", "--version"))
    assert "--train" in call("build", "--help").output


@pytest.mark.parametrize(
    ("module", "heavy"),
    [
        ("orchestrator.cli.main", ("numpy", "xarray", "matplotlib", "fmpy", "pydantic")),
        (
            "orchestrator.commands.run",
            ("matplotlib", "scipy.ndimage", "scipy.optimize", "scipy.signal", "scipy.stats"),
        ),
    ],
)
def test_nothing_is_imported_before_it_is_needed(module, heavy):
    code = f"import sys, {module}; print(sorted(set({heavy}) & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_libraries_that_only_a_study_needs_are_hidden_from_others():
    """Even where they are installed: xarray and pint import them otherwise, for half a second."""
    code = """
import sys
from orchestrator.cli.unneeded import found, hidden
sys.modules["sparse"] = sys  # stands for one that somebody imported before
with hidden():
    import pint, xarray
    xarray.Dataset({"any": ("sample", [0.0])})
    print([name for name in sys.modules if name.startswith(("dask", "cupy")) and sys.modules[name]])
    found()
    print("dask" in sys.modules, sys.modules["sparse"] is sys)
print("dask" in sys.modules, sys.modules["sparse"] is sys)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\nFalse True\nFalse True\n"


def test_choices_are_those_of_the_scenario():
    assert tuple(cli.Depth) == depths.names()
    assert tuple(cli.Coupling) == scenario.COUPLINGS
    assert tuple(cli.Reduction) == scenario.REDUCTIONS
    assert tuple(cli.Format) == FORMATS


def test_version():
    result = call("--version")
    assert result.exit_code == 0
    assert re.fullmatch(r"bladeloss \d+\.\d+\.\d+\n", result.output)


def test_info_names_scenarios_trains_bearings_and_wheels():
    text = call("info").output
    for name in ("paper", "small", "turbine", "LP2-front", "wheel-2"):
        assert name in text
