"""One scenario at several depths: its runs side by side, and how each ended."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from orchestrator.results.statistics import BearingStatistics, ShaftStatistics
from orchestrator.results.verdicts.conclusion import Conclusion, conclude
from orchestrator.results.verdicts.judge import judge
from orchestrator.results.verdicts.limits import load_limits, own_file
from orchestrator.results.verdicts.verdict import Verdict
from orchestrator.scenario.events import BladeLoss
from orchestrator.study.children import Ended
from orchestrator.study.depth_run import DepthRun, read_run

if TYPE_CHECKING:
    import xarray as xr

    from orchestrator.scenario.scenario import Scenario
    from rotor_fmu.train.train import BearingSeat, Train


@dataclass(frozen=True)
class Settings:
    """Numerical settings of the runs: macro step and end time [s], resolution of the films."""

    macro_step: float
    columns: int
    film_rows: int
    end: float

    def text(self) -> str:
        """In a few words."""
        return f"film {self.columns} x {self.film_rows}, macro step {self.macro_step * 1e3:.3g} ms"


@dataclass(frozen=True)
class Comparison:
    """One scenario at several depths.

    Attributes
    ----------
    title, train : str
        Of the scenario; name of its train.
    settings : Settings
        Numerical settings.
    seat : BearingSeat
        The analysed bearing.
    blade_force : float
        Unbalance of the lost blade times speed squared [N]; 0 without event.
    runs : mapping
        Figures of the runs by depth, the deepest first.
    ended : mapping
        How each run ended, by depth.
    verdicts : mapping
        Of each depth that left a record, held against the limits of the machine.
    """

    title: str
    train: str
    settings: Settings
    seat: BearingSeat
    blade_force: float
    runs: Mapping[str, DepthRun]
    ended: Mapping[str, Ended] = field(default_factory=dict)
    verdicts: Mapping[str, tuple[Verdict, ...]] = field(default_factory=dict)

    def bearing(self, depth: str, phase: str) -> BearingStatistics:
        """Statistics of the analysed bearing; raises `NotEvaluatedError`."""
        return self.runs[depth].require(phase).bearing

    def shaft(self, depth: str, phase: str) -> ShaftStatistics:
        """Statistics of the shaft; raises `NotEvaluatedError`."""
        return self.runs[depth].require(phase).shaft

    @cached_property
    def conclusions(self) -> dict[str, Conclusion]:
        """What an engineer would conclude at each depth: of its own run alone, from every limit."""
        return {
            depth: conclude(self.verdicts.get(depth, ()), run.unfinished) for depth, run in self.runs.items()
        }

    @property
    def names(self) -> str:
        """All depths as people write them."""
        return ", ".join(depth.upper() for depth in self.runs)

    @property
    def complete(self) -> bool:
        """Whether every run finished."""
        return all(end.ok for end in self.ended.values())


def settings_of(scenario: Scenario) -> Settings:
    """The numerical settings of a scenario."""
    return Settings(scenario.step, scenario.film.columns, scenario.film.rows, scenario.end)


def gather(
    records: Mapping[str, xr.Dataset | None],
    ended: Mapping[str, Ended],
    bearing: str,
    scenario: Scenario,
    train: Train,
) -> Comparison:
    """Put the runs side by side.

    Parameters
    ----------
    records : mapping
        Record by depth, None for a run that left none.
    ended : mapping
        How each run ended, by depth.
    bearing : str
        The analysed bearing.
    scenario, train : Scenario, Train
        What was run.
    """
    unfinished = {depth: "" if end.ok else end.text() for depth, end in ended.items()}
    runs = {
        depth: DepthRun(depth, unfinished[depth])
        if record is None
        else read_run(record, depth, bearing, unfinished=unfinished[depth])
        for depth, record in records.items()
    }
    limits = load_limits(own_file(scenario))
    return Comparison(
        title=scenario.title or scenario.train,
        train=train.name,
        settings=settings_of(scenario),
        seat=next(seat for seat in train.bearings if seat.name == bearing),
        blade_force=sum(e.unbalance for e in scenario.events if isinstance(e, BladeLoss)) * train.speed**2,
        runs=runs,
        ended=ended,
        verdicts={
            depth: judge(record, limits)
            for depth, record in records.items()
            if record is not None and "bearing_clearance" in record
        },
    )
