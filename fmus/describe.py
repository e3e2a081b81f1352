"""Tables of a unit's variables, for its documentation."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from fmus.description import Identity
from fmus.variable import Variable

_PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{name}</title></head><body>
<h1>{name}</h1>
<p>{description} Version {version}.</p>
<p>Frame: fixed, z along the shaft, y up; SI units and rad. q = (x, y, tilt_x, tilt_y), v = dq/dt.
The affine law of a bearing is F0 - K q - C v with K = -dF/dq, C = -dF/dv, F0 = F + K q + C v.</p>
<p>The unit needs Python 3.11 or newer with numpy, scipy and numba in the process that runs it.
A refused step (fmi2Discard) gives its reason in the log.</p>
<table border="1"><tr><th>Variable</th><th>Causality</th><th>Unit</th><th>Start</th><th>Meaning</th></tr>
{rows}
</table></body></html>
"""


def page(identity: Identity, variables: Iterable[Variable]) -> bytes:
    """Return the HTML page that travels in the FMU."""
    rows = "\n".join(
        "<tr>"
        + "".join(
            f"<td>{escape(str(cell))}</td>"
            for cell in (v.name, v.causality, v.unit, "" if v.start is None else v.start, v.description)
        )
        + "</tr>"
        for v in variables
        if not v.name.startswith("node[") or v.name.startswith("node[1]")
    )
    text = _PAGE.format(
        name=escape(identity.name),
        description=escape(identity.description),
        version=escape(identity.version),
        rows=rows,
    )
    return text.encode()
