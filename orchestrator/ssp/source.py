"""The units of an SSP: the FMUs inside it, their parameters, and the start that these say."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from orchestrator.fmi.file import FmuStore
from orchestrator.master.assembly import Part
from orchestrator.master.start.equilibrium import Start
from orchestrator.master.system import System
from orchestrator.scenario.parameters import offset_names, start_names
from orchestrator.scenario.scenario import Scenario
from orchestrator.ssp.contents import parameters, understand, value_of
from orchestrator.ssp.reader import read_ssp


class SspUnits:
    """Units of an extracted SSP.

    Parameters
    ----------
    path : Path
        The ``.ssp`` file.
    store : FmuStore
        Holds what is extracted.

    Raises
    ------
    SspError, FmuError
        When it cannot be run.

    Attributes
    ----------
    contents : Contents
        The SSP in the orchestrator's terms.
    digest : str
        SHA-256 of the archive.
    place, speed
        The archive, and the rotor's speed in rad/s.
    """

    def __init__(self, path: Path, store: FmuStore) -> None:
        self.place, self.store = path, store
        folder = store.folder / "ssp"
        self.contents = understand(read_ssp(path, folder), path, folder, store)
        self.digest = hashlib.sha256(path.read_bytes()).hexdigest()
        self.speed = float(value_of(self.contents, self.contents.rotor, "speed"))

    def parts(self, scenario: Scenario) -> Iterator[Part]:
        """Yield rotor and bearings with the values that the SSP gives them."""
        contents = self.contents
        names = ["rotor", *(seat.name for seat in contents.train.bearings)]
        for name, component in zip(names, (contents.rotor, *contents.bearings), strict=True):
            file = contents.files[component.name]
            values = parameters(component, file, self.place)
            if component is contents.rotor and scenario.ledger:
                values["track_work"] = True
            yield Part(name, file, values)

    def find_start(self, system: System) -> Start:
        """Return the start as the parameters say; forces and line follow when it is applied."""
        contents, count = self.contents, len(system.bearings)
        parts = {
            part: np.array([float(value_of(contents, contents.rotor, n)) for n in start_names(count, part)])
            for part in ("", "_cos", "_sin")
        }
        offsets = [[value_of(contents, c, name) for name in offset_names()] for c in contents.bearings]
        return Start(
            loads=np.full((count, 2), np.nan),
            offsets=np.array(offsets, dtype=float),
            static=parts[""].reshape(count, 4),
            cosine=parts["_cos"].reshape(count, 4),
            sine=parts["_sin"].reshape(count, 4),
            static_line=np.full((contents.train.nodes, 2), np.nan),
        )

    def foreign(self, scenario: Scenario) -> Mapping[str, Path]:
        """Return all its FMUs."""
        contents = self.contents
        return {
            f"{self.place}: {c.source}": contents.files[c.name].path for c in contents.structure.components
        }
