"""The recipe of a bearing's FMU."""

from __future__ import annotations

from collections.abc import Mapping

from bearing_fmu import depths
from fmus.build.promises import AFFINE, ISOTROPIC, MEMORYLESS, memoryless_with
from fmus.build.recipe import Recipe
from fmus.port.variable import Value

PREFIX = "bladeloss_bearing_"
"""Of the model name, before that of the depth."""


def file_name(depth: str) -> str:
    """File name of the FMU of a depth."""
    return f"bearing_{depth}.fmu"


def bearing_recipe(name: str, starts: Mapping[str, Value] | None = None) -> Recipe:
    """Return the recipe of the bearing of one depth.

    Parameters
    ----------
    name : str
        Of the depth.
    starts : mapping, optional
        Start values by variable name in place of those of the depth.

    Raises
    ------
    ValueError
        If there is no such depth.
    """
    depth = depths.find(name)
    modules = {d.film.partition(":")[0] for d in depths.depths()}
    own = depth.film.partition(":")[0]
    # the films of this package travel together, so that units of all depths share their sources
    films = sorted({module for module in modules if module.startswith("bearing_fmu.")} | {own})
    forgetting = [] if depth.memory else [b for b in depth.boundaries if b not in depth.remembering]
    forgets = not (depth.memory or depth.remembering or depth.pads)
    promised = (
        (MEMORYLESS, forgets),
        *((memoryless_with(word), not forgets) for word in forgetting),
        (ISOTROPIC, depth.isotropic),
        (AFFINE, depth.affine),
    )
    return Recipe(
        file_name=file_name(name),
        name=f"{PREFIX}{name}",
        description=depth.text,
        facade="bearing_fmu.facade",
        facade_class="BearingSlave",
        packages=tuple(dict.fromkeys(("fmus", "bearing_fmu", own.partition(".")[0]))),
        modules=tuple(films),
        variables=lambda: depth.variables,
        arguments={"depth": name, "film": depth.film, "starts": dict(sorted((starts or {}).items()))},
        starts=starts or {},
        promises=tuple(word for word, given in promised if given),
    )
