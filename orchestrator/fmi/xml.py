"""Reads XML of others: without document types and entities, which can name files and grow without end."""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element, ParseError

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import parse

from orchestrator.errors import OrchestratorError
from orchestrator.fmi.archive import MIB

LARGEST = 64 * MIB
"""Bytes of a file; the description of the turbine's rotor has half a million."""


class XmlError(OrchestratorError):
    """An XML file that is not read; the text says why, and leaves it to the reader to name the file."""


def read_xml(path: Path) -> Element:
    """Return the root of an XML file.

    Raises
    ------
    FileNotFoundError
        When there is none.
    XmlError
        When it is too large, not well-formed, or has a document type.
    """
    size = path.stat().st_size
    if size > LARGEST:
        raise XmlError(f"{path.name} has {size // MIB} MiB; allowed are {LARGEST // MIB}")
    try:
        root: Element = parse(path, forbid_dtd=True).getroot()
    except DefusedXmlException:
        raise XmlError(f"{path.name} has a document type or entities (DTD); allowed is XML without") from None
    except (ParseError, ValueError, LookupError) as error:  # LookupError: an unknown encoding
        raise XmlError(f"{path.name} is no well-formed XML: {error}") from None
    return root
