"""What the page of a study shows: parameters, depths with their looks, figures with their scales."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.results.ensemble.figures import CONTACT, one_number
from orchestrator.results.figures import style

Array = NDArray[np.float64]
_DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
NOT_REFINED = "not-refined"
FINISHED = "finished"
_SCALES = {"m": (1e6, "µm"), "Pa": (1e-6, "MPa"), "N": (1e-3, "kN"), "N m": (1e-3, "kN m")}


@dataclass(frozen=True)
class Level:
    """A depth of a study, or a depth where it was asked for and a shallower one elsewhere.

    Attributes
    ----------
    name : str
        For legends.
    colour, dash : str
        Of its lines; the colour is that of the depth everywhere.
    outcomes : ndarray (samples,) of str
        How the runs ended.
    contact : ndarray (samples,)
        1 where there was solid contact, 0 where not, nan where it is not known.
    """

    name: str
    colour: str
    dash: str
    outcomes: NDArray[np.str_]
    contact: Array


def levels(data: xr.Dataset) -> tuple[Level, ...]:
    """The depths of a study, those of a second stage completed by its first."""
    first = str(data.attrs.get("first_stage", "")).split()
    found = []
    for k, depth in enumerate(str(d) for d in data["depth"].values):
        outcomes, contact = _of_depth(data, depth)
        name = style.depth_name(depth) if depth else "runs"
        if first and depth not in first:
            under, its_contact = _of_depth(data, first[0])
            asked = outcomes != NOT_REFINED
            name = f"{name}, where the first stage asked for it; else {first[0].upper()}"
            outcomes, contact = np.where(asked, outcomes, under), np.where(asked, contact, its_contact)
        found.append(Level(name, style.colour_of(depth), _DASHES[k % len(_DASHES)], outcomes, contact))
    return tuple(found)


def _of_depth(data: xr.Dataset, depth: str) -> tuple[NDArray[np.str_], Array]:
    outcomes = data["outcome"].sel(depth=depth).values.astype(str)
    if CONTACT not in data:
        return outcomes, np.full(outcomes.shape, np.nan)
    contact = np.asarray(data[CONTACT].sel(depth=depth).values, dtype=float)
    return outcomes, np.where(outcomes == FINISHED, contact, np.nan)


def parameters(data: xr.Dataset) -> list[str]:
    """Names of the parameters that are numbers and vary, unbalances of blades first."""
    names = [n for n in str(data.attrs["parameters"]).split() if data[n].dtype.kind == "f"]
    names = [n for n in names if np.unique(data[n].values).size > 1]
    return sorted(names, key=lambda n: not str(data[n].attrs.get("key", "")).endswith("unbalance"))


def title_of(data: xr.Dataset, parameter: str) -> str:
    """A parameter with its unit."""
    attributes = data[parameter].attrs
    unit = attributes.get("units") or ("of the base" if "factor" in attributes else "")
    return f"{parameter} [{unit}]" if unit else parameter


def shown(data: xr.Dataset, figure: str, depth: str) -> tuple[Array, str]:
    """A figure as one number for each sample in the unit of figures, and its title."""
    values = np.asarray(one_number(data, figure).sel(depth=depth).values, dtype=float)
    unit = str(data[figure].attrs.get("units", ""))
    scale, word = (1e3, "mm") if figure.startswith("amplitude") else _SCALES.get(unit, (1.0, unit))
    words = figure.replace("_", " ")
    return values * scale, f"{words} [{word}]" if word not in ("", "1") else words
