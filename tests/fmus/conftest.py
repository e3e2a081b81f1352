"""Fixtures: a cache folder of the tests' own, the built FMUs, hosts for them."""

from pathlib import Path

import pytest
from spring_unit.facade import VARIABLES

from fmus.build import builder as build
from fmus.build.recipe import Recipe
from rotor_fmu.train.file import load_train
from tests.fmus.host import Host


@pytest.fixture(scope="session", autouse=True)
def cache(tmp_path_factory):
    """Keep the user's cache folder out of the tests."""
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(folder))
        yield folder


def spring_recipe(**changes) -> Recipe:
    """The recipe of the spring unit with gain 2."""
    values = {
        "file_name": "spring.fmu",
        "name": "bladeloss_spring",
        "description": "A spring with a damper.",
        "facade": "spring_unit.facade",
        "facade_class": "SpringSlave",
        "packages": ("fmus", "spring_unit"),
        "variables": lambda: VARIABLES,
        "arguments": {"gain": 2.0},
    }
    return Recipe(**(values | changes))


@pytest.fixture(scope="session")
def spring_fmu(tmp_path_factory) -> Path:
    return build.write(spring_recipe(), tmp_path_factory.mktemp("spring"))


@pytest.fixture(scope="session")
def spring_host(spring_fmu, tmp_path_factory) -> Host:
    return Host(spring_fmu, tmp_path_factory.mktemp("extracted"))


@pytest.fixture(scope="session")
def small_train():
    return load_train("small")


@pytest.fixture(scope="session")
def built(train_fmus) -> dict[str, Path]:
    """The FMUs of the small train by file name."""
    return {path.name: path for path in train_fmus.glob("*.fmu")}


@pytest.fixture(scope="session")
def hosts(built, tmp_path_factory) -> dict[str, Host]:
    """The same, extracted."""
    folder = tmp_path_factory.mktemp("hosts")
    return {name: Host(path, folder / Path(name).stem) for name, path in built.items()}


@pytest.fixture
def spring(spring_host):
    """An instance of the spring, not yet initialized."""
    instance = spring_host.open()
    yield instance
    instance.slave.freeInstance()
