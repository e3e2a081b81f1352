"""What films and depths do not offer of what a scenario asks of them, in words."""

from __future__ import annotations

from collections.abc import Iterator

from bearing_fmu import depths
from bearing_fmu.depths import LINEAR
from orchestrator.scenario.parameters import bearing_parameters
from orchestrator.scenario.scenario import FilmSettings, Scenario
from rotor_fmu.train.toml_source import Problem
from rotor_fmu.train.train import BearingSeat, Train


def film_problems(scenario: Scenario, train: Train) -> Iterator[Problem]:
    """Yield settings of the films that a depth in use does not offer, and bearings that it cannot have."""
    found = list(_setting_problems(scenario, train))
    yield from found or _bearing_problems(scenario, train)


def _setting_problems(scenario: Scenario, train: Train) -> Iterator[Problem]:
    boundary = scenario.film.boundary
    used = {scenario.depth_of(seat.name) for seat in train.bearings}
    for depth in depths.depths():
        if depth.name in used.intersection(depths.films()) and boundary not in depth.boundaries:
            yield (
                ("film", "boundary"),
                f"film.boundary = {boundary!r}; allowed at depth {depth.name} is "
                f"{' or '.join(map(repr, depth.boundaries))}",
            )
    if scenario.film.temperature == "followed":
        yield from _heat_problems(scenario, train, used)
    for seat in train.bearings if boundary == "jfo" else ():
        if seat.has_film and not seat.has_grooves and not seat.ambient_pressure > 0.0:
            yield (
                ("film", "boundary"),
                f"film.boundary = {boundary!r}; allowed with oil at each bearing; {seat.name} has neither "
                "grooves nor an ambient_pressure > 0",
            )


def _heat_problems(scenario: Scenario, train: Train, used: set[str]) -> Iterator[Problem]:
    """Yield what does not go with an oil that warms in time."""
    place, word = ("film", "temperature"), f"film.temperature = {scenario.film.temperature!r}"
    if "table" in used or scenario.film.boundary == "jfo":
        yield place, f"{word}; allowed at depths v1, v2 and v3, with film.boundary 'guembel' or 'reynolds'"
    for seat in train.bearings:
        if seat.has_film and seat.oil is None:
            yield (
                place,
                f"{word}; allowed with an oil at each bearing, a grade or a curve; {seat.name} has none",
            )
        if seat.has_film and seat.layer_thickness > 0.0:
            yield place, f"{word}; allowed with rigid bores; {seat.name} has a layer_thickness"


def _bearing_problems(scenario: Scenario, train: Train) -> Iterator[Problem]:
    """Yield bearings whose film the depth refuses: a bore unknown to it, a layer beside turbulence."""
    known = {depth.name: depth for depth in depths.depths()}
    refused: dict[tuple[tuple[str, ...], str, str], list[str]] = {}
    for seat in train.bearings:
        given = scenario.depth_of(seat.name)
        from_film = given == LINEAR.name and not seat.coefficients
        name = scenario.linear_from if from_film else given
        if name not in depths.films() or not seat.has_film or not _unusual(seat, scenario.film):
            continue
        try:
            known[name].make(bearing_parameters(seat, scenario.film))
        except ValueError as error:
            place: tuple[str, ...] = ("linear_from" if from_film else "depth",)
            if seat.name in scenario.depth_at and not from_film:
                place = ("depth_at", seat.name)
            refused.setdefault((place, name, str(error)), []).append(seat.name)
    for (place, name, reason), seats in refused.items():
        yield place, f"{'.'.join(place)} = {name!r}: not for bearing {', '.join(seats)}: {reason}"


def _unusual(seat: BearingSeat, film: FilmSettings) -> bool:
    """Whether a film may be refused: those of a plain, rigid bore in the plain settings never are.

    Making a film loads the compiled kernels, which takes a second.
    """
    plain = FilmSettings()
    keys = ("boundary", "turbulence", "temperature")
    asked = any(getattr(film, key) != getattr(plain, key) for key in keys)
    return asked or seat.has_grooves or seat.layer_thickness > 0.0 or seat.ambient_pressure > 0.0


def depth_problems(scenario: Scenario, train: Train) -> Iterator[Problem]:
    """Yield films asked for at bearings without a bore."""
    for seat in train.bearings:
        depth = scenario.depth_at.get(seat.name, LINEAR.name)
        if not seat.has_film and depth in depths.films():
            yield (
                ("depth_at", seat.name),
                f"depth_at.{seat.name} = {depth!r}; allowed is {LINEAR.name!r} or an .fmu file: the train "
                "gives stiffness and damping of this bearing, and no bore",
            )
