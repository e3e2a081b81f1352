"""The FMU state, and as bytes: one block that holds a unit to the last bit."""

from __future__ import annotations

import json
import struct
from typing import NamedTuple, Protocol, Self

_HEADER = struct.Struct("<16sBBBBIIId")


class ModelState(Protocol):
    """What a model holds beyond the values of its unit; never changed in place."""

    def to_bytes(self) -> bytes:
        """Write without loss."""

    @classmethod
    def from_bytes(cls, data: bytes, /) -> Self:
        """Read what `to_bytes` wrote; ValueError if it is damaged."""


class UnitState(NamedTuple):
    """What a unit's state holds; taken at every step that may be taken back, so the model is not packed yet.

    Attributes
    ----------
    mode : int
        Where the unit stands in the FMI state machine.
    prepared, unsolved : bool
        A model belongs to the parameters; something was set since the start was solved.
    stale : int
        One bit for each group of lazy variables that does not belong to the present state.
    start_time : float
        Time at the start [s].
    values : bytes
        All numbers, float64 in the order of the value references.
    texts : list of str
        Failure, misuse, then the String variables.
    model : ModelState or None
        State of the model; None where it has none.
    """

    mode: int
    prepared: bool
    unsolved: bool
    stale: int
    start_time: float
    values: bytes
    texts: list[str]
    model: ModelState | None

    def pack(self, digest: bytes) -> bytes:
        """Return the state as bytes, marked as that of the FMU `digest` (16 bytes)."""
        model = b"" if self.model is None else self.model.to_bytes()
        texts = json.dumps(self.texts).encode() if any(self.texts) else b""
        sizes = len(self.values), len(texts), len(model)
        flags = self.prepared, self.unsolved, self.stale
        header = _HEADER.pack(digest, self.mode, *flags, *sizes, self.start_time)
        return b"".join((header, self.values, texts, model))


def unpack(state: bytes, digest: bytes, texts: int, model: type[ModelState] | None) -> UnitState:
    """Read what `UnitState.pack` wrote.

    Parameters
    ----------
    state : bytes
        The packed state.
    digest : bytes
        Digest of the FMU that reads.
    texts : int
        Number of texts of the unit.
    model : type or None
        Of the model's state.

    Raises
    ------
    ValueError
        If it comes from another FMU or is damaged.
    """
    start = _HEADER.size
    if len(state) < start or state[:16] != digest:
        raise ValueError("the FMU state does not come from this FMU")
    _, mode, prepared, unsolved, stale, n_values, n_texts, n_model, time = _HEADER.unpack_from(state)
    if len(state) != start + n_values + n_texts + n_model:
        raise ValueError("the FMU state is damaged")
    read = json.loads(state[start + n_values : start + n_values + n_texts]) if n_texts else [""] * texts
    packed = state[start + n_values + n_texts :]
    return UnitState(
        mode,
        bool(prepared),
        bool(unsolved),
        stale,
        time,
        state[start : start + n_values],
        read,
        model.from_bytes(packed) if model is not None and packed else None,
    )
