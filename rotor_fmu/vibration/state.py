"""The state of a running rotor, copyable and as bytes."""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.vibration.trail import Trail
from rotor_fmu.vibration.work import Work

Array = NDArray[np.float64]

_HEADER = struct.Struct("<8s5q12d16s")
_MAGIC = b"rotor\0\0\7"  # the last byte is the version of the layout


@dataclass(eq=False, slots=True)  # not frozen: one is made at every step, and that takes five times as long
class RotorState:
    """All that a step depends on besides its arguments; never changed in place.

    Attributes
    ----------
    motion : ndarray, (2 m,)
        The vibration about the static equilibrium, see `rotor_fmu.vibration.coordinates`.
    angle : float
        Angle of rotation theta [rad], in [-2 pi, 2 pi].
    static : Equilibrium
        The static equilibrium: n displacements, 4 n_b journal displacements and wrenches.
    speed : float or None
        To which the coordinates of the motion belong [rad/s]; None for modal ones.
    basis : bytes
        Their fingerprint, 16 bytes; empty where the motion is (p, p').
    work : Work
        Done since the start, if the rotor keeps account of it.
    turning : float or None
        Speed of rotation now [rad/s]; None for that of the start.
    owed : float
        Energy that a free rotation is still to gain [J], see `rotor_fmu.vibration.spin`.
    time : float
        Instant [s].
    trail : Trail or None
        Of the step before, where there are journals without mass.
    journals : ndarray, (n_b, 8), or None
        Their motion; None where it is yet to be found from the vibration.
    """

    motion: Array
    angle: float
    static: Equilibrium[np.float64]
    speed: float | None = None
    basis: bytes = b""
    work: Work = field(default_factory=Work)
    turning: float | None = None
    owed: float = 0.0
    time: float = 0.0
    trail: Trail | None = None
    journals: Array | None = None

    def to_bytes(self) -> bytes:
        """Write, little endian, without loss."""
        static, trail = self.static, self.trail
        behind = (trail.slope, trail.lead) if trail is not None else ()
        where = (self.journals,) if self.journals is not None else ()
        sizes = (len(self.motion), len(static.shape), len(static.wrench), len(behind), len(where))
        speeds = (math.nan if speed is None else speed for speed in (self.speed, self.turning))
        header = _HEADER.pack(
            _MAGIC,
            *sizes,
            self.angle,
            *speeds,
            self.owed,
            self.time,
            trail.step if trail is not None else 0.0,
            *self.work,
            self.basis,
        )
        arrays = (self.motion, static.shape, static.journals, static.wrench, *behind, *where)
        return header + b"".join(a.astype("<f8").tobytes() for a in arrays)

    @classmethod
    def from_bytes(cls, data: bytes) -> RotorState:
        """Read what `to_bytes` wrote.

        Raises
        ------
        ValueError
            If the bytes are not a rotor state.
        """
        if len(data) < _HEADER.size or data[: len(_MAGIC)] != _MAGIC:
            raise ValueError("rotor state: these bytes are not a rotor state of this version")
        _, states, displacements, loads, behind, where, angle, *numbers, basis = _HEADER.unpack_from(data)
        if behind not in (0, 2) or where not in (0, 1):
            raise ValueError(f"rotor state: {behind}, {where} more arrays; allowed are 0 or 2, and 0 or 1")
        sizes = (states, displacements, loads, loads, *[loads] * behind, *[2 * loads] * where)
        if min(sizes) < 0 or len(data) != _HEADER.size + 8 * sum(sizes):
            raise ValueError(f"rotor state: {len(data)} bytes do not hold arrays of {sizes} numbers")
        values = np.frombuffer(data, dtype="<f8", offset=_HEADER.size).astype(np.float64)
        motion, shape, journals, wrench, *more = np.split(values, np.cumsum(sizes)[:-1])
        speed, turning = (None if math.isnan(speed) else speed for speed in numbers[:2])
        static = Equilibrium(shape, journals, wrench)
        work, last = Work(*numbers[5:]), Trail(more[0], more[1], numbers[4]) if behind else None
        moved = more[-1].reshape(-1, 8) if where else None
        owed, time = numbers[2:4]
        return cls(motion, angle, static, speed, basis, work, turning, owed, time, last, moved)
