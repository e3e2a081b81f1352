"""Tables as spreadsheets write them, and rows that lie over one another."""

from __future__ import annotations

import pytest

from rotor_fmu.train.file import DATA, load_train
from rotor_fmu.train.table import read_table
from rotor_fmu.train.train import Ring
from rotor_fmu.train.writer import write_train
from tests.faults import fault
from tests.rotor_fmu.train.train_folder import edit, folder, problems

__all__ = ["folder"]

SMALL = (DATA / "small" / "shaft.csv").read_text(encoding="utf-8")
HEADER = "length,outer_diameter,inner_diameter,material"


def in_mm(text, separator=";", comma=True):
    """The table as a spreadsheet with another separator writes it, in mm."""
    lines = []
    for line in text.splitlines():
        if line.startswith("#"):
            lines.append(f'"{line}"')
        elif line == HEADER:
            lines.append(
                separator.join(["Length [mm]", "Outer Diameter (mm)", "inner-diameter [mm]", "material"])
            )
        else:
            *numbers, material = line.split(",")
            cells = [repr(round(1000.0 * float(x), 6)) for x in numbers]
            cells = [cell.replace(".", ",") if comma else cell for cell in cells]
            lines.append(separator.join([*cells, material]))
    return "\n".join(lines) + "\n"


WRITTEN = {
    "byte order mark": "\ufeff" + SMALL,
    "windows line ends": SMALL.replace("\n", "\r\n"),
    "empty columns": SMALL.replace("\n", ",,\n"),
    "empty rows": SMALL.replace("\n", "\n\n,,,\n"),
    "semicolons": SMALL.replace(",", ";"),
    "tabulators": SMALL.replace(",", "\t"),
    "told separator": "sep=;\n" + SMALL.replace(",", ";"),
    "decimal commas and mm": in_mm(SMALL),
    "mm with points": in_mm(SMALL, comma=False),
    "units in cells": SMALL.replace("0.2,0.24,", "200 mm,24 cm,"),
    "quotes": SMALL.replace("0.2,0.24,0.0,steel", '"0.2","0.24","0.0","steel"'),
    "other order, a remark, no bore, no material": "remark,outer_diameter,inner_diameter,length\n"
    + "\n".join(
        f"a shoulder,{o},{i if float(i) else ''},{n}"
        for n, o, i, _ in (line.split(",") for line in SMALL.splitlines() if line[0].isdigit())
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", WRITTEN)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_a_table_as_spreadsheets_write_it(folder, kind, encoding):
    text = WRITTEN[kind] if encoding == "utf-8" else WRITTEN[kind].removeprefix("\ufeff")
    (folder / "shaft.csv").write_bytes(text.encode(encoding))
    assert load_train(folder) == load_train("small")


@fault(
    "input",
    "a table whose numbers or header cannot be meant",
    "exit 2; file, row or column, value, what is allowed",
    guard="rotor_fmu.train.table:_header",
)
@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (HEADER, "length [kg],outer_diameter,inner_diameter,material",
         "header: column 'length [kg]'; allowed is a number in m or in a unit of the same kind, as mm"),
        (HEADER, "Length mm,outer_diameter,inner_diameter,material",
         "header: column 'Length mm'; did you mean 'Length [mm]'? A unit has brackets"),
        (HEADER, "length,outer_diameter,length,material", "header: column 'length' occurs twice"),
        (HEADER, "outer_diameter,inner_diameter,material", "missing length; allowed are length, outer_diam"),
        (HEADER, HEADER + " [mm]", "column 'material [mm]'; allowed is material without a unit"),
        ("0.2,0.24,0.0,steel", "0.2,0.24,0.0,steel,,x", "row 3: 6 values; allowed are 4"),
        ("0.2,0.24,0.0,steel", '0.2,"1.234,5",0.0,steel',
         "row 3: outer_diameter = '1.234,5'; allowed is a number with a decimal point, or in a table"),
        ("0.2,0.24,0.0,steel", '0.2,"0,24",0.0,steel',
         "row 3: outer_diameter = '0,24'; allowed is a number with a decimal point"),
        ("0.2,0.24,0.0,steel", "0.2,24 kg,0.0,steel",
         "outer_diameter = '24 kg'; allowed is a number in m or in a unit of the same kind, as mm"),
        ("0.2,0.24,0.0,steel", "0.2,nan,0.0,steel", "outer_diameter = nan; allowed is a finite number"),
    ],
)  # fmt: skip
def test_a_table_that_cannot_be_read(folder, old, new, words):
    edit(folder, "shaft.csv", (old, new))
    assert any(words in line for line in problems(folder)), problems(folder)


def test_a_comma_between_columns_is_none_in_numbers(folder, tmp_path):
    """Thousands of a spreadsheet, 1,300 mm, are not 1.3 mm."""
    table = tmp_path / "shaft.csv"
    table.write_text('length [mm],outer diameter [mm]\n200,"1,300"\n300,90\n')
    rows, wrong = read_table(table, {"length": "m", "outer_diameter": "m"}, ["length", "outer_diameter"])
    assert not wrong and rows[0][1]["outer_diameter"] == "1,300" and rows[1][1]["outer_diameter"] == 0.09


def test_a_table_in_another_encoding_is_named(folder):
    (folder / "shaft.csv").write_bytes(SMALL.replace("metres", "in µm").encode("cp1252"))
    (line,) = problems(folder)
    assert "shaft.csv: not readable: 'utf-8' codec" in line and line.endswith("save it as CSV UTF-8")


MORE = "length,outer_diameter,inner_diameter,material,rear_outer_diameter,z,counts"


def layered(folder, *rows, header=MORE):
    """The small train with further rows."""
    lines = SMALL.splitlines()
    lines[1] = header
    plain = [line if line.startswith("#") or line == header else line + ",,," for line in lines]
    (folder / "shaft.csv").write_text("\n".join([*plain, *rows]), encoding="utf-8")


def test_rows_that_lie_over_others_cut_them(folder, tmp_path):
    """A sleeve from the middle of one shoulder to that of the next, a conical one, a mass; also written."""
    layered(folder, "0.8,0.6,0.52,steel,,2.7,", "0.3,0.5,0.4,steel,0.44,0.8,", "0.1,0.9,0.6,steel,,3.0,mass")
    train, small = load_train(folder), load_train("small")
    assert len(train.shoulders) == len(small.shoulders) + 5
    assert train.length == pytest.approx(small.length, rel=1e-14)
    at = {round(z, 9): s for z, s in zip(train.z, train.shoulders, strict=False)}
    assert [round(z, 9) for z in at if 2.6 < z < 3.6] == [2.7, 3.0, 3.1, 3.5]
    steel = small.shoulders[0].material
    assert at[2.7].layers == at[3.1].layers == (Ring(0.6, 0.52, steel),)
    assert at[3.0].layers == (Ring(0.6, 0.52, steel), Ring(0.9, 0.6, steel, counts="mass"))
    assert at[0.8].layers == (Ring(0.5, 0.4, steel, 0.44),)
    rings = 7850.0 * 3.141592653589793 / 4.0
    added = rings * (0.8 * (0.36 - 0.52**2) + 0.1 * (0.81 - 0.36))
    added += rings * 0.3 * ((0.25 + 0.5 * 0.44 + 0.44**2) / 3.0 - 0.16)
    assert train.mass - small.mass == pytest.approx(added, rel=1e-12)
    write_train(train, tmp_path / "again")
    assert load_train(tmp_path / "again") == train


def test_a_cone_that_is_cut_stays_a_cone(folder):
    header = MORE
    lines = [header, "2.0,0.4,,steel,0.2,,", "1.0,0.5,0.4,steel,,0.5,mass"]
    (folder / "shaft.csv").write_text("\n".join(lines), encoding="utf-8")
    found = problems(folder)  # bearings do not fit, but the rows do
    assert not any("shaft.csv" in line for line in found)


def test_stiffness_and_mass_apart(folder):
    layered(folder, header="length,outer_diameter,inner_diameter,material,stiffness_outer_diameter,z,counts")
    edit(folder, "shaft.csv", ("0.6,0.48,0.08,steel,,", "0.6,0.48,0.08,steel,0.3,"))
    train, small = load_train(folder), load_train("small")
    assert train.mass == small.mass
    (changed,) = [s for s in train.shoulders if not s.plain]
    steel = small.shoulders[0].material
    assert changed.rings == (
        Ring(0.48, 0.08, steel, counts="mass"),
        Ring(0.3, 0.08, steel, counts="stiffness"),
    )


@fault(
    "input",
    "rows of a shaft that lie in one another or leave a gap",
    "exit 2; file, row, value, what is allowed and where",
    guard="rotor_fmu.train.shaft_table:_overlaps",
)
@pytest.mark.parametrize(
    ("row", "words"),
    [
        (
            "0.8,0.6,0.5,steel,,2.7,",
            "inner_diameter = 0.5 between z = 2.7 and 3; allowed is at least 0.52, to which",
        ),
        (
            "0.5,0.6,0.52,steel,,6.5,",
            "nothing that is stiff between z = 6 and 6.5; allowed is a shaft without gaps",
        ),
        ("0.5,0.6,0.7,steel,,2.7,", "inner_diameter = 0.7; allowed is less than outer_diameter, 0.6"),
        (
            "0.5,0.6,0.5,steel,0.4,2.7,",
            "rear_inner_diameter = 0.5; allowed is less than rear_outer_diameter, 0.4",
        ),
        (
            "0.5,0.6,0.52,steel,,2.7,weight",
            "counts = 'weight'; allowed is one of 'both', 'stiffness' or 'mass'",
        ),
    ],
)
def test_rows_that_do_not_fit_together(folder, row, words):
    layered(folder, row)
    assert any(words in line for line in problems(folder)), problems(folder)
