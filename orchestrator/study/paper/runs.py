"""The runs of a comparison, one a depth, as the rows of the table read them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from orchestrator.results.statistics import BearingStatistics, ShaftStatistics
from orchestrator.study.paper.observation import Observation, absent, observe

if TYPE_CHECKING:
    import xarray as xr

    from orchestrator.scenario.scenario import Scenario
    from rotor_fmu.train.train import BearingSeat, Train


@dataclass(frozen=True)
class Runs:
    """One scenario at several depths.

    Attributes
    ----------
    observed : mapping
        Observation by depth.
    seat : BearingSeat
        The analysed bearing.
    train : str
        Name of the train.
    blade_force : float
        Unbalance of the lost blade times speed squared [N]; 0 without event.
    """

    observed: Mapping[str, Observation]
    seat: BearingSeat
    train: str
    blade_force: float

    def bearing(self, depth: str, phase: str) -> BearingStatistics:
        """Statistics of the analysed bearing; raises `NotEvaluatedError`."""
        return self.observed[depth].require(phase).bearing

    def shaft(self, depth: str, phase: str) -> ShaftStatistics:
        """Statistics of the shaft; raises `NotEvaluatedError`."""
        return self.observed[depth].require(phase).shaft

    @property
    def depths(self) -> Sequence[str]:
        """All depths, V1 first."""
        return tuple(self.observed)


def gather(
    records: Mapping[str, xr.Dataset | None],
    unfinished: Mapping[str, str],
    bearing: str,
    scenario: Scenario,
    train: Train,
) -> Runs:
    """Observe the runs.

    Parameters
    ----------
    records : mapping
        Record by depth, None for a run that left none.
    unfinished : mapping
        By depth how a run ended that did not finish, empty for the others.
    bearing : str
        The analysed bearing.
    scenario, train : Scenario, Train
        What was run.
    """
    observed = {
        depth: absent(depth, unfinished[depth])
        if record is None
        else observe(record, depth, bearing, unfinished=unfinished[depth])
        for depth, record in records.items()
    }
    seat = next(seat for seat in train.bearings if seat.name == bearing)
    blade = 0.0 if scenario.event is None else scenario.event.unbalance * train.speed**2
    return Runs(observed, seat, train.name, blade)
