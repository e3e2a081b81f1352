"""Write all figures that a run gives."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib

from orchestrator.results.figures.deformed_train import deformed_train
from orchestrator.results.figures.film import film_maps
from orchestrator.results.figures.forces_and_moments import forces_and_moments
from orchestrator.results.figures.least_gap import least_gap
from orchestrator.results.figures.orbits import orbits
from orchestrator.results.figures.over_speed import has_speeds, over_speed
from orchestrator.results.figures.overview import overview
from orchestrator.results.figures.save import save
from orchestrator.results.figures.shaft_maxima import normal_stress, vibration_amplitude
from orchestrator.results.figures.spectra import spectra, waterfall
from orchestrator.results.figures.supports import has_supports, supports
from orchestrator.results.verdicts.judge import worst_bearing

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from rotor_fmu.train.train import Train

FORMATS = ("png", "pdf", "svg")


def write_figures(
    records: Sequence[xr.Dataset],
    folder: Path,
    *,
    train: Train | None = None,
    bearing: str | None = None,
    formats: Sequence[str] = ("png",),
) -> list[Path]:
    """Draw and write every figure.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run, or several of the same scenario to be compared, each with two samples at least.
    folder : Path
        Made if missing.
    train : Train, optional
        For the drawing of the shaft.
    bearing : str, optional
        The bearing that is shown; by default that with the worst verdict.
    formats : sequence of str
        File types out of `FORMATS`.

    Returns
    -------
    list of Path
        The files written, in the order of the paper's figures.
    """
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    with own_settings():
        for name, figure in figures_of(records, train, bearing):
            paths = [folder / f"{name}.{kind}" for kind in formats]
            save(figure, paths)
            written += paths
    return written


def figures_of(
    records: Sequence[xr.Dataset], train: Train | None = None, bearing: str | None = None
) -> Iterator[tuple[str, Figure]]:
    """Name and figure of all that a run gives; otherwise see `write_figures`."""
    bearing = bearing or worst_bearing(records)
    drawings: dict[str, Callable[[], Figure | None]] = {
        "deformed-train": lambda: deformed_train(records, train),
        "forces-and-moments": lambda: forces_and_moments(records, bearing),
        "least-gap": lambda: least_gap(records, bearing),
        "vibration-amplitude": lambda: vibration_amplitude(records),
        "normal-stress": lambda: normal_stress(records),
        "all-bearings": lambda: overview(records, bearing),
        "orbits": lambda: orbits(records, bearing),
        "spectra": lambda: spectra(records, bearing),
        "waterfall": lambda: waterfall(records, bearing),
        "over-speed": lambda: over_speed(records, bearing) if has_speeds(records) else None,
        "film": lambda: film_maps(records, bearing),
        "housing-and-foundation": lambda: supports(records, bearing) if has_supports(records) else None,
    }
    for name, draw in drawings.items():
        figure = draw()
        if figure is not None:
            yield name, figure


@contextmanager
def own_settings() -> Iterator[None]:
    """Draw by matplotlib's defaults, whatever the user's matplotlibrc says, and take titles as they are."""
    with matplotlib.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")  # names in letters that its fonts do not have
        matplotlib.rcdefaults()
        matplotlib.rcParams["text.parse_math"] = False
        yield
