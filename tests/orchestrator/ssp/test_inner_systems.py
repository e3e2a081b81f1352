"""SSPs with a system inside the system, whose connectors pass values and signals on."""

import re
from zipfile import ZipFile

import pytest

from orchestrator.case.case import ssp_case
from orchestrator.ssp.reader import read_ssp
from orchestrator.ssp.structure import SspError
from tests.orchestrator.ssp.edited import SSD, edited, real, values_of


def with_inner_system(text, extra="", changes=()):
    """Move the component `front` into a system `casing`, whose connectors pass everything on."""
    (component,) = re.findall(r'<ssd:Component name="front".*?</ssd:Component>', text, flags=re.DOTALL)
    connectors = re.search(r"<ssd:Connectors>.*?</ssd:Connectors>", component, flags=re.DOTALL)[0]
    inner = []
    for name, kind in re.findall(r'<ssd:Connector name="([^"]*)" kind="(\w+)"', connectors):
        ends = [("", name), ("front", name)] if kind == "input" else [("front", name), ("", name)]
        start, end = (
            f'{side}Element="{e}" ' if e else "" for side, (e, _) in zip(("start", "end"), ends, strict=True)
        )
        inner.append(f'<ssd:Connection {start}startConnector="{name}" {end}endConnector="{name}" />')
    wires = "".join(inner)
    for old, new in changes:
        assert old in wires
        wires = wires.replace(old, new, 1)
    system = (
        f'<ssd:System name="casing">{connectors}{extra}<ssd:Elements>{component}</ssd:Elements>'
        f"<ssd:Connections>{wires}</ssd:Connections></ssd:System>"
    )
    text = text.replace(component, system)
    return (
        text.replace('startElement="front"', 'startElement="casing"', 10**6)
        .replace('endElement="front"', 'endElement="casing"')
        .replace(wires.replace('Element="front"', 'Element="casing"'), wires)
    )


def nested(small_ssp, tmp_path, **options):
    with ZipFile(small_ssp) as archive:
        text = archive.read(SSD).decode()
    return edited(
        small_ssp, tmp_path / "nested.ssp", {SSD: [(re.escape(text), with_inner_system(text, **options))]}
    )


def test_an_inner_system_is_the_same_system(small_ssp, tmp_path):
    plain = read_ssp(small_ssp, tmp_path / "a")
    inner = read_ssp(nested(small_ssp, tmp_path), tmp_path / "b")
    assert {c.name for c in inner.components} == {
        c.name.replace("front", "casing.front") for c in plain.components
    }
    renamed = {(c.source, c.output, c.target, c.input) for c in inner.connections}
    assert {tuple(x.replace("casing.front", "front") for x in c) for c in renamed} == {
        (c.source, c.output, c.target, c.input) for c in plain.connections
    }
    with ssp_case(nested(small_ssp, tmp_path)) as case:
        assert [c.name for c in case.units.contents.bearings] == ["casing.front", "rear"]


def inline(*parameters):
    return (
        "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues><ssv:ParameterSet "
        'xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" version="1.0" name="p">'
        f"<ssv:Parameters>{''.join(parameters)}</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>"
        "</ssd:ParameterBinding></ssd:ParameterBindings>"
    )


def test_values_of_a_system_win_and_travel_through_its_connectors(small_ssp, tmp_path):
    extra = inline(real("front.viscosity", 0.017), real("journal.x", 1e-6))
    values, _ = values_of(nested(small_ssp, tmp_path, extra=extra), "casing.front")
    assert values["viscosity"] == 0.017 and values["journal.x"] == 1e-6
    with (
        pytest.raises(SspError, match=r"casing: parameter front_viscosity belongs to nothing"),
        ssp_case(nested(small_ssp, tmp_path, extra=inline(real("front_viscosity", 0.017)))),
    ):
        pass


def test_signals_must_travel_as_they_are(small_ssp, tmp_path):
    wire = '<ssd:Connection startElement="front" startConnector="F0.Fx" endConnector="F0.Fx" />'
    scaled = wire.replace(" />", '><ssc:LinearTransformation factor="{}" /></ssd:Connection>')
    path = nested(small_ssp, tmp_path, changes=[(wire, scaled.format("1000"))])
    words = r"casing.front.F0.Fx -> rotor.bearing\[1\].F0.Fx: by transformation or units x comes as 1000 x"
    with pytest.raises(SspError, match=words), ssp_case(path):
        pass
    with ssp_case(nested(small_ssp, tmp_path, changes=[(wire, scaled.format("1.0"))])):
        pass
