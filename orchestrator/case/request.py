"""What the user asks for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from orchestrator.fmi.folder import fmu_folder
from orchestrator.fmi.watchdog import BUDGET


@dataclass(frozen=True)
class RunRequest:
    """A run as the command line asks for it.

    Attributes
    ----------
    source : str
        Name of a bundled scenario, path of a TOML file or of an SSP.
    overrides : mapping
        Values in place of the scenario's, in the shape of the file.
    out : Path or None
        Folder of the results; None: ``results/<scenario>-<depth>``, of an SSP ``results/<name>``.
    fmus : Path
        Folder of the FMUs; by default in the user's cache.
    bearing : str or None
        The analysed bearing; None: the most loaded one.
    formats : sequence of str
        File types of the figures; none for no figures.
    checkpoint : float or None
        Simulated time from one checkpoint to the next in s; None: no checkpoints.
    certify : bool
        Run once more at half the step, with the energy ledger in both, and say what changes.
    threads : int or None
        On which the bearings step; None: as many as pay.
    trust : bool
        Run FMUs of others without asking.
    budget : float
        Wall time in s that a call to a unit may take; 0 for any.
    rotor : str or None
        GUID of the rotor that is meant, where the train may have been edited since it was chosen.
    report : bool
        Make the report, too.
    """

    source: str
    overrides: Mapping[str, Any] = field(default_factory=dict)
    out: Path | None = None
    fmus: Path = field(default_factory=fmu_folder)
    bearing: str | None = None
    formats: Sequence[str] = ("png",)
    checkpoint: float | None = None
    certify: bool = False
    threads: int | None = None
    trust: bool = False
    budget: float = BUDGET
    rotor: str | None = None
    report: bool = False

    @property
    def is_ssp(self) -> bool:
        """Whether an SSP is to be run."""
        return self.source.endswith(".ssp")
