"""The module `bladeloss`: its page's examples, its errors, what it leaves behind."""

import re
import sys
from pathlib import Path

import bladeloss
import numpy as np
import pytest

from orchestrator.errors import OrchestratorError
from orchestrator.outcome import Outcome
from orchestrator.report import document

PAGE = Path(bladeloss.__file__).parents[1] / "README.md"
SHORT = {"depth": "v3", "end": 0.01, "event": None}


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """An empty working folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_examples_of_the_page_run_in_their_order(monkeypatch, capsys, once, elsewhere):
    """With FMUs from a folder of the tests, and 0.16 s in place of 0.2."""
    pytest.importorskip("plotly")
    folder = once("door", lambda folder: None)
    for module in ("runs", "machines"):
        monkeypatch.setattr(f"bladeloss.{module}.fmu_folder", lambda: folder)
    monkeypatch.setattr(document, "require_library", lambda: lambda: "library")
    examples = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(examples) == 6
    scope = {}
    for example in examples:
        shorter = example.replace("end=0.2", "end=0.16")
        exec(compile(shorter, str(PAGE), "exec"), scope)
    told = capsys.readouterr().out
    assert told.startswith("finished ")
    assert "half axes" in told
    assert "depth = 'v9'; allowed are " in told
    assert (elsewhere / "depths.html").is_file()
    assert [path.name for path in elsewhere.iterdir()] == ["depths.html"]


def test_a_run_leaves_nothing_unless_it_is_told_where(small_fmus, elsewhere):
    record = bladeloss.run("small", fmus=small_fmus, **SHORT)
    assert record.attrs["status"] == "finished"
    assert record["time"].values[-1] == pytest.approx(0.01)
    assert list(elsewhere.iterdir()) == []
    again = bladeloss.run("small", fmus=small_fmus, out="here", figures=False, **SHORT)
    np.testing.assert_array_equal(again["force"], record["force"])
    assert {"record.nc", "summary.txt", "scenario.toml"} <= {
        path.name for path in (elsewhere / "here").iterdir()
    }
    np.testing.assert_array_equal(bladeloss.load("here")["force"], record["force"])


def test_wrong_input_is_an_error_with_the_words_of_the_command_line(small_fmus):
    with pytest.raises(bladeloss.Error, match="no such scenario"):
        bladeloss.run("smal", fmus=small_fmus)
    with pytest.raises(OrchestratorError, match=r"event\.unbalance = -1"):
        bladeloss.run("small", fmus=small_fmus, event__unbalance=-1.0)
    with pytest.raises(bladeloss.Error, match="no record; allowed is the folder of a run"):
        bladeloss.load("nowhere")
    with pytest.raises(bladeloss.Error, match="report: needs a folder"):
        bladeloss.run("small", report=True)
    with pytest.raises(bladeloss.Error, match="diametre: no parameter of a bearing; did you mean 'diameter'"):
        bladeloss.bearing("v3", diametre=0.1)
    with pytest.raises(bladeloss.Error, match="film is given as a value, too"):
        bladeloss.scenario("small", film=3, film__rows=4)


def test_a_run_that_fails_has_what_it_simulated(small_fmus):
    with pytest.raises(bladeloss.RunError) as caught:
        bladeloss.run("small", fmus=small_fmus, depth="v3", end=0.2, step=2e-3, coupling="jacobi")
    assert caught.value.outcome is not Outcome.FINISHED
    assert caught.value.record.attrs["status"] == caught.value.outcome.value
    assert str(caught.value).startswith(caught.value.outcome.value)


def test_a_bearing_on_its_own_follows_the_short_bearing_formula():
    """At rest and centred no force; at half eccentricity that of DuBois and Ocvirk (1953)."""
    d, b, c, eta, speed, e = 0.2, 0.02, 2e-4, 0.03, 314.16, 0.5
    evaluate = bladeloss.bearing(
        "v3", diameter=d, width=b, clearance=c, viscosity=eta, ambient_pressure=0.0, contact_modulus=0.0
    )
    found = evaluate(q=[0.0, -e * c, 0.0, 0.0], speed=speed)
    scale = eta * speed * (d / 2) * b * (b / 2 / c) ** 2
    expected = scale * e / (1 - e * e) ** 2 * np.sqrt(16 * e * e + np.pi**2 * (1 - e * e))
    assert np.hypot(found["wrench.Fx"], found["wrench.Fy"]) == pytest.approx(expected, rel=1e-6)


def test_the_module_names_what_it_offers_and_is_typed():
    assert sorted(bladeloss.__all__) == bladeloss.__all__ or set(bladeloss.__all__) <= set(dir(bladeloss))
    assert (Path(bladeloss.__file__).parent / "py.typed").is_file()
    assert "bladeloss" in sys.modules
