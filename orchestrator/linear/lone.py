"""A bearing that stands in a file of its own, as a case of the command bearing."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import ValidationError

from orchestrator.errors import OrchestratorError
from orchestrator.linear.case import LinearCase, LinearRequest
from orchestrator.results.folder import check_folder
from orchestrator.scenario.scenario import FilmSettings, Scenario
from rotor_fmu.train.file import TrainFileError
from rotor_fmu.train.lone import load_bearing
from rotor_fmu.train.train import Train
from rotor_fmu.train.wording import explain

if TYPE_CHECKING:
    from rich.console import Console


def lone_case(request: LinearRequest, console: Console) -> tuple[LinearCase, float, float] | None:
    """The case of a bearing's file, its load [N] and the angle of that [rad]; None for another source.

    Raises
    ------
    OrchestratorError
        With one line for each problem of the file.
    """
    path = Path(request.source)
    if path.suffix != ".toml" or not path.is_file():
        return None
    try:
        found = load_bearing(path)
    except TrainFileError as error:
        raise OrchestratorError(str(error)) from None
    if found is None:
        return None
    try:
        film = FilmSettings.model_validate(found.film)
    except ValidationError as error:
        lines = [f"{path}: film: {text}" for _, text in explain(error, found.film, FilmSettings)]
        raise OrchestratorError("\n".join(lines)) from None
    check_folder(request.folder, f"{request.command}.nc")
    train = Train(path.stem, found.speed, 0.0, 0.0, 0.0, (), (), (found.seat,))
    scenario = Scenario(title=f"Bearing {found.seat.name}", train=request.source, end=1.0, film=film)
    return LinearCase(request, scenario, train, console), found.load, found.load_angle
