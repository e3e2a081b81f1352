"""The builder: reproducible, whole files, and the digest that tells stale ones."""

import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

from bearing_fmu.recipe import bearing_recipe
from fmus.build import builder as build
from fmus.build.archive import as_written, guid_in, write_archive
from fmus.build.sources import package_folder, source_files
from rotor_fmu.recipe import rotor_recipe
from tests.fmus.conftest import spring_recipe


def test_two_builds_are_the_same_to_the_byte(spring_fmu, tmp_path):
    again = build.write(spring_recipe(), tmp_path)
    assert again.read_bytes() == spring_fmu.read_bytes()


def test_two_builds_of_a_rotor_are_the_same_to_the_byte(built, small_train, tmp_path):
    (again,) = build.build(tmp_path, [rotor_recipe(small_train)])
    assert again.read_bytes() == built["rotor_small.fmu"].read_bytes()


def test_refresh_builds_what_is_missing_only(built, tmp_path):
    wanted = [bearing_recipe(depth) for depth in ("v1", "v3")]
    built_now = build.refresh(tmp_path, wanted)
    assert [path.name for path in built_now] == [recipe.stored_name for recipe in wanted]
    assert wanted[1].stored_name == f"bearing_v3-{wanted[1].digest[:16]}.fmu"
    assert build.refresh(tmp_path, wanted) == []
    assert build.refresh(built["bearing_v1.fmu"].parent, wanted) == []  # plain names do


def test_what_is_damaged_in_the_own_folder_is_built_anew(tmp_path):
    recipe = bearing_recipe("v3")
    path = tmp_path / recipe.stored_name
    path.write_bytes(b"damaged")
    with pytest.raises(build.NotOursError, match="is not what bladeloss builds under this name"):
        build.refresh(tmp_path, [recipe])
    assert path.read_bytes() == b"damaged"
    assert build.refresh(tmp_path, [recipe], True) == [path] and build.refresh(tmp_path, [recipe]) == []


def test_a_build_changes_nothing_that_it_did_not_write(tmp_path, small_train):
    recipe = bearing_recipe("v3")
    (path,) = build.build(tmp_path, [recipe])
    assert as_written(path) and build.build(tmp_path, [recipe]) == [path]
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("mine", "mine")
    edited = path.read_bytes()
    with pytest.raises(build.NotOursError, match="or was changed since, and is left as it is"):
        build.build(tmp_path, [rotor_recipe(small_train), recipe])
    assert path.read_bytes() == edited and [p.name for p in tmp_path.iterdir()] == [path.name]


def test_two_trains_of_one_name_are_told_apart(tmp_path, small_train):
    """In a shared folder by their digest; a build for other tools, of plain names, refuses."""
    faster = replace(small_train, speed=1.01 * small_train.speed)
    both = [rotor_recipe(small_train), rotor_recipe(faster)]
    assert len(build.refresh(tmp_path, both)) == 2
    found = [guid_in(build.place(tmp_path, recipe)) for recipe in both]
    assert found == [f"{{{recipe.guid}}}" for recipe in both]
    with pytest.raises(build.NotOursError, match=r"rotor_small\.fmu: two unlike units"):
        build.build(tmp_path / "plain", both)


def test_a_date_appears_if_it_is_prescribed(tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    with zipfile.ZipFile(build.write(spring_recipe(), tmp_path)) as archive:
        assert b'generationDateAndTime="1970-01-01T00:00:00Z"' in archive.read("modelDescription.xml")


def test_stale_is_what_is_missing_damaged_or_made_from_other_data(spring_fmu, tmp_path):
    recipe = spring_recipe()
    assert not build.is_stale(spring_fmu, recipe)
    assert build.is_stale(tmp_path / "missing.fmu", recipe)
    assert build.is_stale(spring_fmu, spring_recipe(arguments={"gain": 3.0}))
    assert build.is_stale(spring_fmu, spring_recipe(resources={"data": b"1"}))
    damaged = tmp_path / "damaged.fmu"
    damaged.write_bytes(spring_fmu.read_bytes()[:1000])
    assert build.is_stale(damaged, recipe) and guid_in(damaged) is None


def test_a_build_that_fails_leaves_the_old_file_and_nothing_else(spring_fmu, tmp_path):
    path = tmp_path / "unit.fmu"
    path.write_bytes(b"old")
    with pytest.raises(TypeError):
        write_archive(path, {"a": b"1", "b": None})
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_the_archive_holds_what_the_facade_imports_and_no_more(spring_fmu):
    with zipfile.ZipFile(spring_fmu) as archive:
        names = archive.namelist()
    ours = {n.removeprefix("resources/packages/") for n in names if n.startswith("resources/packages/")}
    assert {"fmus/unit/slave.py", "fmus/port/__init__.py", "spring_unit/facade.py"} <= ours
    assert not {"fmus/build/builder.py", "fmus/build/recipe.py", "fmus/README.md", "fmus/VARIABLES.md"} & ours
    assert not [n for n in names if "__pycache__" in n or "tests" in n]
    assert "documentation/index.html" in names and "documentation/licenses/pythonfmu.txt" in names


def test_sources_follow_imports():
    files = source_files(["spring_unit.facade"], ["spring_unit", "fmus"])
    assert set(files["spring_unit"]) == {"__init__.py", "facade.py"}
    port = [
        "__init__",
        "arc",
        "balance",
        "bearing",
        "bore",
        "connector",
        "details",
        "drive",
        "failure",
        "linear_bearing",
        "oil",
    ]
    port += ["rotor_variables", "start", "variable"]
    unit = ["__init__", "failure", "hooks", "layout", "loader", "slave", "state", "values"]
    assert set(files["fmus"]) == {
        "__init__.py",
        *(f"port/{name}.py" for name in port),
        *(f"unit/{name}.py" for name in unit),
    }


def test_a_folder_of_the_same_name_is_no_package(tmp_path):
    """Built FMUs lie in a folder ``fmus``; a process that starts beside it finds the package all the same."""
    (tmp_path / "fmus").mkdir()
    code = "from fmus.build.sources import package_folder; print(package_folder('fmus'))"
    found = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert (
        Path(found.stdout.strip()) == package_folder("fmus") and (package_folder("fmus") / "build").is_dir()
    )
