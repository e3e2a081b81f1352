"""What hypothesis does to a valid file: to its bytes, and to its lines and values."""

from __future__ import annotations

import re
from zipfile import ZIP_STORED, ZipFile

from hypothesis import strategies as st

from tests.properties.journals import logarithmic

_WORDS = st.sampled_from(
    [
        "nan",
        "inf",
        "-inf",
        "0",
        "-1",
        "1e400",
        "1e-400",
        "99999999999999999999",
        "true",
        "[]",
        "{}",
        "''",
        '""',
        "=",
        ",",
        "[[",
        "]]",
        "#",
        "\\",
        "../../x",
        "%00",
        "é",
        "\ufeff",
        "<x>",
        "</x>",
        "&amp;",
        "&x;",
        "<!--",
    ]
)
_VALUES = st.one_of(
    _WORDS,
    st.integers(-(2**70), 2**70).map(str),
    st.floats().map(repr),
    logarithmic(1e-12, 1e12).map(repr),
    st.text(max_size=8),
)
_VALUE = re.compile(r'"[^"\n]*"|[-+]?\b\d[\d.eE+-]*\b|\b[A-Za-z_][A-Za-z0-9_.-]*\b')


@st.composite
def bytes_of(draw, content: bytes) -> bytes:
    """The content with up to four pieces of it replaced, taken out, doubled or cut off."""
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(content)))
        length = draw(st.sampled_from([0, 1, 1, 4, 40, 4000]))
        kind = draw(st.sampled_from(["replace", "remove", "double", "cut"]))
        if kind == "cut":
            content = content[:at]
        elif kind == "double":
            content = content[: at + length] + content[at:]
        else:
            put = draw(st.binary(min_size=1, max_size=8)) if kind == "replace" else b""
            content = content[:at] + put + content[at + length :]
    return content


@st.composite
def lines_of(draw, text: str) -> str:
    """The text with up to four of its lines taken out, doubled, moved, or a value in them replaced."""
    lines = text.splitlines()
    for _ in range(draw(st.integers(1, 4))):
        if not lines:
            break
        at = draw(st.integers(0, len(lines) - 1))
        kind = draw(st.sampled_from(["value", "value", "value", "remove", "double", "move"]))
        if kind == "value":
            lines[at] = draw(_with_other_value(lines[at]))
        elif kind == "remove":
            del lines[at]
        elif kind == "double":
            lines.insert(at, lines[at])
        else:
            lines.insert(draw(st.integers(0, len(lines) - 1)), lines.pop(at))
    return "\n".join(lines) + "\n"


@st.composite
def _with_other_value(draw, line: str) -> str:
    places = list(_VALUE.finditer(line))
    if not places:
        return draw(_VALUES)
    place = draw(st.sampled_from(places))
    old = place.group()
    new = draw(_VALUES)
    if old.startswith('"') and draw(st.booleans()):
        new = '"' + new.replace('"', "").replace("\n", "") + '"'
    return line[: place.start()] + new + line[place.end() :]


def zipped(members: dict[str, bytes], target) -> None:
    """Write members as they are."""
    with ZipFile(target, "w", ZIP_STORED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)


def unzipped(path) -> dict[str, bytes]:
    """Members of an archive by name."""
    with ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}
