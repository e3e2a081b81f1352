"""Every key of a scenario and of a train in tables, made from the models.

``python -m orchestrator.scenario.reference`` writes it into the page beside this file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from inspect import cleandoc
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from bearing_fmu import depths
from orchestrator.scenario.events import KINDS
from orchestrator.scenario.rotation import Rotation
from orchestrator.scenario.scenario import (
    COUPLINGS,
    REDUCTIONS,
    FilmSettings,
    RecordSettings,
    Scenario,
    Unbalance,
    WheelUnbalance,
)
from rotor_fmu.train.entry import unit_of
from rotor_fmu.train.pedestal import PedestalEntry
from rotor_fmu.train.schema import (
    BearingEntry,
    CouplingEntry,
    DampingEntry,
    MassEntry,
    MaterialEntry,
    TrainToml,
    WheelEntry,
)
from rotor_fmu.train.seat import Pedestal
from rotor_fmu.train.shoulder import Joint
from rotor_fmu.train.train import BearingSeat, Coupling, Material, Train, Wheel

_TABLES: tuple[tuple[str, type[BaseModel]], ...] = (
    ("", Scenario),
    ("film.", FilmSettings),
    ("record.", RecordSettings),
    ("rotation.", Rotation),
    ("unbalance.", Unbalance),
    ("unbalance.at.WHEEL.", WheelUnbalance),
    *((f"events ({name}).", kind) for name, kind in KINDS.items()),
)
_TRAIN: tuple[tuple[str, type[BaseModel], tuple[type, ...]], ...] = (
    ("", TrainToml, (Train,)),
    ("damping.", DampingEntry, ()),
    ("materials.NAME.", MaterialEntry, (Material,)),
    ("bearing.", BearingEntry, (BearingSeat,)),
    ("bearing.pedestal.", PedestalEntry, (Pedestal,)),
    ("wheel.", WheelEntry, (Wheel,)),
    ("mass.", MassEntry, (Wheel,)),
    ("coupling.", CouplingEntry, (Coupling, Joint)),
)
"""Tables of train.toml, and the classes whose docstrings tell what their keys are."""
_OWN_WORDS = {  # of a key in any table, or in one
    "shaft": "Name of the table of shoulders beside the file.",
    "z": "Axial position.",
    "name": "1 to 40 letters a to z, digits, spaces, points, hyphens and underscores.",
    "preload": "1 - (least gap of the centred journal) / clearance, of bores of lobes; of pads at the pivot.",
    "offset": "Share of a lobe's length at which it comes closest, of a pad its pivot; usually 0.5.",
    "first": "Angle at which a lobe, or the share of a pad, begins, from x towards y.",
    "pads": "Number of tilting pads, 4 by itself.",
    "pad_arc": "Angle that a pad covers; by itself its share of the turn less 10 degrees.",
    "pivot_stiffness": "Of each pad's pivot; by itself rigid.",
    "pockets": "Pockets and feed holes, `[{at, width, share, depth, fed}]`; see `bearing_fmu`.",
    "grooves": "Axial grooves, `[{at, width}]`.",
    "arcs": "Arcs of any bore, `[{start, end, preload, towards}]`.",
    "bearing.stiffness": "In place of a film: a number, or 2 x 2 or 4 x 4.",
    "bearing.damping": "Beside `stiffness`, likewise.",
    "damping": "Of the shaft: the keys below.",
    "bearing.pedestal.mass": "In x and in y, or one number for both.",
    "bearing.pedestal.stiffness": "To firm ground, likewise.",
    "bearing.pedestal.damping": "Likewise.",
    "bearing.pedestal.inertia": "About x and y; without it, or without `tilt_stiffness`, it does not tilt.",
    "bearing.pedestal.tilt_stiffness": "About x and about y, or one number for both.",
    "bearing.pedestal.tilt_damping": "Likewise.",
    "table": "In place of a film: name of a table of stiffness and damping over speed.",
    "oil": "In place of `viscosity`: a grade of ISO 3448, as `VG 46`; the film finds its temperature.",
    "viscosity_index": "Of the grade, after ISO 2909; 95 by itself.",
    "viscosity_40": "In place of `viscosity`, with `viscosity_100`: kinematic viscosity of the oil at 40 °C.",
    "viscosity_100": "The same at 100 °C.",
    "supply_temperature": "Temperature at which the oil is supplied.",
    "heat_capacity": "Specific heat capacity of the oil.",
    "heat_storage": "What warms with a film whose temperature is followed; 0: the oil in its gap.",
    "side": "`front` or `rear` of the elastic coupling at the same z.",
    "bore": "plain, lemon, two-lobe, offset-halves, three-lobe, four-lobe, tilting-pads; or `arcs`.",
    "foundation": "Name of a table with the modes of a foundation beside the file.",
    "pedestal": "What the bearing stands on: the keys below.",
    "materials": "At least one.",
    "bearing": "At least one.",
    "alpha": "Damping of the mass, D = alpha M + beta K.",
    "beta": "Damping of the stiffness.",
}
_LISTS = {"REDUCTIONS": REDUCTIONS, "COUPLINGS": COUPLINGS, "bearing_fmu.depths": depths.names()}
PAGE = Path(__file__).with_name("README.md")
_MARKS = ("keys", "train-keys")
_ENTRY = re.compile(r"^(\S.*?) : .*$\n((?:^(?:    .*|)$\n?)+)", re.MULTILINE)


def reference() -> str:
    """A Markdown table: key, default, what it is."""
    lines = ["| key | default | what it is |", "|---|---|---|"]
    for prefix, model in _TABLES:
        texts = _texts(model)
        for name, field in model.model_fields.items():
            if field.exclude:
                continue
            default = "*must be given*" if field.is_required() else _shown(field.get_default())
            lines.append(f"| `{prefix}{name}` | {default} | {texts.get(name, '')} |")
    return "\n".join(lines) + "\n"


def train_reference() -> str:
    """A Markdown table of train.toml: key, unit, allowed values, default, what it is."""
    lines = ["| key | unit | allowed | default | what it is |", "|---|---|---|---|---|"]
    for prefix, model, classes in _TRAIN:
        texts = {k: v for one in classes for k, v in _entries(cleandoc(one.__doc__ or ""))} | _OWN_WORDS
        for name, field in model.model_fields.items():
            if isinstance(field.default, list) and name in ("bearing", "wheel", "mass", "coupling"):
                continue
            default = "*must be given*" if field.is_required() else _shown(field.get_default())
            words = _OWN_WORDS.get(prefix + name) or texts.get(name, "")
            cells = f"`{prefix}{name}`", unit_of(model, name), _allowed(field), default, words
            lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _allowed(field: FieldInfo) -> str:
    """The range of a number."""
    signs = {"gt": "> ", "ge": "≥ ", "lt": "< ", "le": "≤ "}
    bounds = (
        f"{sign}{getattr(item, key):g}"
        for item in field.metadata
        for key, sign in signs.items()
        if isinstance(getattr(item, key, None), float | int)
    )
    return ", ".join(bounds)


def _texts(model: type[BaseModel]) -> dict[str, str]:
    """What the docstrings of a model and its bases say of each attribute."""
    found: dict[str, str] = {}
    for base in reversed(model.__mro__):
        if issubclass(base, BaseModel) and base.__doc__:
            found |= dict(_entries(cleandoc(base.__doc__)))
    return found


def _entries(text: str) -> Iterator[tuple[str, str]]:
    _, _, attributes = text.partition("Attributes\n----------\n")
    for names, words in _ENTRY.findall(attributes + "\n"):
        sentence = " ".join(words.split()).replace("|", "\\|")
        for listed, values in _LISTS.items():
            sentence = sentence.replace(f"one of `{listed}`", ", ".join(values))
        for name in names.split(","):
            yield name.strip(), sentence


def _shown(value: Any) -> str:
    """A default as a file would have it."""
    if value is None or value == "" or value == () or value == {} or isinstance(value, BaseModel):
        return "-"
    return f"`{str(value).lower()}`" if isinstance(value, bool) else f"`{value!r}`".replace("'", '"')


def page(text: str) -> str:
    """The page with the tables between their marks."""
    for mark, table in zip(_MARKS, (reference(), train_reference()), strict=True):
        head, _, rest = text.partition(f"<!-- {mark} -->")
        text = f"{head}<!-- {mark} -->\n{table}<!-- /{mark} -->" + rest.partition(f"<!-- /{mark} -->")[2]
    return text


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
