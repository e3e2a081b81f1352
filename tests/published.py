"""Which tests hold the code against what others published; the page VERIFICATION.md is made of them.

``python -m tests.published`` writes the page.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

ROOT = Path(__file__).parents[1]
PAGE = Path(__file__).with_name("VERIFICATION.md")
_Test = TypeVar("_Test")
_HEAD = """\
# Verification: published cases and closed forms

Made by `python -m tests.published` from the marks of the tests, which hold the code against these figures
on each change. What a test asks for is in its file, with the figures and their sources; a bound here is the
loosest of the test. Own closed forms, symmetries, conservation and convergence are proved besides, in the
same folders; faults and what happens in them: [README.md](README.md).

| what | case | source | agrees within | test |
|---|---|---|---|---|
"""
PICTURES = {
    "whirl": "Whirl of two published rotors: lines from the code, circles as published.",
    "bearing": "Plain bearings: lines V2 at 96 x 12, circles an independent converged solution where "
    "Butenschoen has his.",
    "beam": "Free frequencies of a thick beam converge with the square of the elements' length.",
}
"""Figures and their words; each is a function of `tests.published_figures`."""
PARTS = {"rotor_fmu": "shaft", "bearing_fmu": "film and contact", "orchestrator": "run and judgement"}


@dataclass(frozen=True)
class Case:
    """A published case: what a mark says, and the test that bears it."""

    case: str
    source: str
    within: str
    file: Path
    test: str

    @property
    def row(self) -> str:
        """Of the table."""
        place = self.file.relative_to(PAGE.parent)
        name = self.test.replace("_", "\\_")
        return (
            f"| {PARTS[place.parts[0]]} | {self.case} | {self.source} | {self.within} | [{name}]({place}) |"
        )


def published(case: str, source: str, within: str) -> Callable[[_Test], _Test]:
    """Mark a test: which case, whose figures, how near they are met; one line each."""
    assert case and source and within
    return lambda test: test


def cases() -> Iterator[Case]:
    """All marks, read without running anything."""
    for file in sorted(PAGE.parent.rglob("test_*.py")):
        text = file.read_text(encoding="utf-8")
        if "@published" not in text:
            continue
        for node in ast.walk(ast.parse(text, str(file))):
            for mark in getattr(node, "decorator_list", ()):
                if isinstance(mark, ast.Call) and getattr(mark.func, "id", "").startswith("published"):
                    words = [ast.literal_eval(argument) for argument in mark.args]
                    yield Case(*words, file, node.name)


def page() -> str:
    """The text of the page."""
    found = sorted(cases(), key=lambda case: list(PARTS).index(case.file.relative_to(PAGE.parent).parts[0]))
    return _HEAD + "".join(f"{case.row}\n" for case in found) + "".join(_pictures())


def _pictures() -> Iterator[str]:
    """Figures below the table; `tests.published_figures` draws them."""
    yield "\n## Figures\n"
    for name, text in PICTURES.items():
        yield f"\n![{text}](verification/{name}.png)\n\n{text}\n"


if __name__ == "__main__":
    from tests.published_figures import write_all

    PAGE.write_text(page(), encoding="utf-8")
    write_all()
