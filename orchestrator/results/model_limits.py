"""Where the model of the train no longer holds: linear shaft, rigid bore, nothing that breaks or rubs.

None of the limits is a design limit.  Each is where results stop to mean anything, far above what a machine
survives: a run beyond one of them is a run of another machine.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.train.train import Train

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

STRENGTH = 1e9
"""Stress in Pa that no shaft bears without yielding, where its material names no ``yield_strength``; steels
of large rotors yield at 0.6 to 0.9e9."""

CASING = 0.01
"""Vibration amplitude of a wheel against its mean diameter at which blades have run into the casing: radial
gaps are some thousandths."""

SLOPE = 0.05
"""Slope of a journal in rad up to which sine and angle agree to 4e-4, as shaft and film take them."""

OVERLAP = 0.1
"""Depth by which a journal may stand in its bore, against the clearance; surfaces and the metal of the
layer give way by less."""


@dataclass(frozen=True)
class Beyond:
    """Where a run left its model.

    Attributes
    ----------
    time : float
        First instant in s.
    text : str
        When, what, where, and what is allowed; further limits passed later on.
    """

    time: float
    text: str


def beyond_model(record: xr.Dataset, train: Train) -> Beyond | None:
    """Find the first limit that a run passed.

    Parameters
    ----------
    record : xarray.Dataset
        A run of the train; what it does not hold is not looked at.
    train : Train
        Materials, wheels and bearings.
    """
    passed = sorted(_passed(record, train), key=lambda found: found[0])
    if not passed:
        return None
    time, first = passed[0]
    others = "".join(f"; t = {t:.6g} s: {text}" for t, text in passed[1:])
    return Beyond(time, f"the model no longer holds from t = {time:.6g} s on: {first}{others}")


def _passed(record: xr.Dataset, train: Train) -> Iterator[tuple[float, str]]:
    """Yield time and text of each limit that was passed, at its first instant."""
    time = record["time"].values
    names = [str(name) for name in record["bearing"].values]

    def first(values: Array, limits: Array) -> tuple[int, int] | None:
        """Return sample and place where the values (time, place) pass their limits first, most of all."""
        over = values > limits
        if not over.any():
            return None
        sample = int(np.argmax(over.any(axis=1)))
        return sample, int(
            np.argmax(np.where(over[sample], values[sample] / np.nan_to_num(limits, nan=np.inf), 0.0))
        )

    if "stress" in record:
        stress, strength = record["stress"].transpose("time", "node").values, _strength(train)
        if found := first(stress, strength):
            sample, node = found
            yield (
                float(time[sample]),
                f"stress {stress[found] / 1e6:.4g} N/mm2 at z = {train.z[node]:.4g} m, above the strength "
                f"of the shaft, {strength[node] / 1e6:.4g} N/mm2",
            )
    wheels = [wheel for wheel in train.wheels if wheel.mean_diameter > 0.0]
    if "amplitude" in record and wheels:
        at = [wheel.node for wheel in wheels]
        amplitude = record["amplitude"].transpose("time", "node").values[:, at]
        if found := first(amplitude, CASING * np.array([wheel.mean_diameter for wheel in wheels])):
            yield (
                float(time[found[0]]),
                f"vibration of {1e3 * amplitude[found]:.4g} mm at wheel {wheels[found[1]].name!r}, more than "
                f"{100 * CASING:g} % of its mean diameter and any gap to the casing",
            )
    if "tilt" in record:
        slope = np.abs(record["tilt"].transpose("time", "bearing", "axis").values).max(axis=2)
        if found := first(slope, np.full(len(names), SLOPE)):
            yield (
                float(time[found[0]]),
                f"slope {slope[found]:.3g} rad of the journal at {names[found[1]]}, beyond small motion "
                f"({SLOPE:g})",
            )
    if "least_gap_min" in record:
        depth = -record["least_gap_min"].transpose("time", "bearing").values
        if found := first(depth, OVERLAP * np.array([seat.clearance for seat in train.bearings])):
            yield (
                float(time[found[0]]),
                f"journal {1e6 * depth[found]:.4g} um deep in the bore at {names[found[1]]}, more than "
                f"{100 * OVERLAP:g} % of the clearance",
            )


def _strength(train: Train) -> Array:
    """Strength at each node: the lesser of both sides, of what the materials say or of `STRENGTH`."""
    stiff = [[ring.material for ring in shoulder.rings if ring.stiff] for shoulder in train.shoulders]
    given = [min((m.yield_strength or STRENGTH for m in materials), default=np.inf) for materials in stiff]
    return np.minimum(np.array([given[0], *given]), np.array([*given, given[-1]]))
