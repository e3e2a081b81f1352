"""What OMSimulator 3.0 asks of an SSP and its FMUs, checked without it: it cannot be installed everywhere.

From its sources: `Model::getSystemType` takes the kind of a system from an annotation and refuses a system
of no kind; names count with their prefixes as written; `DirectedGraph` joins an initial unknown without
`dependencies` to every input, and sorts these pairs in a time that grows with their number times that of the
variables; a value that is not a number ends a run.
"""

import math
from xml.etree import ElementTree
from zipfile import ZipFile

import pytest

from bearing_fmu import depths
from fmus import port
from orchestrator.scenario.file import load_scenario
from orchestrator.ssp.writer import DEFINITION
from tests.fmus.host import Host

UNITS = ("rotor_small.fmu", *(f"bearing_{depth}.fmu" for depth in depths.names()))


def test_the_system_names_its_master_and_step(exported):
    for path in exported:
        with ZipFile(path) as archive:
            text = archive.read(DEFINITION).decode()
        spaces = {"ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription"}
        spaces["ssc"] = "http://ssp-standard.org/SSP1/SystemStructureCommon"
        spaces["oms"] = "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"
        root = ElementTree.fromstring(text)
        assert root.get("version") == "1.0"
        first = root.find("ssd:System/ssd:Annotations/ssc:Annotation", spaces)  # it looks at no other
        assert first.get("type") == "org.openmodelica"
        (information,) = first.findall("oms:Annotations/oms:SimulationInformation", spaces)
        (master,) = information
        assert master.get("description") == "oms-ma"
        assert float(master.get("stepSize")) == load_scenario("small").step
        assert float(master.get("relativeTolerance")) > 0.0
        for name in ("oms:Annotations", "oms:SimulationInformation", "oms:FixedStepMaster", "ssc:Annotation"):
            assert f"<{name}" in text


@pytest.fixture(scope="module", params=UNITS)
def host(request, fmus, tmp_path_factory):
    return Host(fmus / request.param, tmp_path_factory.mktemp("extracted") / "unit")


def test_every_initial_unknown_names_its_dependencies(host):
    root = ElementTree.parse(host.folder / "modelDescription.xml").getroot()
    variables = root.findall("ModelVariables/ScalarVariable")
    unknowns = root.findall("ModelStructure/InitialUnknowns/Unknown")
    assert all(u.get("dependencies") is not None for u in unknowns)
    wanted = [
        i for i, v in enumerate(variables, 1) if v.get("causality") in ("output", "calculatedParameter")
    ]
    assert [int(u.get("index")) for u in unknowns] == wanted
    known = {i for i, v in enumerate(variables, 1) if v.get("causality") in ("input", "parameter")}
    assert all(known.issuperset(map(int, u.get("dependencies").split())) for u in unknowns)


def test_a_longer_shaft_adds_no_dependencies():
    """For the turbine they were 448 thousand, and loading took minutes; now 2 thousand."""

    def count(nodes):
        variables = port.rotor(["a", "b"], ["c"], nodes)
        return sum(len(v.starts_on) for v in variables if v.causality in ("output", "calculatedParameter"))

    assert count(1000) == count(10) < 1000


def test_all_values_are_numbers_after_the_start(host):
    unit = host.open().start()
    names = [v.name for v in unit.variables.values() if v.type == "Real"]
    assert [n for n, x in zip(names, unit.get(*names), strict=True) if not math.isfinite(x)] == []
    unit.slave.doStep(0.0, 1e-4)
    assert [n for n, x in zip(names, unit.get(*names), strict=True) if not math.isfinite(x)] == []
    unit.slave.freeInstance()


@pytest.mark.parametrize("host", UNITS[:1], indirect=True)
def test_the_rotor_starts_on_nothing_that_it_does_not_name(host):
    """A change of each input and parameter moves only such initial unknowns as name it."""
    named = {u.variable.name: {v.name for v in u.dependencies} for u in host.description.initialUnknowns}
    names = list(named)
    unit = host.open()

    def values(**changes):
        unit.slave.reset()
        unit.start(changes)
        return unit.get(*names)

    plain = values()
    changes = {"reduction": "guyan", "start.orbit": False, "track_work": True}
    for v in unit.variables.values():
        if v.type == "Real" and v.causality in ("input", "parameter"):
            changes[v.name] = 1.01 * float(v.start) + (1e-5 if ".start." in v.name else 1e-2)
    for name, value in changes.items():
        for other, before, after in zip(names, plain, values(**{name: value}), strict=True):
            if name in named[other]:
                continue
            if unit.variables[other].type == "Real":
                rounding = 1e-9 * float(unit.variables[other].nominal or 1.0)
                before = pytest.approx(before, rel=1e-9, abs=rounding)
            assert after == before, (name, other)
    unit.slave.freeInstance()
