"""On which line a value of a TOML text stands, however it is written; what is no TOML at all."""

from __future__ import annotations

import pytest

from rotor_fmu.train.toml_source import LARGEST, TomlError, TomlSource, read_toml
from tests.faults import fault

TEXT = '''\
# a comment
plain = 1

dotted.key = 2
"quoted key" = 3
inline = { a = 1, b = { c = 2 } }
long = """
plain = 9
[[table]]
"""
many = [
    1,
    2,
]
[table.inner]
x = 1

[[list]]  # the first
name = "a"
[[list]]
  name = "b"
  [list.deep]
  y = 2
'''


@pytest.mark.parametrize(
    ("location", "line"),
    [
        (("plain",), 2),
        (("dotted", "key"), 4),
        (("quoted key",), 5),
        (("inline", "b", "c"), 6),
        (("long",), 7),
        (("many",), 11),
        (("many", 1), 11),
        (("table",), 15),
        (("table", "inner", "x"), 16),
        (("list", 0), 18),
        (("list", 0, "name"), 19),
        (("list", 1), 20),
        (("list", 1, "name"), 21),
        (("list", 1, "deep", "y"), 23),
        (("list", 1, "missing"), 20),
        (("table", "inner", "missing", "deeper"), 15),
        (("missing",), None),
        ((), None),
    ],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_the_line_of_a_value(location, line, newline):
    source = TomlSource(TEXT.replace("\n", newline))
    assert source.line(location) == line
    assert list(source.located([(location, "words")])) == ["words" if line is None else f"line {line}: words"]


@fault(
    "input",
    "a file with thousands of problems",
    "exit 2 within seconds; all of them, the first hundred with their lines",
    guard="rotor_fmu.train.toml_source:LOCATED",
)
def test_the_lines_of_many_problems_are_not_looked_for():
    count = 107
    source = TomlSource("\n".join(f"k{i} = {i}" for i in range(count)))
    said = list(source.located(((f"k{i}",), "words") for i in range(count)))
    assert said == [f"line {i + 1}: words" for i in range(100)] + 7 * ["words"]


@fault(
    "input",
    "a file that is no TOML",
    "exit 2; file, line and column, what is wrong there",
    guard="rotor_fmu.train.toml_source:TomlSource.__init__",
)
@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"a = 1\nb = = 2\n", r"not TOML: Invalid value \(at line 2, column 5\)"),
        (b"a = 1\na = 2\n", r"not TOML: Cannot overwrite a value \(at line 2"),
        (b"\xff\xfe", "not TOML: .*utf-8"),
        (b"a = " + 10_000 * b"[", "not TOML: nested too deeply"),
        (b"a\x00", "not TOML: "),
    ],
)
def test_what_is_no_toml(tmp_path, content, words):
    (tmp_path / "a.toml").write_bytes(content)
    with pytest.raises(TomlError, match=words):
        read_toml(tmp_path / "a.toml")


@fault(
    "input",
    "a file of the wrong kind or of gigabytes in place of a TOML",
    "exit 2; refused unread, with its size and what is allowed",
    guard="rotor_fmu.train.toml_source:read_toml",
)
def test_a_file_that_is_too_large_or_none(tmp_path):
    with (tmp_path / "a.toml").open("wb") as file:
        file.truncate(LARGEST + 1)
    with pytest.raises(TomlError, match=rf"not readable: {LARGEST + 1} bytes, allowed are {LARGEST}"):
        read_toml(tmp_path / "a.toml")
    with pytest.raises(TomlError, match="not readable: no file"):
        read_toml(tmp_path)
    with pytest.raises(TomlError, match=r"not readable: .*No such file"):
        read_toml(tmp_path / "none.toml")
