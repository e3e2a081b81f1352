"""Runs of a comparison that meet every row, put together from figures; tests then spoil one of them."""

from dataclasses import replace

from orchestrator.results.statistics import BearingStatistics, ShaftStatistics
from orchestrator.results.windows import Phase, Window
from orchestrator.study.children import Ended
from orchestrator.study.comparison import Comparison, Settings
from orchestrator.study.depth_run import DepthRun, PhaseFigures
from rotor_fmu.train.train import BearingSeat

SEAT = BearingSeat("LP1-front", 3, 0.8, 0.64, 8.6e-4, 0.0242, roughness=2e-6)
THRESHOLD = 1.8e3
COARSE, FINE = Settings(1e-4, 48, 8, 2.0), Settings(5e-5, 96, 16, 2.0)
BEFORE = Phase("before", Window(0.92, 1.0), Window(0.92, 1.0), Window(0.0, 1.0))
AFTER = Phase("after", Window(1.4, 2.0), Window(1.0, 2.0), Window(1.0, 2.0))


def figures(phase, *, ends=(0.5, 0.5), contact=0.0, amplitude=0.3e-3, stress=40e6, **others):
    values = {
        "force_mean": 1.8e6,
        "force_max": 1.9e6,
        "moment_mean": 0.0,
        "moment_max": 0.0,
        "least_gap_mean": 100e-6,
        "least_gap_harmonic": 5e-6,
        "least_gap_min": 95e-6,
        "centre_line_gap_mean": 112e-6,
        "centre_line_gap_min": 106e-6,
        "contact_first": 1.1 if contact > THRESHOLD else None,
        "contact_share": 0.2 if contact > THRESHOLD else 0.0,
        "contact_max": contact,
        "sommerfeld_mean": 4.3,
        **others,
    }
    shaft = ShaftStatistics(phase.name, amplitude, amplitude, 12.0, stress, stress, 12.0)
    return PhaseFigures(phase, BearingStatistics("LP1-front", phase.name, **values), shaft, contact, ends)


def runs():
    """Every row met."""
    before = {
        "v1": figures(BEFORE),
        "v2": figures(BEFORE, least_gap_mean=115e-6, least_gap_min=110e-6),
        "v3": figures(BEFORE, least_gap_mean=130e-6, least_gap_min=125e-6),
    }
    after = {
        "v1": figures(
            AFTER,
            force_max=12e6,
            moment_max=2e6,
            sommerfeld_mean=7.7,
            least_gap_min=-1e-6,
            centre_line_gap_min=30e-6,
            contact=3e6,
            stress=120e6,
        ),
        "v2": figures(AFTER, force_max=4e6, least_gap_min=30e-6, amplitude=2e-3, stress=90e6),
        "v3": figures(AFTER, force_max=4.1e6, least_gap_min=60e-6, amplitude=2.2e-3, stress=85e6),
    }
    found = {depth: DepthRun(depth, "", THRESHOLD, before[depth], after[depth]) for depth in before}
    ended = {depth: Ended("finished", "", "", 2.0, 10.0) for depth in found}
    return Comparison("Blade fracture", "turbine", COARSE, SEAT, 4.3e6, found, ended)


def spoiled(found, depth, phase, **changes):
    """The runs with other figures in one phase of one run: of the bearing, the shaft or the phase."""
    run = found.runs[depth]
    old = getattr(run, phase)
    names = {"bearing": old.bearing, "shaft": old.shaft}
    parts = {
        part: replace(value, **{k: v for k, v in changes.items() if hasattr(value, k)})
        for part, value in names.items()
    }
    own = {k: v for k, v in changes.items() if hasattr(old, k)}
    new = replace(old, **parts, **own)
    return replace(found, runs={**found.runs, depth: replace(run, **{phase: new})})
