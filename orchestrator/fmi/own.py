"""Tells an FMU that this installation builds from one of somebody else: by all of its bytes."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any
from zipfile import ZipFile

from defusedxml.ElementTree import fromstring

from bearing_fmu import recipe as bearing
from fmus.build.archive import holds
from fmus.build.recipe import Recipe
from fmus.port.variable import Value
from rotor_fmu import recipe as rotor
from rotor_fmu.train.train import Train

_DESCRIPTION, _TRAIN = "modelDescription.xml", "resources/train.json"
_LARGEST = 4 << 20  # bytes of a description or a train; the turbine's have half a million
_VALUE: dict[str, Callable[[Any], Value]] = {"Integer": int, "Boolean": "true".__eq__, "String": str}


def is_own(path: Path) -> bool:
    """Tell whether an FMU is, file by file, what this installation would build.

    The train of a rotor and start values that are no Real, which an exported SSP holds inside its FMUs,
    may be any: they are data, and the FMU is built again with them and compared.
    """
    try:
        with ZipFile(path) as archive:
            recipe = _recipe(archive)
        return recipe is not None and holds(path, recipe.content())
    except Exception:  # whatever cannot be read or built is of somebody else
        return False


def _recipe(archive: ZipFile) -> Recipe | None:
    """Return the recipe that an FMU claims to be made by."""
    description = fromstring(_read(archive, _DESCRIPTION), forbid_dtd=True)
    name = str(description.get("modelName"))
    make: Callable[[Mapping[str, Value]], Recipe]
    if match := re.fullmatch(bearing.PREFIX + r"(\w+)", name):
        make = partial(bearing.bearing_recipe, match[1])
    elif name.startswith(rotor.PREFIX):
        make = partial(rotor.rotor_recipe, Train.from_json(_read(archive, _TRAIN).decode()))
    else:
        return None
    texts = {
        str(scalar.get("name")): kind.get("start")
        for scalar in description.iterfind("ModelVariables/ScalarVariable")
        for kind in scalar
    }
    plain = make({})
    starts = {
        v.name: value
        for v in plain.variables()
        if v.kind != "Real" and v.start is not None and (value := _VALUE[v.kind](texts[v.name])) != v.start
    }
    return make(starts) if starts else plain


def _read(archive: ZipFile, name: str) -> bytes:
    with archive.open(name) as file:
        content = file.read(_LARGEST + 1)
    if len(content) > _LARGEST:
        raise ValueError(f"{name} is larger than any of ours")
    return content
