"""The annotation of a unit whose outputs after a step follow from the inputs at its end alone.

Such a unit, as a film is one, needs no saved state to take a step back: the next step on other inputs
overwrites all.  FMI 2.0 has no word for it, so that it stands in the vendor annotations.
"""

from __future__ import annotations

from xml.etree.ElementTree import Element, SubElement

_TOOL, _MARK = "bladeloss", "Memoryless"


def annotate(description: Element) -> None:
    """Append the annotation to a modelDescription; its place is between DefaultExperiment and variables."""
    SubElement(SubElement(SubElement(description, "VendorAnnotations"), "Tool", name=_TOOL), _MARK)


def is_memoryless(description: Element) -> bool:
    """Whether a modelDescription carries the annotation."""
    return description.find(f"VendorAnnotations/Tool[@name='{_TOOL}']/{_MARK}") is not None
