"""Who may import whom."""

import ast
import sys
from pathlib import Path

import pytest

from fmus.build.sources import source_files

REPOSITORY = Path(__file__).parents[2]
PHYSICS = ("rotor_fmu", "bearing_fmu")
# Data types and how files of them are read, and the linear analysis of the shaft: eigenvalues have no time
# for a unit to step in.
OF_PHYSICS_FOR_THE_MASTER = {
    "rotor_fmu.train.train",
    "rotor_fmu.train.file",
    "rotor_fmu.train.checks",
    "rotor_fmu.train.toml_source",
    "rotor_fmu.train.wording",
    "rotor_fmu.linear.analysis",
}
OF_FMUS_FOR_PHYSICS = {"fmus.port", "fmus.port.variable"}
OF_FMUS_FOR_THE_MASTER = {
    "fmus.port",
    "fmus.port.variable",
    "fmus.build.builder",
    "fmus.build.archive",
    "fmus.unit.failure",
    "fmus.build.memoryless",
    "fmus.build.own",
}


def modules(package):
    """All modules of a package; scripts beside the data use the packages, and no package uses them."""
    folder = REPOSITORY / package
    return sorted(p for p in folder.rglob("*.py") if "data" not in p.relative_to(folder).parts)


def short(path):
    return path.relative_to(REPOSITORY).as_posix()


def imports(path):
    """All modules a file imports; of a package, the modules imported from it."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(), str(path))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            top = (REPOSITORY / node.module.replace(".", "/")).is_dir()
            found |= {f"{node.module}.{alias.name}" for alias in node.names} if top else {node.module}
    return found


def tops(names):
    return {name.partition(".")[0] for name in names}


def of(names, *packages):
    return {name for name in names if name.partition(".")[0] in packages}


@pytest.mark.parametrize("path", [p for package in PHYSICS for p in modules(package)], ids=short)
def test_physics_knows_nothing_of_fmi(path):
    names = imports(path)
    assert not tops(names) & {"pythonfmu", "fmpy", "orchestrator"}
    assert not of(names, *(set(PHYSICS) - {short(path).partition("/")[0]}))
    if path.name != "facade.py":
        assert of(names, "fmus") <= OF_FMUS_FOR_PHYSICS


@pytest.mark.parametrize("path", modules("orchestrator"), ids=short)
def test_the_master_reaches_physics_through_fmus_only(path):
    names = imports(path)
    assert of(names, *PHYSICS) <= OF_PHYSICS_FOR_THE_MASTER
    assert of(names, "fmus") <= OF_FMUS_FOR_THE_MASTER
    assert "pythonfmu" not in tops(names)


@pytest.mark.parametrize("path", modules("fmus"), ids=short)
def test_the_fmi_side_knows_of_physics_what_the_builder_needs(path):
    names = imports(path)
    assert not tops(names) & {"orchestrator", "fmpy", "bearing_fmu"}
    allowed = (
        {"rotor_fmu.start_values", "rotor_fmu.train.train"} if path.name in ("build.py", "own.py") else set()
    )
    assert of(names, "rotor_fmu") <= allowed


def test_the_files_in_an_fmu_use_no_library_but_the_listed():
    """Read a train file with pydantic, but run an FMU without."""
    packages = ("fmus", *PHYSICS)
    files = source_files(["rotor_fmu.facade", "bearing_fmu.facade"], packages)
    sources = [REPOSITORY / package / name for package, names in files.items() for name in names]
    used = set().union(*(tops(imports(path)) for path in sources if path.suffix == ".py"))
    # llvmlite is a part of numba
    assert used - sys.stdlib_module_names - set(packages) <= {
        "numpy",
        "scipy",
        "numba",
        "llvmlite",
        "pythonfmu",
    }
