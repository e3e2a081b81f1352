"""Tables of a unit's variables, for the page beside them and the one inside each FMU.

``python -m fmus.build.describe`` writes the tables anew into `VARIABLES.md`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from html import escape
from pathlib import Path

from fmus import port
from fmus.build.description import Identity
from fmus.port.variable import Variable

PAGE = Path(__file__).parents[1] / "VARIABLES.md"
_INDEX = {"bearing": "i", "wheel": "j", "node": "k", "K": "r,c", "C": "r,c", "pad_tilt": "p"}
_OF_TRAIN = re.compile(r"speed|bearing\[i\]\.(F0\.Fy|start\..*)|wheel\[j\]\.unbalance.*")

_PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{name}</title></head><body>
<h1>{name}</h1>
<p>{description} Version {version}.</p>
<p>Frame: fixed, z along the shaft, y up; SI units and rad. q = (x, y, tilt_x, tilt_y), v = dq/dt.
The affine law of a bearing is F0 - K q - C v with K = -dF/dq, C = -dF/dv, F0 = F + K q + C v;
of a film on a soft layer K counts besides what the wall goes on to give way over the next step.</p>
<p>The unit needs Python 3.11 or newer with numpy, scipy and numba in the process that runs it.
A refused step (fmi2Discard) gives its reason in the log.</p>
<table border="1"><tr><th>Variable</th><th>Causality</th><th>Unit</th><th>Start</th><th>Meaning</th></tr>
{rows}
</table></body></html>
"""


def page(identity: Identity, variables: Iterable[Variable]) -> bytes:
    """Return the HTML page that travels in the FMU; of the nodes it lists the first."""
    listed = (v for v in variables if not re.match(r"node\[(?!1\])", v.name))
    cells = ((v.name, v.causality, _unit(v), _start(v), v.description) for v in listed)
    rows = "\n".join("<tr>" + "".join(f"<td>{escape(c)}</td>" for c in row) + "</tr>" for row in cells)
    named = {key: escape(value) for key, value in vars(identity).items() if isinstance(value, str)}
    return _PAGE.format(rows=rows, **named).encode()


def table(variables: Iterable[Variable], of_train: re.Pattern[str] | None = None) -> str:
    """Return a Markdown table; arrays take one line.

    Parameters
    ----------
    variables : iterable of Variable
        The port.
    of_train : pattern, optional
        Variables whose start values come from the train.
    """
    lines = ["| variable | causality | unit | start | meaning |", "|---|---|---|---|---|"]
    for name, group in _grouped(variables).items():
        first = group[0]
        units = ", ".join(dict.fromkeys(_unit(v) for v in group))
        start = "of the train" if of_train and of_train.fullmatch(name) else _start(first)
        meaning = re.sub(r"-d\w+/d\w+", lambda m: _tangent(m[0]), first.description)
        meaning = re.sub(r"shaft node 1\b", "shaft node k", meaning).replace("of pad 1 ", "of pad p ")
        causality = f"{first.causality}, tunable" if first.tunable else first.causality
        meaning = meaning.replace("|", r"\|")
        lines.append(f"| `{name}` | {causality} | {units} | {start} | {meaning} |")
    return "\n".join(lines)


def _grouped(variables: Iterable[Variable]) -> dict[str, list[Variable]]:
    """Return variables by name, with letters for the indices."""
    groups: dict[str, list[Variable]] = {}
    for v in variables:
        name = re.sub(r"(\w+)\[[\d,]+\]", lambda m: f"{m[1]}[{_INDEX[m[1]]}]", v.name)
        groups.setdefault(name, []).append(v)
    return groups


def _tangent(derivative: str) -> str:
    return "-dF_r/dv_c" if "/dv_" in derivative else "-dF_r/dq_c"


def _unit(variable: Variable) -> str:
    return variable.unit or ("1" if variable.kind == "Real" else variable.kind)


def _start(variable: Variable) -> str:
    if variable.start is None:
        return ""
    return f"{variable.start:g}" if isinstance(variable.start, float) else str(variable.start).lower()


def tables() -> Iterator[tuple[str, str]]:
    """Yield the tables of the page by name."""
    yield "bearing", table(port.BEARING)
    yield "rotor", table(port.rotor(["bearing i"], ["wheel j"], 1, moving=True), _OF_TRAIN)


def with_tables(text: str) -> str:
    """Return the page with its tables, which stand between comments, written anew."""
    for name, content in tables():
        begin, end = f"<!-- table: {name} -->", f"<!-- end: {name} -->"
        head, _, rest = text.partition(begin)
        text = f"{head}{begin}\n{content}\n{end}{rest.partition(end)[2]}"
    return text


if __name__ == "__main__":
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
