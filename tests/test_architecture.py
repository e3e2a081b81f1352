"""Who may import whom, and how long files and functions may be.

An import counts wherever it stands, in a function or for the type checker alone.  The lists of exceptions may
only become shorter.
"""

import ast
import sys
from collections import defaultdict
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from bearing_fmu import depths
from fmus.build.sources import source_files

ROOT = Path(__file__).parents[1]
PHYSICS = ("rotor_fmu", "bearing_fmu")
PACKAGES = (*PHYSICS, "fmus", "orchestrator")
LONGEST_FILE, LONGEST_FUNCTION = 300, 60

ROOMS = (
    ("python", "cli"),
    ("commands",),
    ("study",),
    ("case",),
    ("report",),
    ("ssp", "linear"),
    ("results",),
    ("observers",),
    ("master",),
    ("fmi",),
    ("scenario",),
)
"""The rooms of the orchestrator: each imports from those below it, and all from the files beside them."""

UPWARDS: set[tuple[str, str]] = set()
CIRCLES: set[tuple[str, str]] = set()
LONG_FILES: set[str] = set()
LONG_FUNCTIONS: set[str] = set()

# Data types and how files of them are read, and what has no time for a unit to step in:
# the linear analysis of the shaft, the static one of a bearing.
OF_PHYSICS_FOR_THE_MASTER = {
    "bearing_fmu.depths",
    "bearing_fmu.film_map",  # a picture: what a unit does not give
    "bearing_fmu.recipe",
    "bearing_fmu.static.curves",
    "rotor_fmu.recipe",
    "rotor_fmu.train.train",
    "rotor_fmu.train.file",
    "rotor_fmu.train.lone",
    "rotor_fmu.train.checks",
    "rotor_fmu.train.schema",  # its keys, for the page of all keys
    "rotor_fmu.train.entry",
    "rotor_fmu.train.pedestal",
    "rotor_fmu.train.seat",
    "rotor_fmu.train.shoulder",
    "rotor_fmu.train.toml_source",
    "rotor_fmu.train.wording",
    "rotor_fmu.linear.analysis",
}
STUDIES_OF_THE_TRAIN = ("orchestrator.study.paper.calibration", "orchestrator.study.paper.experiments")
OF_FMUS_FOR_PHYSICS = {
    "fmus.port",
    "fmus.port.bore",
    "fmus.port.variable",
    "fmus.kernels.kept",  # files of compiled code
    "fmus.kernels.loops",
}
OF_FMUS_FOR_RECIPES = OF_FMUS_FOR_PHYSICS | {"fmus.build.recipe", "fmus.build.promises"}
OF_FMUS_FOR_THE_MASTER = {
    "fmus.kernels.loops",
    "fmus.port",
    "fmus.port.variable",
    "fmus.build.builder",
    "fmus.build.archive",
    "fmus.build.promises",
    "fmus.build.recipe",
}


def files(package):
    """All modules of a package; scripts beside the data use the packages, and no package uses them."""
    folder = ROOT / package
    return sorted(p for p in folder.rglob("*.py") if "data" not in p.relative_to(folder).parts)


def name_of(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path): path for package in PACKAGES for path in files(package)}


def imports(path):
    """All modules a file imports; of a package, the modules imported from it."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(), str(path))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            inner = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= {name if name in MODULES else node.module for name in inner}
    return found


@cache
def all_imports():
    """Those of each module; not before a test asks, for every worker collects this file."""
    return {name: imports(path) for name, path in MODULES.items()}


def tops(names):
    return {name.partition(".")[0] for name in names}


def of(names, *packages):
    return {name for name in names if name.partition(".")[0] in packages}


def edges(*packages):
    return {
        (a, b)
        for a, names in all_imports().items()
        for b in names
        if a in of(MODULES, *packages) and b in MODULES
    }


def floor(module):
    """The floor a module of the orchestrator is on; files beside the rooms are below all."""
    room = f"{module}.".split(".")[1]
    return next((k for k, rooms in enumerate(ROOMS) if room in rooms), len(ROOMS))


def test_every_folder_of_the_orchestrator_is_a_room():
    rooms = {p.name for p in (ROOT / "orchestrator").iterdir() if any(p.rglob("*.py"))}
    assert rooms == {room for rooms in ROOMS for room in rooms}


@pytest.mark.parametrize("package", PACKAGES)
def test_every_folder_with_modules_is_a_package(package):
    """Or else it is missing in what is installed."""
    assert [path for path in files(package) if not (path.parent / "__init__.py").is_file()] == []


def test_rooms_import_downwards_only():
    def room(module):
        return f"{module}.".split(".")[1]

    inside = {(a, b) for a, b in edges("orchestrator") if of({b}, "orchestrator") and room(a) != room(b)}
    beside = len(ROOMS)
    upwards = {(a, b) for a, b in inside if floor(a) >= floor(b) and (floor(a), floor(b)) != (beside, beside)}
    assert upwards <= UPWARDS, upwards - UPWARDS


def circle(arrows):
    """One of the circles that there are, in words."""
    graph = defaultdict(set)
    for a, b in arrows:
        graph[a].add(b)
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return " -> ".join(reversed(error.args[1]))
    return ""


def test_no_module_imports_itself_by_way_of_others():
    assert not circle(edges(*PACKAGES) - UPWARDS - CIRCLES)


def test_folders_of_the_rotor_import_one_another_in_one_direction():
    """But for the check of a train's loads, which needs the statics of its shaft."""

    def folder(module):
        return module.split(".")[1]

    arrows = {
        (folder(a), folder(b))
        for a, b in edges("rotor_fmu")
        if b.startswith("rotor_fmu.") and (a, b) != ("rotor_fmu.train.checks", "rotor_fmu.shaft.statics")
    }
    assert not circle({(a, b) for a, b in arrows if a != b})


def test_no_file_is_long():
    paths = [*MODULES.values(), *(ROOT / "tests").rglob("*.py")]
    lengths = {path.relative_to(ROOT).as_posix(): len(path.read_text().splitlines()) for path in paths}
    assert {name for name, length in lengths.items() if length > LONGEST_FILE} <= LONG_FILES


def test_no_function_is_long():
    """Its docstring and its signature do not count."""
    found = {}
    for name, path in MODULES.items():
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                body = node.body[1:] if ast.get_docstring(node) is not None else node.body
                if body and (length := body[-1].end_lineno - body[0].lineno + 1) > LONGEST_FUNCTION:
                    found[f"{name}:{node.name}"] = length
    assert set(found) <= LONG_FUNCTIONS, found


@pytest.mark.parametrize("module", sorted(of(MODULES, *PHYSICS)))
def test_physics_knows_nothing_of_fmi(module):
    names = all_imports()[module]
    assert not tops(names) & {"pythonfmu", "fmpy", "orchestrator"}
    assert not of(names, *(set(PHYSICS) - tops({module}))), "an arrow between the two units"
    if not module.endswith(".facade"):
        allowed = OF_FMUS_FOR_RECIPES if module.endswith(".recipe") else OF_FMUS_FOR_PHYSICS
        assert of(names, "fmus") <= allowed


@pytest.mark.parametrize("module", sorted(of(MODULES, "orchestrator")))
def test_the_master_reaches_physics_through_fmus_only(module):
    names = all_imports()[module]
    if not module.startswith(STUDIES_OF_THE_TRAIN):
        assert of(names, *PHYSICS) <= OF_PHYSICS_FOR_THE_MASTER
    assert of(names, "fmus") <= OF_FMUS_FOR_THE_MASTER
    assert "pythonfmu" not in tops(names)
    if not module.startswith("orchestrator.fmi."):
        assert "fmpy" not in tops(names)


@pytest.mark.parametrize("module", sorted(of(MODULES, "fmus")))
def test_the_fmi_side_knows_nothing_of_physics(module):
    assert not tops(all_imports()[module]) & {"orchestrator", "fmpy", *PHYSICS}


def test_the_files_in_an_fmu_use_no_library_but_the_listed():
    """Read a train file with pydantic, but run an FMU without."""
    packages = ("fmus", *PHYSICS)
    used = set()
    films = {depth.film.partition(":")[0] for depth in depths.depths()}
    for package, names in source_files(["rotor_fmu.facade", "bearing_fmu.facade", *films], packages).items():
        used |= {
            top for name in names if name.endswith(".py") for top in tops(imports(ROOT / package / name))
        }
    # llvmlite is a part of numba
    allowed = {"numpy", "scipy", "numba", "llvmlite", "pythonfmu"}
    assert used - sys.stdlib_module_names - set(packages) <= allowed
