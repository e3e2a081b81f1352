"""What a study is about: runs of a scenario, or values of a function; each run known by a digest."""

from __future__ import annotations

import hashlib
import inspect
import json
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Protocol

import orchestrator
from bearing_fmu.recipe import bearing_recipe
from orchestrator.errors import OrchestratorError, ScenarioError
from orchestrator.fmi.trust import own_bearings
from orchestrator.results.verdicts.limits import load_limits, own_file, to_text
from orchestrator.scenario.file import check_with_train, load_with_train, train_source
from orchestrator.scenario.parameters import linearised, needed_depths
from orchestrator.scenario.scenario import Scenario, is_fmu
from orchestrator.study.ensemble.running.bench import FunctionWork, Work
from orchestrator.study.ensemble.running.work import RunWork
from orchestrator.study.ensemble.sampling.changes import TRAIN, KeyPathError, with_values
from orchestrator.study.ensemble.sampling.file import StudyFile
from orchestrator.study.ensemble.sampling.schema import Keep, Study
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.file import TrainFileError, load_train, train_file
from rotor_fmu.train.toml_source import read_toml
from rotor_fmu.train.train import Train

Sample = Mapping[str, Any]

_OF_THE_FILM = (
    "viscosity", "ambient_pressure", "roughness", "contact_modulus", "friction", "density", "feed_pressure",
    "feed_content", "feed_flow", "layer_thickness", "layer_modulus", "layer_poisson", "layer_hardness",
    "supply_temperature", "heat_capacity", "viscosity_40", "viscosity_100", "residual_tilt_x",
    "residual_tilt_y",
)  # fmt: skip
"""Of a bearing's data those that no shaft depends on; its clearance neither, unless heights are given."""
_KEPT = 8


class Subject(Protocol):
    """What a study is about."""

    @property
    def depths(self) -> tuple[str, ...]:
        """Of the first stage."""
        ...

    def problems(self, sample: Sample, depth: str) -> list[str]:
        """What is wrong with a sample; nothing if it can be run."""
        ...

    def digest(self, sample: Sample, depth: str) -> str:
        """What a run is known by: equal ones give equal rows."""
        ...

    def work(self, sample: Sample, depth: str) -> Work:
        """The run."""
        ...


@dataclass
class ScenarioSubject:
    """Runs of a scenario.

    Attributes
    ----------
    study : Study
        What is asked for.
    base : Scenario
        That the samples change.
    train : Train
        Of the base.
    fmus : Path
        Folder of the FMUs.
    budget : float
        Wall time in s that a call to a unit may take.
    """

    study: Study
    base: Scenario
    train: Train
    fmus: Path
    budget: float
    _trains: OrderedDict[str, Train] = field(default_factory=OrderedDict, repr=False)

    @classmethod
    def of(cls, file: StudyFile, fmus: Path, budget: float) -> ScenarioSubject:
        """The subject of a study; raises StudyError where its scenario cannot be read."""
        study = file.study
        path = file.folder / study.scenario
        source = path if path.suffix == ".toml" else study.scenario
        try:
            base, train = load_with_train(str(source), study.set)
        except ScenarioError as error:
            raise file.error(
                [(("scenario",), f"scenario = {study.scenario!r}: {p}") for p in error.problems]
            ) from None
        return cls(study, base, train, fmus, budget)

    @property
    def depths(self) -> tuple[str, ...]:
        """Of the first stage."""
        return tuple(self.study.depths or (self.base.depth,))

    @cached_property
    def _raw(self) -> dict[str, Any]:
        return self.base.model_dump(mode="json", exclude_none=True)

    def _key(self, key: str) -> str:
        """A key of the scenario, with ``event`` as its only event."""
        if key.startswith("event.") and len(self.base.events) == 1:
            return f"events.0.{key.removeprefix('event.')}"
        return key

    def inputs(self, sample: Sample, depth: str) -> tuple[Scenario, Train]:
        """Scenario and train of a sample at a depth.

        Raises
        ------
        ScenarioError, TrainFileError, KeyPathError
            When there are none.
        """
        given = {
            self.study.parameters[n].key: (v, self.study.parameters[n].factor) for n, v in sample.items()
        }
        raw = with_values(self._raw, {self._key(k): v for k, v in given.items() if not k.startswith(TRAIN)})
        raw["depth"] = depth
        of_train = {k.removeprefix(TRAIN): v for k, v in given.items() if k.startswith(TRAIN)}
        train = self._train(str(raw["train"]), of_train)
        return check_with_train(raw, self.base.folder, "scenario", train)

    def train_raw(self, train: str, changes: Mapping[str, tuple[Any, bool]]) -> tuple[Path, dict[str, Any]]:
        """The file of a train, and what it would say with these values."""
        path = train_file(train_source(self.base.model_copy(update={"train": train})))
        return path, with_values(read_toml(path).raw, changes)

    def _train(self, name: str, changes: Mapping[str, tuple[Any, bool]]) -> Train:
        if not changes and name == self.base.train:
            return self.train
        key = json.dumps([name, sorted(changes.items())])
        if key not in self._trains:
            path, raw = self.train_raw(name, changes)
            self._trains[key] = load_train(path, raw if changes else None)
            if len(self._trains) > _KEPT:
                self._trains.popitem(last=False)
        return self._trains[key]

    def problems(self, sample: Sample, depth: str) -> list[str]:
        """What is wrong with a sample at a depth."""
        try:
            self.inputs(sample, depth)
        except (ScenarioError, TrainFileError) as error:
            return list(error.problems)
        except (KeyPathError, OrchestratorError) as error:
            return [str(error)]
        return []

    @cached_property
    def limits(self) -> str:
        """Of the machine, as text."""
        return to_text(load_limits(own_file(self.base)))

    @cached_property
    def program(self) -> str:
        """Digest of what computes: sources of the units and of the master."""
        folder = Path(orchestrator.__file__).parent
        rooms = ("case", "fmi", "master", "observers", "results", "scenario")
        found = hashlib.sha256(rotor_recipe(self.train).digest.encode())
        for path in sorted(p for room in rooms for p in (folder / room).rglob("*.py")):
            found.update(path.read_bytes())
        return found.hexdigest()

    @cached_property
    def _of_depth(self) -> dict[str, str]:
        return {}

    def _made_with(self, scenario: Scenario, train: Train) -> list[str]:
        found = []
        for depth in sorted(needed_depths(scenario, train)):
            if depth not in self._of_depth:
                path = scenario.folder / depth
                own = hashlib.sha256(path.read_bytes()).hexdigest() if is_fmu(depth) else ""
                self._of_depth[depth] = own or bearing_recipe(depth).digest
            found.append(self._of_depth[depth])
        return found

    def digest(self, sample: Sample, depth: str) -> str:
        """Of all that decides on a row."""
        scenario, train = self.inputs(sample, depth)
        keep = self.study.keep.model_dump(exclude={"worst", "rank"})
        said = scenario.model_dump(mode="json", exclude={"title"})
        parts = [
            self.program,
            *self._made_with(scenario, train),
            self.limits,
            json.dumps([said, keep]),
            repr(train),
        ]
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:32]

    def work(self, sample: Sample, depth: str) -> RunWork:
        """The run of a sample at a depth."""
        scenario, train = self.inputs(sample, depth)
        rotor = self._rotor(scenario, train)
        return RunWork(
            scenario, train, rotor, self.fmus.absolute(), self.limits, self.study.keep, self.budget
        )

    def _rotor(self, scenario: Scenario, train: Train) -> Train:
        """The base where only its films differ, whose rotor is the same then."""
        warm = any(seat.oil is not None for seat in train.bearings) or any(linearised(scenario, train))
        if warm or len(train.bearings) != len(self.train.bearings) or train is self.train:
            return train
        keys = list(_OF_THE_FILM)
        if all(seat.height is None for seat in train.bearings):
            keys.append("clearance")
        pairs = zip(train.bearings, self.train.bearings, strict=True)
        seats = tuple(replace(seat, **{key: getattr(own, key) for key in keys}) for seat, own in pairs)
        alike = replace(train, bearings=seats)
        return self.train if alike == self.train else train

    def needed(self, scenario: Scenario, depth: str) -> set[str]:
        """Depths of the FMUs that a scenario needs at a depth."""
        return needed_depths(scenario.model_copy(update={"depth": depth}), self.train)

    def first_step(self, depth: str) -> RunWork:
        """The first step of the base, for which FMUs are built and kernels compiled."""
        changes = {"depth": depth, "end": self.base.step, "events": (), "rotation": None}
        scenario = self.base.model_copy(update=changes)
        keep = Keep(figures=[], worst=0)
        return RunWork(scenario, self.train, self.train, self.fmus.absolute(), self.limits, keep, self.budget)

    def foreign(self) -> dict[str, Path]:
        """FMUs of others that would run."""
        return own_bearings(self.base)


@dataclass
class FunctionSubject:
    """Values of a function of the parameters."""

    study: Study
    function: Callable[..., Mapping[str, float] | float]
    depths: tuple[str, ...] = ("",)

    @cached_property
    def _source(self) -> str:
        name = f"{self.function.__module__}.{self.function.__qualname__}"
        try:
            return name + inspect.getsource(self.function)
        except (OSError, TypeError):
            return name

    def _arguments(self, sample: Sample, depth: str) -> dict[str, Any]:
        return {**sample, **({"depth": depth} if depth else {})}

    def problems(self, sample: Sample, depth: str) -> list[str]:
        """Nothing: a function says by itself what it does not take."""
        return []

    def digest(self, sample: Sample, depth: str) -> str:
        """Of the function's source and its arguments."""
        said = json.dumps([self._source, self._arguments(sample, depth)], sort_keys=True)
        return hashlib.sha256(said.encode()).hexdigest()[:32]

    def work(self, sample: Sample, depth: str) -> FunctionWork:
        """The call."""
        return FunctionWork(self.function, self._arguments(sample, depth))
