"""The energy ledger in the record, and read from there for the summary."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import xarray as xr

if TYPE_CHECKING:
    from orchestrator.observers.ledger import Balance

_FRICTION = "work_friction"
_VARIABLES = {
    "work_film": "work of the film on the shaft over the run, solid contact included",
    "work_contact": "part of it from solid contact",
    "work_received": "work that the rotor was moved by",
    "work_residue": "energy that the coupling created, negative: lost",
    "work_exchanged": "work of the film on the shaft, every step counted positive",
}


@dataclass(frozen=True)
class BearingLedger:
    """Works at one bearing in J; see `_VARIABLES`."""

    bearing: str
    film: float
    contact: float
    received: float
    residue: float
    exchanged: float


@dataclass(frozen=True)
class RotationLedger:
    """Energy of the rotation in J.

    Attributes
    ----------
    stored : float
        Change of its kinetic energy.
    drive, friction, windage : float
        Work of the drive, and what friction and windage took.
    gap : float
        What is missing between them and the work of the unbalance.
    """

    stored: float
    drive: float
    friction: float
    windage: float
    gap: float


@dataclass(frozen=True)
class LedgerSummary:
    """The ledger of a run in J.

    Attributes
    ----------
    bearings : tuple of BearingLedger
        One a bearing.
    stored : float
        Change of the energy in the shaft.
    unbalance, damping : float
        Work of the unbalance on the shaft; energy that the shaft's damping took.
    gap, relative_gap : float
        What is missing between them; against the work exchanged with all films.
    rotation : RotationLedger or None
        Where the speed may change.
    """

    bearings: tuple[BearingLedger, ...]
    stored: float
    unbalance: float
    damping: float
    gap: float
    relative_gap: float
    rotation: RotationLedger | None = None


def with_ledger(record: xr.Dataset, balance: Balance) -> xr.Dataset:
    """The record with the ledger of its run."""
    film, contact, received, exchanged = balance.bearings.T
    columns = (film, contact, received, balance.residue, exchanged)
    variables = {
        name: ("bearing", values, {"units": "J", "long_name": text})
        for (name, text), values in zip(_VARIABLES.items(), columns, strict=True)
    }
    found = balance.rotation
    turned: dict[str, float] = {}
    if found is not None:
        words = {"units": "J", "long_name": "energy that friction took from the rotation over the run"}
        variables[_FRICTION] = ("bearing", found.friction, words)
        turned = {
            "rotation_energy_stored": found.stored,
            "work_of_drive": found.drive,
            "energy_lost_in_windage": found.windage,
            "rotation_gap": found.gap(balance.unbalance),
        }
    return record.assign(variables).assign_attrs(
        turned,
        energy_stored=balance.stored,
        work_of_bearings=balance.bearing_work,
        work_of_unbalance=balance.unbalance,
        energy_lost_in_damping=balance.damping,
        ledger_gap=balance.gap,
        ledger_gap_relative=balance.relative_gap,
    )


def ledger_of(record: xr.Dataset) -> LedgerSummary | None:
    """The ledger in a record; None where none was kept."""
    if "work_film" not in record:
        return None
    columns = [record[name].values for name in _VARIABLES]
    names = [str(name) for name in record["bearing"].values]
    rows = (BearingLedger(name, *(float(c[k]) for c in columns)) for k, name in enumerate(names))
    attributes = record.attrs
    return LedgerSummary(
        tuple(rows),
        stored=float(attributes["energy_stored"]),
        unbalance=float(attributes["work_of_unbalance"]),
        damping=float(attributes["energy_lost_in_damping"]),
        gap=float(attributes["ledger_gap"]),
        relative_gap=float(attributes["ledger_gap_relative"]),
        rotation=_rotation_of(record),
    )


def _rotation_of(record: xr.Dataset) -> RotationLedger | None:
    if _FRICTION not in record:
        return None
    names = ("rotation_energy_stored", "work_of_drive", "energy_lost_in_windage", "rotation_gap")
    stored, drive, windage, gap = (float(record.attrs[name]) for name in names)
    return RotationLedger(stored, drive, float(record[_FRICTION].sum()), windage, gap)
