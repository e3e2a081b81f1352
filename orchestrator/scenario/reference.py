"""Every key of a scenario in a table, made from the models.

``python -m orchestrator.scenario.reference`` writes it into the page beside this file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from inspect import cleandoc
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from bearing_fmu import depths
from orchestrator.scenario.events import KINDS
from orchestrator.scenario.scenario import (
    COUPLINGS,
    REDUCTIONS,
    FilmSettings,
    RecordSettings,
    Scenario,
    Unbalance,
    WheelUnbalance,
)

_TABLES: tuple[tuple[str, type[BaseModel]], ...] = (
    ("", Scenario),
    ("film.", FilmSettings),
    ("record.", RecordSettings),
    ("unbalance.", Unbalance),
    ("unbalance.at.WHEEL.", WheelUnbalance),
    *((f"events ({name}).", kind) for name, kind in KINDS.items()),
)
_LISTS = {"REDUCTIONS": REDUCTIONS, "COUPLINGS": COUPLINGS, "bearing_fmu.depths": depths.names()}
PAGE = Path(__file__).with_name("README.md")
_START, _END = "<!-- keys -->", "<!-- /keys -->"
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
    """The page with the table between its marks."""
    head, _, rest = text.partition(_START)
    return head + _START + "\n" + reference() + _END + rest.partition(_END)[2]


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
