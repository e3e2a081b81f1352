"""What a unit promises beyond FMI 2.0, in the vendor annotations of its description.

``memoryless``: its outputs after a step follow from the inputs at its end alone.  Such a unit needs no
saved state to take a step back: the next step on other inputs overwrites all.

``memoryless_with_guembel``, and so on: the same, while its parameter ``film.boundary`` is that word, no pad
tilts in its parameter ``bore``, and its parameter ``layer.thickness`` is 0.

Neither holds while its parameter ``film.temperature`` is ``followed``.

``isotropic``: no direction is unlike another: turned inputs give turned outputs, as of a plain bearing.

``affine``: its wrench is the affine law itself, at any state: stiffness and damping are constants.
"""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree.ElementTree import Element, SubElement

MEMORYLESS, ISOTROPIC, AFFINE = "memoryless", "isotropic", "affine"
BOUNDARY, BORE = "film.boundary", "bore"
TEMPERATURE, FOLLOWED = "film.temperature", "followed"
LAYER = "layer.thickness"
_TOOL, _MARK = "bladeloss", "Promises"


def memoryless_with(boundary: str) -> str:
    """The promise of a unit that has no memory with this rupture of its film."""
    return f"{MEMORYLESS}_with_{boundary}"


def annotate(description: Element, promises: Iterable[str]) -> None:
    """Append the promises to a modelDescription; their place is between DefaultExperiment and variables."""
    tool = SubElement(SubElement(description, "VendorAnnotations"), "Tool", name=_TOOL)
    SubElement(tool, _MARK, dict.fromkeys(promises, "true"))  # a tool has one element


def promises_of(description: Element) -> frozenset[str]:
    """The promises in a modelDescription."""
    mark = description.find(f"VendorAnnotations/Tool[@name='{_TOOL}']/{_MARK}")
    return frozenset() if mark is None else frozenset(key for key, word in mark.items() if word == "true")
