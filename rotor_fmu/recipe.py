"""The recipe of the FMU of a train's rotor."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial

from fmus import port
from fmus.build.recipe import Recipe
from rotor_fmu.start_values import default_starts
from rotor_fmu.train.train import Train

DEFAULT_TRAIN = "turbine"
PREFIX = "bladeloss_rotor_"
"""Of the model name, before that of the train."""


def file_name(train: Train) -> str:
    """File name of the rotor FMU of a train."""
    return "rotor.fmu" if train.name == DEFAULT_TRAIN else f"rotor_{_identifier(train)}.fmu"


def _identifier(train: Train) -> str:
    """Its name with an underscore for whatever FMI has none in identifiers."""
    return re.sub(r"[^A-Za-z0-9_]", "_", train.name)


def rotor_recipe(train: Train, starts: Mapping[str, port.Value] | None = None) -> Recipe:
    """Return the recipe of the rotor of a train.

    Parameters
    ----------
    train : Train
        The train.
    starts : mapping, optional
        Start values by variable name in place of those of the train.
    """
    return Recipe(
        file_name=file_name(train),
        name=f"{PREFIX}{_identifier(train)}",
        description=f"Rotor of the train {train.name}: {train.length:g} m, {len(train.bearings)} bearings.",
        facade="rotor_fmu.facade",
        facade_class="RotorSlave",
        packages=("fmus", "rotor_fmu"),
        variables=partial(_variables, train),
        resources={"train.json": train.to_json().encode()},
        keeps_starts=True,
        builder_modules=("rotor_fmu.start_values",),
        starts=starts or {},
    )


def _variables(train: Train) -> tuple[port.Variable, ...]:
    names = [b.name for b in train.bearings], [w.name for w in train.wheels]
    return port.rotor(*names, train.nodes, default_starts(train), moving=train.has_moving_housings)
