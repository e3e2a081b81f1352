"""``bladeloss export-ssp``, and the SSP that ``bladeloss build`` leaves beside the FMUs."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console

from fmus.build.builder import NotOursError, check_target
from orchestrator.fmi.folder import ensure_fmus
from orchestrator.fmi.trust import own_bearings, require_trust
from orchestrator.scenario.file import load_with_train
from orchestrator.scenario.parameters import needed_depths
from orchestrator.ssp.export import export, force_only
from orchestrator.ssp.structure import SspError

DEFAULT_SCENARIO = "inertia"
DEFAULT_NAME = "bladeloss"


def export_scenario(
    source: str, out: Path | None, fmus: Path, console: Console, *, trust: bool = False
) -> list[Path]:
    """Write a scenario's system as SSP archives and say where.

    Parameters
    ----------
    source : str
        Name of a bundled scenario or path of a TOML file.
    out : Path or None
        The archive; None: the scenario's name with ``.ssp`` in the current folder.
    fmus : Path
        Folder of the FMUs; what is missing or stale is built.
    console : rich.console.Console
        Told what was written.
    trust : bool
        Run FMUs of others, to find the start, without asking.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input, and when there is no static equilibrium.
    """
    scenario, train = load_with_train(source)
    path = out or Path(f"{Path(source).stem}.ssp")
    if path.suffix != ".ssp":
        raise SspError(f"--out {path}: allowed is a name that ends in .ssp")
    try:
        for target in (path, force_only(path)):
            check_target(target)
    except NotOursError as error:
        raise SspError(str(error)) from None
    require_trust(own_bearings(scenario), trust=trust)
    ensure_fmus(fmus, train, needed_depths(scenario, train), console)
    console.print("Solving the static equilibrium", highlight=False)
    try:
        written = export(scenario, fmus, path, path.stem)
    except OSError as error:
        raise SspError(f"{path}: cannot be written: {error}") from error
    for file, what in ((path, "affine law"), (force_only(path), "force only")):
        size = f"{file.stat().st_size / 1e6:.2f} MB"
        console.print(f"{file}  {size}, {what}", highlight=False, soft_wrap=True)
    return written
