"""The page of the variables lists the port as it is."""

import re

from fmus import port
from fmus.build import describe


def test_the_tables_of_the_page_match_the_port():
    text = describe.PAGE.read_text(encoding="utf-8")
    assert describe.with_tables(text) == text, "run python -m fmus.build.describe"


def test_every_variable_stands_in_the_tables(small_train):
    text = describe.PAGE.read_text(encoding="utf-8")
    names = [b.name for b in small_train.bearings], [w.name for w in small_train.wheels]
    indices = {"bearing": "i", "wheel": "j", "node": "k", "K": "r,c", "C": "r,c", "pad_tilt": "p"}
    for variable in (*port.BEARING, *port.rotor(*names, small_train.nodes)):
        name = re.sub(r"(\w+)\[[\d,]+\]", lambda m: f"{m[1]}[{indices[m[1]]}]", variable.name)
        tunable = ", tunable" if variable.tunable else ""
        assert f"| `{name}` | {variable.causality}{tunable} |" in text


def test_every_variable_has_a_meaning_and_the_dimensionless_are_known():
    bare = {
        "eccentricity",
        "sommerfeld",
        "contact.friction",
        "layer.poisson",
        "feed_content",
        "full_film",
        "film.whirl",
        "wiped",
        "contact_area",
        *port.SWITCHES,
        "losses.come",
    }
    for variable in (*port.BEARING, *port.rotor(["b"], ["w"], 2)):
        assert variable.description
        if variable.kind == "Real" and not variable.unit:
            assert variable.name in bare
