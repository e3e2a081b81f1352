"""Revolutions in the record, and read from there for figures."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.observers.revolutions import ORDERS, Revolutions

NAME = "revolution_amplitude"
_EXTREMES = {
    "least_gap": ("m", "least gap in the revolution"),
    "contact_force": ("N", "largest solid contact force in the revolution"),
    "force": ("N", "largest bearing force in the revolution"),
}


def with_revolutions(record: xr.Dataset, kept: Revolutions) -> xr.Dataset:
    """The record with what each revolution was like."""
    amplitudes = kept.amplitudes
    parts = np.stack([amplitudes.real, amplitudes.imag], axis=-1)
    where = ("revolution", "order", "bearing", "axis", "part")
    motion = "motion of the journal in its housing"
    variables: dict[str, Any] = {
        NAME: (where, parts, _words("m", f"amplitude of an order in the {motion}, real and imaginary")),
        "revolution_overall": (
            ("revolution", "bearing", "axis"), kept.overall.copy(),
            _words("m", f"peak to peak of the {motion}"),
        ),
        "revolution_speed": (
            "revolution", kept.speeds.copy(), _words("rad/s", "mean speed in the revolution"),
        ),
    }  # fmt: skip
    for name, (unit, text) in _EXTREMES.items():
        variables[f"revolution_{name}"] = (
            ("revolution", "bearing"), kept.extreme(name).copy(), _words(unit, text),
        )  # fmt: skip
    coordinates = {
        "revolution": ("revolution", kept.times.copy(), _words("s", "end of the revolution")),
        "order": ("order", list(ORDERS), {"long_name": "order of the rotational speed", "units": "1"}),
        "part": ("part", ["real", "imaginary"], {"long_name": "part of the complex amplitude"}),
    }
    return record.assign(variables).assign_coords(coordinates)


def order_of(record: xr.Dataset, bearing: str, order: float, angle: float) -> NDArray[np.complex128]:
    """Amplitude of an order at a probe at an angle from x towards y [rad], (revolutions,) in m."""
    found = record[NAME].sel(bearing=bearing, order=order).transpose("part", "axis", "revolution").values
    x, y = found[0] + 1j * found[1]
    return np.asarray(np.cos(angle) * x + np.sin(angle) * y)


def _words(unit: str, text: str) -> dict[str, str]:
    return {"units": unit, "long_name": text}
