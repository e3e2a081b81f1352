"""From a scenario to an SSP: its system, at its static equilibrium, for other tools."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from bearing_fmu.recipe import bearing_recipe
from fmus import port
from fmus.build.archive import write_archive
from fmus.build.builder import write
from fmus.build.recipe import Recipe
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.fmi.file import FmuFile, FmuStore
from orchestrator.fmi.unit import Unit
from orchestrator.master.assembly import join, parts_in_folder
from orchestrator.master.start.equilibrium import Start, find_start
from orchestrator.master.system import System, Wiring, port_connections
from orchestrator.scenario.events import BladeLoss, to_json
from orchestrator.scenario.file import train_of
from orchestrator.scenario.parameters import (
    Values,
    offset_names,
    rotor_parameters,
    start_names,
)
from orchestrator.scenario.scenario import Scenario, is_fmu
from orchestrator.ssp.structure import ROTOR, Component, Connector, SspError, Structure
from orchestrator.ssp.writer import documents
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.train import Train


def force_only(path: Path) -> Path:
    """Where the second system definition goes that belongs to the one at `path`."""
    return path.with_name(f"{path.stem}_force{path.suffix}")


@one_blas_thread()
def export(scenario: Scenario, fmus: Path, out: Path, name: str) -> list[Path]:
    """Write the system of a scenario as two SSP archives: affine law, and force only.

    Parameters
    ----------
    scenario : Scenario
        Its static equilibrium is solved here, as at the start of a run.
    fmus : Path
        Folder with its FMUs.
    out : Path
        The archive with the affine law; the other gets ``_force`` in its name. Two exports
        of the same scenario with the same FMUs have the same bytes.
    name : str
        Names the system.

    Returns
    -------
    list of Path
        The archives.

    Raises
    ------
    FmuError, PortError
        As `orchestrator.master.assembly.assemble`.
    EquilibriumError
        When the train finds no equilibrium on its films.
    SspError
        When a setting fits neither the parameter sets of an SSP nor the start values of an FMU.
    """
    train = train_of(scenario)
    with tempfile.TemporaryDirectory(prefix="bladeloss_ssp_") as temporary, FmuStore() as store:
        made = list(parts_in_folder(scenario, train, fmus, store))
        speed = scenario.start_speed(train.speed)
        system = join(made, scenario, speed, fmus)
        try:
            start = find_start(system, train, speed)
            parts = _Parts(scenario, train, {part.name: part.parameters for part in made}, Path(temporary))
            components = tuple(parts.components(system, start))
        finally:
            system.close()
        archives = {out: Wiring.LAW, force_only(out): Wiring.FORCE}
        for path, wiring in archives.items():
            bearings = [c.name for c in components[1:]]
            structure = Structure(
                name=_identifier(name) + ("_force" if wiring is Wiring.FORCE else ""),
                title=scenario.title,
                components=components,
                connections=tuple(
                    port_connections(
                        ROTOR, bearings, wiring, moving=train.has_moving_housings, turning=scenario.turns
                    )
                ),
                end=scenario.end,
                step=scenario.step,
                coupling=scenario.coupling if wiring is Wiring.LAW else "gauss-seidel",
                tolerance=scenario.tolerance if wiring is Wiring.LAW else None,
                record_interval=scenario.record.interval,
                analysed_bearing=scenario.analysed_bearing,
                events=_events(scenario),
            )
            path.parent.mkdir(parents=True, exist_ok=True)
            write_archive(path, documents(structure) | parts.files)
    return list(archives)


class _Parts:
    """Components of a scenario and the FMUs they refer to, each FMU once."""

    def __init__(
        self, scenario: Scenario, train: Train, values: Mapping[str, Values], temporary: Path
    ) -> None:
        self.scenario, self.train, self.values, self.temporary = scenario, train, values, temporary
        self.files: dict[str, bytes] = {}
        self._sources: dict[tuple[Path, tuple[tuple[str, str], ...]], str] = {}

    def components(self, system: System, start: Start) -> Iterator[Component]:
        """Yield rotor and bearings: Real settings as parameters, others as start values of their FMUs."""
        speed = self.scenario.start_speed(self.train.speed)
        given = rotor_parameters(self.scenario, self.train) | {port.SPEED: speed}
        for part, positions in (("", start.static), ("_cos", start.cosine), ("_sin", start.sine)):
            given |= _named(start_names(len(system.bearings), part), positions)
        yield self._component(ROTOR, f"shaft of the train {self.train.name}", system.rotor, given)
        taken = {ROTOR}
        # so that a tool has them right before anything has travelled along a connection
        journals = np.hstack([start.static + start.cosine, speed * start.sine])
        of_bearings = zip(system.bearings, self.train.bearings, start.offsets, journals, strict=True)
        for unit, seat, offset, journal in of_bearings:
            given = {**self.values[seat.name], port.SPEED: speed}
            given |= _named(offset_names(), offset) | _named(port.JOURNAL, journal)
            name = _identifier(seat.name)
            if name in taken:
                raise SspError(f"bearing {seat.name}: as {name} its name is taken; tools need unlike names")
            taken.add(name)
            yield self._component(name, seat.name, unit, given)

    def _component(self, name: str, description: str, unit: Unit, given: Values) -> Component:
        given = {key: x for key, x in given.items() if key in unit.file.variables}
        real = {key: float(x) for key, x in given.items() if unit.variable(key).type == "Real"}
        other = {key: x for key, x in given.items() if key not in real}
        source = self._source(unit.file, description if name != ROTOR else None, _unlike(unit.file, other))
        return Component(name, source, description, tuple(_connectors(unit.file)), real)

    def _source(self, file: FmuFile, bearing: str | None, starts: Values) -> str:
        """Return where the FMU lies in the archive; build it anew where it needs other start values."""
        key = file.path.resolve(), tuple(sorted((name, str(value)) for name, value in starts.items()))
        if key not in self._sources:
            content = file.path.read_bytes()
            if starts:
                content = self._with_starts(file, bearing, starts)
            recipe = self._recipe(bearing)
            name, number = file.path.name if recipe is None else recipe.file_name, 2
            stem = name.removesuffix(".fmu")
            while f"resources/{name}" in self.files:
                name, number = f"{stem}_{number}.fmu", number + 1
            self._sources[key] = f"resources/{name}"
            self.files[self._sources[key]] = content
        return self._sources[key]

    def _with_starts(self, file: FmuFile, bearing: str | None, starts: Values) -> bytes:
        recipe = self._recipe(bearing, starts)
        if recipe is None:
            settings = ", ".join(f"{name} = {value!r}" for name, value in starts.items())
            raise SspError(
                f"{file.path}: {settings}: parameter sets hold Real values only, and the start values of an "
                "FMU that bladeloss did not build stay as they are; take those"
            )
        return write(recipe, self.temporary).read_bytes()

    def _recipe(self, bearing: str | None, starts: Values | None = None) -> Recipe | None:
        """Of the FMU of a bearing, or of the rotor; None for somebody else's."""
        if bearing is None:
            return rotor_recipe(self.train, starts)
        depth = self.scenario.depth_of(bearing)
        return None if is_fmu(depth) else bearing_recipe(depth, starts)


def _events(scenario: Scenario) -> str | None:
    """Those events that no parameter of the rotor tells, as JSON."""
    others = [e for e in scenario.events if not (isinstance(e, BladeLoss) and e.timed)]
    return to_json(others) if others else None


def _unlike(file: FmuFile, settings: Values) -> Values:
    """Those of the settings that differ from the FMU's start values."""
    return {name: x for name, x in settings.items() if str(file.variables[name].start) != str(x)}


def _connectors(file: FmuFile) -> Iterator[Connector]:
    """Yield the inputs and outputs, without those of every shaft node."""
    for v in file.description.modelVariables:
        if v.type == "Real" and v.causality in ("input", "output") and not v.name.startswith("node["):
            yield Connector(v.name, v.causality, v.unit if v.unit in port.UNITS else "")


def _named(names: Sequence[str], values: np.ndarray) -> Values:
    return dict(zip(names, np.asarray(values, dtype=float).ravel().tolist(), strict=True))


def _identifier(name: str) -> str:
    """Return a name that every tool takes."""
    text = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return text if text[:1].isalpha() else f"b_{text}"
