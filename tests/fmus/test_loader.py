"""Where an FMU finds its packages, each case in a process of its own."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from fmus.build.builder import write
from tests.faults import fault
from tests.fmus.conftest import spring_recipe

FATAL = 4
REPOSITORY = Path(__file__).parents[2]

_SCRIPT = """
import json, sys
from pathlib import Path
case = json.loads(sys.argv[1])
if case["bare"]:  # a host without bladeloss
    sys.path[:] = [p for p in sys.path if Path(p or ".").resolve() != Path(case["repository"])]
    sys.meta_path[:] = [f for f in sys.meta_path if "editable" not in repr(f).lower()]
sys.path[:0] = case["path"]
for name in case["loaded"]:
    __import__(name)
sys.path.append(case["tests"])
from fmpy.fmi1 import FMICallException
from host import Host
sys.path.remove(case["tests"])
found = {}
for fmu in case["fmus"]:
    host = Host(fmu, Path(case["folder"]) / Path(fmu).stem)
    instance = host.open()
    instance.set({"stiffness": 1e6})
    try:
        instance.start()
        status = 0
    except FMICallException as error:
        status = error.status
    found[fmu] = {"start": status, "F": repr(instance.get("F")), "step": instance.step(0.0, 1e-3)}
    found[fmu]["said"] = instance.said
    instance.slave.freeInstance()
found["from"] = {p: list(sys.modules[p].__path__)[0] for p in ("fmus", "spring_unit") if p in sys.modules}
print(json.dumps(found))
"""


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Run FMUs in a process of their own and return what was found."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))

    def call(*fmus, bare=True, path=(), loaded=(), folder="extracted"):
        case = {
            "bare": bare,
            "repository": str(REPOSITORY),
            "tests": str(Path(__file__).parent),
            "path": [str(p) for p in path],
            "loaded": loaded,
            "folder": str(tmp_path / folder),
            "fmus": [str(f) for f in fmus],
        }
        command = [sys.executable, "-c", _SCRIPT, json.dumps(case)]
        done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path)
        found = json.loads(done.stdout.splitlines()[-1])
        return [found[str(f)] for f in fmus], {p: Path(f) for p, f in found["from"].items()}

    return call


def test_a_bare_host_keeps_the_packages_in_the_cache_folder(run, spring_fmu, tmp_path):
    (first,), places = run(spring_fmu)
    assert first == {"start": 0, "F": "-2000.0", "step": True, "said": ""}
    cache = tmp_path / "cache" / "bladeloss"
    assert {place.parent.parent for place in places.values()} == {cache}
    assert sorted(p.name.split("-")[0] for p in cache.iterdir()) == ["fmus", "spring_unit"]
    written = (places["fmus"] / "unit" / "slave.py").stat().st_mtime_ns
    _, again = run(spring_fmu, folder="elsewhere")
    assert again == places and (places["fmus"] / "unit" / "slave.py").stat().st_mtime_ns == written


def test_without_a_cache_folder_the_resources_serve(run, spring_fmu, tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    (found,), places = run(spring_fmu)
    assert found["step"]
    assert places["fmus"] == tmp_path / "extracted" / spring_fmu.stem / "resources" / "packages" / "fmus"


@pytest.mark.parametrize("how", ["damaged", "a file added", "open to all"])
@fault(
    "archive",
    "the copy of a unit's packages in the cache, changed, added to, or open to others",
    "it is not run; a fresh copy takes its place",
    guard="fmus.unit.loader:_holds",
)
def test_a_cache_folder_that_is_not_as_it_was_left(run, spring_fmu, how):
    _, places = run(spring_fmu)
    kept = places["spring_unit"]
    if how == "damaged":
        (kept / "facade.py").write_text("damaged")
    elif how == "a file added":
        (kept / "__init__.cpython-311.so").write_text("code of somebody else")
    else:
        kept.parent.chmod(0o777)
    (found,), places = run(spring_fmu, folder="elsewhere")
    assert found["step"] and places["spring_unit"] == kept
    assert "damaged" not in (kept / "facade.py").read_text() and not list(kept.glob("*.so"))
    assert not kept.parent.stat().st_mode & 0o002


@fault(
    "archive",
    "a module of a common name beside a package in the cache folder",
    "it is never found: the folder is not on `sys.path`",
    guard="fmus.unit.loader:_import_from",
)
def test_nothing_else_is_imported_from_the_cache(run, spring_fmu):
    _, places = run(spring_fmu)
    for name in ("numpy.py", "json.py", "fmpy.py"):
        (places["fmus"].parent / name).write_text("raise SystemExit('shadowed')")
        (places["spring_unit"].parent / name).write_text("raise SystemExit('shadowed')")
    (found,), again = run(spring_fmu, folder="elsewhere")
    assert found["step"] and again == places


def test_a_host_with_the_same_sources_uses_its_own(run, spring_fmu):
    tests = Path(__file__).parent
    (found,), places = run(spring_fmu, bare=False, path=[REPOSITORY, tests], loaded=["fmus.unit.slave"])
    assert found["step"]
    assert places == {"fmus": REPOSITORY / "fmus", "spring_unit": tests / "spring_unit"}


def other_fmus(tmp_path) -> Path:
    """A package called fmus with other sources."""
    package = tmp_path / "other" / "fmus"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    return package.parent


def test_a_host_with_other_sources_not_yet_loaded_does_not_disturb(run, spring_fmu, tmp_path):
    (found,), places = run(spring_fmu, path=[other_fmus(tmp_path)])
    assert found["step"] and "cache" in str(places["fmus"])


def test_other_sources_already_loaded_refuse_the_fmu_with_the_reason(run, spring_fmu, tmp_path):
    (found,), _ = run(spring_fmu, path=[other_fmus(tmp_path)], loaded=["fmus"])
    assert found["F"] == "nan" and found["start"] == FATAL and not found["step"]
    assert "FMU refused: the package fmus loaded in this process" in found["said"]
    assert "differs from the one this FMU was built from" in found["said"]


def test_two_versions_in_one_process_the_second_is_refused(run, spring_fmu, tmp_path, monkeypatch):
    """Not run silently with the code of the first."""
    changed = {"fmus": {}, "spring_unit": {}}
    recipe = spring_recipe(file_name="newer.fmu")
    for package, files in recipe.sources.items():
        changed[package] = dict(files)
    changed["spring_unit"]["facade.py"] += b"\nCHANGED = True\n"
    recipe.__dict__["sources"] = changed  # the cached property
    newer = write(recipe, tmp_path)
    (first, second), _ = run(spring_fmu, newer)
    assert first["step"] and not second["step"]
    assert "the package spring_unit loaded" in second["said"]
    (found,), _ = run(newer, folder="alone")
    assert found["step"], found["said"]


def test_a_missing_library_in_the_host_is_told(run, tmp_path):
    recipe = spring_recipe(facade="spring_unit.missing")
    recipe.__dict__["sources"] = spring_recipe().sources
    (found,), _ = run(write(recipe, tmp_path))
    assert not found["step"] and "No module named 'spring_unit.missing'" in found["said"]
