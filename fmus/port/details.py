"""What only some films tell beyond the port's outputs, and what only they are told."""

from __future__ import annotations

from fmus.port.variable import Variable

MOST_PADS = 8
"""Tilting pads that a bearing may have."""

DETAILS: tuple[Variable, ...] = tuple(
    Variable(name, "output", unit, text, minimum=minimum, nominal=nominal)
    for name, unit, text, minimum, nominal in (
        ("full_film", "", "of a mass-conserving film: share of the bore that it fills", 0.0, 1.0),
        ("oil_fed", "m3/s", "of a mass-conserving film: oil that enters from the grooves", None, 1e-3),
        *(
            (f"pad_tilt[{k}]", "rad", f"tilt of pad {k} about its pivot, from x to y", None, 1e-4)
            for k in range(1, MOST_PADS + 1)
        ),
    )
)

WHIRL = Variable(
    "film.whirl",
    "parameter",
    "",
    "of tilting pads: frequency over the speed of the small motions for which K and C at the start hold; 0: "
    "of a position that changes slowly",
    0.0,
    minimum=0.0,
    maximum=100.0,
    nominal=1.0,
)
