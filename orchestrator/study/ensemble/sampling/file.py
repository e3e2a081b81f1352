"""Reads a study's TOML; every problem of the file is said at once, with its line."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit
from pydantic import ValidationError

from bearing_fmu import depths as registry
from orchestrator.errors import OrchestratorError
from orchestrator.results.ensemble.figures import FIGURES, LIMIT
from orchestrator.results.record import series_names
from orchestrator.study.ensemble.sampling.samples import frozen, size_of
from orchestrator.study.ensemble.sampling.schema import MOST, SENSITIVITY, Parameter, Span, Study
from rotor_fmu.train.toml_source import Problem, TomlError, TomlSource, read_toml
from rotor_fmu.train.wording import choice, explain, shown

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_TAKEN = ("sample", "depth", "bearing", "axis", "time", "period", "parameter", "outcome", "message", "figure")


class StudyError(OrchestratorError):
    """A study that cannot be run; one line a problem."""

    def __init__(self, source: str, problems: list[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(f"{source}: {problem}" for problem in problems))


@dataclass(frozen=True)
class StudyFile:
    """A study that is right by itself, and where it stands.

    Attributes
    ----------
    study : Study
        What it says.
    toml : TomlSource
        Knows the lines.
    text, name : str
        The text; the name of the file, for messages.
    folder : Path
        From which paths count.
    """

    study: Study
    toml: TomlSource
    text: str
    name: str
    folder: Path

    def error(self, problems: Iterable[Problem]) -> StudyError:
        """What is to be raised for these problems."""
        return StudyError(self.name, list(self.toml.located(problems)))


def read_study_file(source: str | Path | Mapping[str, Any], *, of_runs: bool = True) -> StudyFile:
    """Read a study.

    Parameters
    ----------
    source : str, Path or mapping
        Path of a TOML file, or what one says.
    of_runs : bool
        Whether runs of a scenario are asked for, or else any function, whose depths and figures are its own.

    Raises
    ------
    StudyError
        With a line for each problem.
    """
    name, folder = "study", Path()
    try:
        if isinstance(source, Mapping):
            text = tomlkit.dumps(dict(source))
            toml = TomlSource(text)
        else:
            name, folder = str(source), Path(source).parent
            toml = read_toml(Path(source))
            text = Path(source).read_text(encoding="utf-8-sig")
    except TomlError as error:
        raise StudyError(name, [str(error)]) from None
    try:
        study = Study.model_validate(toml.raw)
    except ValidationError as error:
        wrong = list(explain(error, toml.raw, Study))
        raise StudyError(name, list(toml.located(wrong))) from None
    problems: list[Problem] = []
    given = {key: _with_span(key, one, problems) for key, one in study.parameters.items()}
    study = study.model_copy(update={"parameters": given})
    problems += _parameter_problems(study)
    if not problems:
        problems += _sampling_problems(study)
    problems += _choice_problems(study, of_runs)
    found = StudyFile(study, toml, text, name, folder)
    if problems:
        raise found.error(problems)
    return found


def _with_span(name: str, parameter: Parameter, problems: list[Problem]) -> Parameter:
    """The parameter with a grid that is given by its ends read."""
    at = ("parameters", name, "grid")
    if isinstance(parameter.grid, dict):
        try:
            span = Span.model_validate(parameter.grid)
        except ValidationError as error:
            problems += (
                ((*at, *at_), f"{'.'.join(at)}: {text}") for at_, text in explain(error, parameter.grid, Span)
            )
            return parameter.model_copy(update={"grid": [0.0]})
        low = min(span.start, span.stop)
        if span.start == span.stop or (span.spacing == "log" and low <= 0.0):
            allowed = "start and stop above 0" if span.start != span.stop else "a range that is not empty"
            problems.append((at, f"{'.'.join(at)} = {shown(parameter.grid)}; allowed is {allowed}"))
        return parameter.model_copy(update={"grid": span})
    if parameter.grid is not None and not isinstance(parameter.grid, list):
        allowed = "a list of values, or { start, stop, count }"
        problems.append((at, f"{'.'.join(at)} = {shown(parameter.grid)}; allowed is {allowed}"))
        return parameter.model_copy(update={"grid": [0.0]})
    return parameter


def _parameter_problems(study: Study) -> Iterator[Problem]:
    """Yield what is wrong with each parameter, and between them."""
    keys: dict[str, str] = {}
    lengths = {n: len(p.values) for n, p in study.parameters.items() if p.values is not None}
    for name, parameter in study.parameters.items():
        at, where = ("parameters", name), f"parameters.{name}"
        if not _NAME.fullmatch(name) or name in _TAKEN or name in (*FIGURES, LIMIT):
            yield (
                at,
                f"{where}: allowed is a name of letters, digits, _ and -, that is no figure nor one of "
                f"{', '.join(_TAKEN)}",
            )
        if parameter.key in keys:
            yield (
                (*at, "key"),
                f"{where}.key = {parameter.key!r}; allowed is one that {keys[parameter.key]} does not have",
            )
        keys.setdefault(parameter.key, name)
        if parameter.key == "depth":
            yield (*at, "key"), f"{where}.key = 'depth'; allowed is the list depths of the study instead"
        given = [key for key in ("values", "grid", "distribution") if getattr(parameter, key) is not None]
        if len(given) != 1:
            yield (
                at,
                f"{where}: {' and '.join(given) or 'nothing'} given; allowed is one of values, grid, "
                "distribution",
            )
        for key in ("values", "grid"):
            values = getattr(parameter, key)
            if isinstance(values, list) and not values:
                yield (*at, key), f"{where}.{key} = []; allowed is at least one value"
            for value in values if isinstance(values, list) else ():
                yield from _value_problems((*at, key), parameter, value)
        if parameter.values and lengths[name] != max(lengths.values()):
            yield (
                (*at, "values"),
                (
                    f"{where}.values: {lengths[name]} of them, in another list {max(lengths.values())}; "
                    "allowed are lists of one length, for they go together (grid: in all combinations)"
                ),
            )
        if parameter.arguments and parameter.distribution is None:
            yield (*at, "arguments"), f"{where}.arguments: allowed beside a distribution"
        if parameter.distribution is not None:
            try:
                frozen(parameter)
            except ValueError as error:
                key = "arguments" if str(error).startswith("arguments") else "distribution"
                said = f"{key} = {parameter.distribution!r}" if key == "distribution" else key
                text = str(error).removeprefix("arguments ")
                yield (*at, key), f"{where}.{said}{';' if key == 'distribution' else ':'} {text}"


def _value_problems(at: tuple[str, ...], parameter: Parameter, value: Any) -> Iterator[Problem]:
    where = ".".join(at)
    if not isinstance(value, int | float | str) or (isinstance(value, float) and not math.isfinite(value)):
        yield at, f"{where}: {shown(value)}; allowed are finite numbers and texts"
    elif parameter.factor and (isinstance(value, str | bool)):
        yield at, f"{where}: {shown(value)}; allowed are numbers, for factor is true"


def _sampling_problems(study: Study) -> Iterator[Problem]:
    """Yield what is wrong with how samples are drawn."""
    drawn = {name: p for name, p in study.parameters.items() if p.distribution is not None}
    sampling = study.sampling
    if drawn and sampling is None:
        yield (
            ("sampling",),
            "sampling: missing; it must be given where a parameter has a distribution: method and count",
        )
    if sampling is None:
        return
    at = ("sampling", "count")
    if not drawn:
        yield ("sampling",), "sampling: allowed where a parameter has a distribution"
    two = sampling.count & (sampling.count - 1) == 0
    if sampling.method in ("sobol", "sensitivity-sobol") and not two:
        yield (
            at,
            f"sampling.count = {sampling.count}; allowed is a power of two with method {sampling.method}",
        )
    if sampling.method in SENSITIVITY:
        for name, parameter in study.parameters.items():
            if parameter.distribution is None:
                yield (
                    ("parameters", name),
                    f"parameters.{name}: allowed is a distribution with {sampling.method}",
                )
            elif sampling.method == "sensitivity-morris" and not all(
                map(math.isfinite, frozen(parameter).support())
            ):
                yield (
                    ("parameters", name),
                    f"parameters.{name}: allowed is a bounded distribution with {sampling.method}",
                )
        if sampling.method == "sensitivity-morris" and sampling.levels % 2:
            yield ("sampling", "levels"), f"sampling.levels = {sampling.levels}; allowed is an even number"
    if size_of(study) > MOST:
        yield ("sampling",), f"the study has {size_of(study)} samples; allowed are {MOST}"


def _choice_problems(study: Study, of_runs: bool) -> Iterator[Problem]:
    """Yield names that are none."""
    keep, refine = study.keep, study.refine
    if not of_runs:
        return
    if not study.scenario:
        yield (), "scenario: missing; it must be given"
    for k, depth in enumerate(study.depths or ()):
        if depth not in registry.names():
            yield ("depths", k), f"depths: {depth!r}; {choice(depth, registry.names())}"
        elif depth in (study.depths or ())[:k]:
            yield ("depths", k), f"depths: {depth!r} is given twice"
    known = (*FIGURES, LIMIT)
    for name in keep.figures or ():
        if name not in known:
            yield ("keep", "figures"), f"keep.figures: {name!r}; {choice(name, known)}"
    for name in keep.traces:
        if name not in series_names():
            yield ("keep", "traces"), f"keep.traces: {name!r}; {choice(name, series_names())}"
    kept = set(keep.figures or known)
    used = (
        [(("keep", "rank"), keep.rank)]
        if keep.worst and (keep.figures is None or "rank" in keep.model_fields_set)
        else []
    )
    used += [(("refine", "figure"), refine.figure)] if refine else []
    for at, name in used:
        if name not in FIGURES or name not in kept:
            yield at, f"{'.'.join(at)} = {name!r}; {choice(name, sorted(kept & set(FIGURES)))}"
    if refine:
        yield from _refine_problems(study)


def _refine_problems(study: Study) -> Iterator[Problem]:
    refine = study.refine
    assert refine is not None
    if (refine.below is None) == (refine.above is None):
        yield ("refine",), "refine: allowed is one of below and above"
    for depth in refine.depths:
        if depth not in registry.names():
            yield ("refine", "depths"), f"refine.depths: {depth!r}; {choice(depth, registry.names())}"
        if depth in (study.depths or ()):
            yield (
                ("refine", "depths"),
                f"refine.depths: {depth!r}; allowed are depths that are not run for all samples",
            )
    if not study.depths:
        yield ("refine",), "refine: allowed beside depths, those of the first stage"
    elif refine.depth is not None and refine.depth not in study.depths:
        yield ("refine", "depth"), f"refine.depth = {refine.depth!r}; {choice(refine.depth, study.depths)}"
