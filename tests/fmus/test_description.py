"""The modelDescription says what the port says."""

from xml.etree import ElementTree
from zipfile import ZipFile

import pytest

from fmus import port
from fmus.build.description import STEP_SIZE
from fmus.build.promises import AFFINE, ISOTROPIC, MEMORYLESS, memoryless_with, promises_of


def variables_of(host):
    return {v.name: v for v in host.description.modelVariables}


@pytest.mark.parametrize("name", ["bearing_v1.fmu", "bearing_v2.fmu", "bearing_v3.fmu"])
def test_the_bearing_is_the_port_in_its_order(hosts, name):
    described = hosts[name].description.modelVariables
    assert [v.name for v in described] == [v.name for v in port.BEARING]
    assert [v.valueReference for v in described] == list(range(len(port.BEARING)))
    for found, expected in zip(described, port.BEARING, strict=True):
        assert (found.causality, found.type) == (expected.causality, expected.kind)
        assert (found.unit or "") == expected.unit and found.variability == expected.variability
        assert found.description == expected.description
        start = str if expected.kind == "String" else float
        assert found.start is None or start(found.start) == expected.start


def test_capabilities_and_default_experiment(hosts):
    for host in hosts.values():
        unit = host.description.coSimulation
        assert unit.canGetAndSetFMUstate and unit.canSerializeFMUstate
        assert unit.canHandleVariableCommunicationStepSize and not unit.needsExecutionTool
        assert not unit.canBeInstantiatedOnlyOncePerProcess
        assert float(host.description.defaultExperiment.stepSize) == STEP_SIZE


def test_films_say_that_they_have_no_memory_and_rotors_do_not(built):
    for name, path in built.items():
        with ZipFile(path) as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        promised = {
            "bearing_linear.fmu": {AFFINE, MEMORYLESS},
            **{
                f"bearing_{depth}.fmu": {ISOTROPIC, memoryless_with("guembel"), memoryless_with("reynolds")}
                for depth in ("v1", "v2")
            },
            "rotor_small.fmu": set(),
            "rotor.fmu": set(),
        }
        assert promises_of(root) == promised.get(name, {ISOTROPIC, MEMORYLESS}), name


def test_units_have_the_dimensions_of_the_law(hosts):
    """K q and C v are forces and moments: unit of K times that of q is that of the wrench."""
    definitions = {u.name: u.baseUnit for u in hosts["bearing_v1.fmu"].description.unitDefinitions}
    units = {v.name: v.unit for v in port.BEARING}
    bases = ("kg", "m", "s", "rad")
    for names, prefix in ((port.K, port.POSITION), (port.C, port.VELOCITY)):
        for index, name in enumerate(names):
            i, j = divmod(index, 4)
            parts = [definitions[units[name]], definitions[units[f"journal.{prefix[j]}"]]]
            wrench = definitions[units[f"wrench.{port.WRENCH[i]}"]]
            for base in bases:
                assert sum(getattr(p, base) for p in parts) == getattr(wrench, base), (name, base)


def test_in_a_step_bearings_depend_on_their_inputs_and_the_rotor_on_none(hosts):
    """So that tools see no algebraic loop between them."""
    inputs = {v.name for v in port.BEARING_INPUTS}
    for unknown in hosts["bearing_v1.fmu"].description.outputs:
        assert {v.name for v in unknown.dependencies} == inputs
    for unknown in hosts["rotor_small.fmu"].description.outputs:
        assert unknown.dependencies == []


def test_initially_a_journal_depends_on_its_start_parameters(hosts):
    unknowns = {u.variable.name: u for u in hosts["rotor_small.fmu"].description.initialUnknowns}
    found = {v.name for v in unknowns["bearing[2].journal.v_y"].dependencies}
    own = {f"bearing[2].start.y{part}" for part in ("", "_cos", "_sin")}
    assert found == own | {"speed", "start.from_law", "start.orbit"}
    assert [v.name for v in unknowns["bearing[1].load"].dependencies] == ["gravity"]
    indices = [u.variable.valueReference for u in unknowns.values()]
    assert indices == sorted(indices)
