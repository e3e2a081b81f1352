"""Elastic couplings in the chain of shoulders: a shoulder without length between two nodes at one place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from rotor_fmu.train.schema import TrainToml
from rotor_fmu.train.shoulder import Joint, Shoulder

Nodes: TypeAlias = Mapping[str, Sequence[int]]
"""Node of each wheel, bearing, coupling and mass, by kind, in the order of the file."""


def with_joints(
    shoulders: Sequence[Shoulder], data: TrainToml, nodes: Nodes
) -> tuple[tuple[Shoulder, ...], Nodes]:
    """Put the joints of elastic couplings in.

    Parameters
    ----------
    shoulders : sequence of Shoulder
        Without joints.
    data : TrainToml
        Couplings, and what sits at their places.
    nodes : mapping
        Nodes on these shoulders.

    Returns
    -------
    shoulders : tuple of Shoulder
        With joints.
    nodes : mapping
        On them; that of a coupling is the first of the rotor behind it.
    """
    elastic = {
        node: Joint(**coupling.model_dump(exclude={"name", "z"}))
        for coupling, node in zip(data.coupling, nodes["coupling"], strict=True)
        if coupling.elastic
    }
    if not elastic:
        return tuple(shoulders), nodes
    chain: list[Shoulder] = []
    for index, shoulder in enumerate(shoulders):
        if index in elastic:
            before = chain[-1]
            drawn = before.outer_diameter, before.inner_diameter, before.material
            chain.append(Shoulder(0.0, *drawn, joint=elastic[index]))
        chain.append(shoulder)

    def moved(node: int, behind: bool) -> int:
        return node + sum(place < node for place in elastic) + (behind and node in elastic)

    return tuple(chain), {
        kind: [
            moved(node, kind == "coupling" or getattr(entry, "side", None) == "rear")
            for entry, node in zip(getattr(data, kind), places, strict=True)
        ]
        for kind, places in nodes.items()
    }
