"""SSPs as other tools write them: units, mappings, transformations, versions, flags of units."""

import re
from zipfile import ZIP_DEFLATED, ZipFile

import pytest

from orchestrator.case.case import ssp_case
from orchestrator.case.simulate import execute
from orchestrator.errors import FmuError
from orchestrator.ssp.reader import read_ssp
from orchestrator.ssp.structure import SspError
from tests.faults import fault
from tests.orchestrator.foreign import refused
from tests.orchestrator.ssp.edited import SSD, edited, real, stated, values_of, with_parameter

BINDING = '<ssd:ParameterBinding type="application/x-ssp-parameter-set" source="resources/front.ssv" />'
MS = '<ssc:Unit name="ms"><ssc:BaseUnit s="1" factor="0.001" /></ssc:Unit>'
POISE = '<ssc:Unit name="P"><ssc:BaseUnit kg="1" m="-1" s="-1" factor="0.1" /></ssc:Unit>'
KELVIN = '<ssc:Unit name="K"><ssc:BaseUnit K="1" /></ssc:Unit>'


def test_units_are_converted_by_their_definitions(small_ssp, tmp_path):
    path = with_parameter(small_ssp, tmp_path, "front", "viscosity", real("viscosity", 0.12, "P"), POISE)
    assert values_of(path, "front")[0]["viscosity"] == pytest.approx(0.012, rel=1e-15)
    path = with_parameter(small_ssp, tmp_path, "rotor", "fracture.time", real("fracture.time", 5, "ms"), MS)
    assert values_of(path, "rotor")[0]["fracture.time"] == pytest.approx(5e-3, rel=1e-15)
    path = with_parameter(small_ssp, tmp_path, "front", "viscosity", real("viscosity", 0.0125, "Pa.s"))
    assert values_of(path, "front")[0]["viscosity"] == 0.0125  # the FMU's own unit needs no definition


@pytest.mark.parametrize(
    ("name", "text", "units", "words"),
    [
        (
            "viscosity",
            real("viscosity", 0.12, "P"),
            "",
            "front: viscosity = 0.12: unit 'P' is defined nowhere",
        ),
        (
            "viscosity",
            real("viscosity", 0.12, "K"),
            KELVIN,
            "front: viscosity = 0.12: 'K' is no unit of 'Pa.s'",
        ),
        (
            "viscosity",
            2 * real("viscosity", 0.012),
            "",
            "parameter viscosity stands twice in one parameter set",
        ),
    ],
)
def test_values_that_could_mean_anything_are_refused(
    name, text, units, words, small_ssp, small_fmus, room, tmp_path
):
    assert words in refused(with_parameter(small_ssp, tmp_path, "front", name, text, units), room, small_fmus)


@pytest.mark.parametrize(
    ("blade", "words"),
    [(3000.0, "unbalance = 3000.0; allowed is at most"), (-0.3, "unbalance = -0.3; allowed is")],
)
def test_a_blade_has_the_limits_of_a_scenario(blade, words, small_ssp, small_fmus, room, tmp_path):
    name = "wheel[1].blade_unbalance"
    changes = [(stated(name), real(name, blade)), (stated("fracture.time"), real("fracture.time", 0.001))]
    path = edited(small_ssp, tmp_path / "my.ssp", {"resources/rotor.ssv": changes})
    assert words in refused(path, room, small_fmus)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('stopTime="[^"]*"', 'stopTime="0"', "stopTime = '0'; allowed is a number above 0"),
        ('stopTime="[^"]*"', 'stopTime="INF"', "stopTime = 'INF'; allowed"),
        ('baseStepSize="[^"]*"', 'baseStepSize="0"', "baseStepSize = '0'; allowed is a number above 0"),
        ('startTime="[^"]*"', 'startTime="0.1"', "startTime = 0.1; allowed is 0"),
        (' version="1.0"', ' version="3.0"', "SSP version '3.0'; allowed are 1.0 and 2.0"),
        (
            'implementation="CoSimulation"',
            'implementation="ModelExchange"',
            "'ModelExchange'; allowed is CoSim",
        ),
        ("application/x-fmu-sharedlibrary", "application/x-ssp-package", "component of type"),
        (
            '(?=startConnector="F0.Fx")',
            'suppressUnitConversion="maybe" ',
            None,
        ),
    ],
)
def test_the_definition_counts_or_is_refused(old, new, words, small_ssp, small_fmus, room, tmp_path):
    path = edited(small_ssp, tmp_path / "my.ssp", {SSD: [(old, new)]})
    if words is None:
        with ssp_case(path):
            return
    assert words in refused(path, room, small_fmus)


KN = '<ssd:Units><ssc:Unit name="kN"><ssc:BaseUnit kg="1" m="1" s="-2" factor="1000" /></ssc:Unit>'
FORCE = 'name="F0.Fx" kind="output">\\s*<ssc:Real unit="N" />'
JOINT = 'name="bearing\\[1\\].F0.Fx" kind="input">\\s*<ssc:Real unit="N" />'


def connector(name, kind, kilonewton):
    return f'name="{name}" kind="{kind}">{kilonewton}'


@pytest.mark.parametrize(
    ("outer", "inner", "words"),
    [
        (
            '<ssc:Real unit="kN" />',
            '<ssc:Real unit="N" />',
            "x comes as 1000 x + 0; signals must travel as they",
        ),
        (
            '<ssc:Float64 unit="kN" />',
            '<ssc:Real unit="N" />',
            "x comes as 1000 x + 0; signals must travel as they",
        ),
        (
            '<ssc:Real unit="kN" />',
            "<ssc:Real />",
            "front: connector F0.Fx in 'kN'; allowed is the unit of its FMU, 'N'",
        ),
        ('<ssc:Real unit="kN" />', '<ssc:Real unit="kN" />', "in 'kN'; allowed is the unit of its FMU, 'N'"),
        ('<ssc:Real unit="lbf" />', '<ssc:Real unit="N" />', "unit 'lbf' is defined nowhere"),
        (
            '<ssc:Real unit="N" /><ssc:Dimension size="3" />',
            '<ssc:Real unit="N" />',
            "F0.Fx is an array; allowed",
        ),
    ],
)
def test_connectors_are_in_the_units_of_their_fmu(outer, inner, words, small_ssp, small_fmus, room, tmp_path):
    changes = [(FORCE, connector("F0.Fx", "output", outer)), ("<ssd:Units>", KN)]
    changes.append((JOINT, connector("bearing[1].F0.Fx", "input", inner)))
    assert words in refused(edited(small_ssp, tmp_path / "my.ssp", {SSD: changes}), room, small_fmus)


@fault(
    "input",
    "an SSP whose start is infinite, or lies metres outside of a bearing",
    "exit 2; component, parameter, value, what is allowed",
    guard="orchestrator.ssp.scenario:_start_problems",
)
@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("INF", "rotor: bearing[1].start.x = inf; allowed is a finite number"),
        ("1.0", "clearances from the centre of front; allowed are 2, in m"),
    ],
)
def test_a_start_far_outside(value, words, small_ssp, small_fmus, room, tmp_path):
    name = "bearing[1].start.x"
    path = with_parameter(small_ssp, tmp_path, "rotor", name, real(name, value))
    assert words in refused(path, room, small_fmus)


def test_two_components_of_one_name(small_ssp, small_fmus, room, tmp_path):
    changes = [('<ssd:Component name="rear"', '<ssd:Component name="front"')]
    path = edited(small_ssp, tmp_path / "my.ssp", {SSD: changes})
    assert "front is the name of two components" in refused(path, room, small_fmus)


def test_the_step_of_omsimulator_counts_where_there_is_no_other(small_ssp, tmp_path):
    osp = '<ssc:Annotation type="com.opensimulationplatform">.*?</ssc:Annotation>'
    step = ('stepSize="[^"]*"', 'stepSize="1e-05"')
    for changes, expected in (([step], 1e-4), ([(osp, ""), step], 1e-5)):
        with ssp_case(edited(small_ssp, tmp_path / "my.ssp", {SSD: changes})) as case:
            assert case.scenario.step == expected
    changes = [(osp, ""), ('stepSize="[^"]*"', 'stepSize="0"')]
    with pytest.raises(SspError, match="stepSize = '0'; allowed is a number above 0"):
        read_ssp(edited(small_ssp, tmp_path / "my.ssp", {SSD: changes}), tmp_path / "x")


def test_version_2_is_read_and_named_where_something_is_refused(small_ssp, tmp_path):
    path = edited(small_ssp, tmp_path / "two.ssp", {SSD: [(' version="1.0"', ' version="2.0"')]})
    with ssp_case(path) as case:
        assert case.scenario.end == 0.01
    changes = [(' version="1.0"', ' version="2.0"'), ("x-fmu-sharedlibrary", "x-ssp-package")]
    path = edited(small_ssp, tmp_path / "two.ssp", {SSD: changes})
    with pytest.raises(SspError, match=r"component of type .* \(SSP version 2.0\)"), ssp_case(path):
        pass


def test_mapped_parameters(small_ssp, tmp_path):
    """Viscosity in mPa s, renamed, with suppressed units and a factor; a name that is not mapped stays."""
    mapping = (
        "<ssd:ParameterMapping><ssm:ParameterMapping xmlns:ssm="
        '"http://ssp-standard.org/SSP1/SystemStructureParameterMapping" version="1.0">'
        '<ssm:MappingEntry source="eta" target="viscosity" suppressUnitConversion="true">'
        '<ssc:LinearTransformation factor="0.001" offset="0.001" /></ssm:MappingEntry>'
        "</ssm:ParameterMapping></ssd:ParameterMapping>"
    )
    binding = BINDING.replace(" />", f">{mapping}</ssd:ParameterBinding>")
    changes = {
        SSD: [(re.escape(BINDING), binding)],
        "resources/front.ssv": [(stated("viscosity"), real("eta", 14.0, "mPas"))],
    }
    with ssp_case(small_ssp) as plain:
        diameter = {c.name: c for c in plain.units.contents.structure.components}["front"].parameters[
            "diameter"
        ]
    values, _ = values_of(edited(small_ssp, tmp_path / "my.ssp", changes), "front")
    assert values["viscosity"] == pytest.approx(0.015, rel=1e-15) and values["diameter"] == diameter


def flagged(small_ssp, tmp_path, old, new, **changes):
    """The SSP with another flag in its bearing's FMU."""
    with ZipFile(small_ssp) as archive:
        member = "resources/bearing_v3.fmu"
        (tmp_path / "b.fmu").write_bytes(archive.read(member))
        changed = edited(tmp_path / "b.fmu", tmp_path / "c.fmu", {"modelDescription.xml": [(old, new)]})
        with ZipFile(tmp_path / "flagged.ssp", "w", ZIP_DEFLATED) as out:
            for name in archive.namelist():
                out.writestr(name, changed.read_bytes() if name == member else archive.read(name))
    return edited(tmp_path / "flagged.ssp", tmp_path / "my.ssp", changes)


def test_a_unit_for_one_instance_serves_one_bearing(small_ssp, tmp_path):
    new = '<CoSimulation canBeInstantiatedOnlyOncePerProcess="true" '
    with (
        ssp_case(flagged(small_ssp, tmp_path, "<CoSimulation ", new)) as case,
        pytest.raises(FmuError) as info,
    ):
        execute(case)
    assert "canBeInstantiatedOnlyOncePerProcess, and rear would be a second instance" in str(info.value)


def test_a_unit_of_even_steps_gets_even_steps(small_ssp, tmp_path):
    flag = "canHandleVariableCommunicationStepSize="
    path = flagged(small_ssp, tmp_path, f'{flag}"true"', f'{flag}"false"')
    with ssp_case(path, {"end": 0.01005}) as case, pytest.raises(FmuError, match="no multiple of step"):
        execute(case)
    with (
        ssp_case(path, {"tolerance": 0.1}) as case,
        pytest.raises(FmuError, match="a tolerance halves steps"),
    ):
        execute(case)
    with ssp_case(path, {"end": 0.001}) as case:
        assert execute(case).record is not None


def test_a_unit_for_model_exchange_only_is_named(small_ssp, tmp_path):
    path = flagged(small_ssp, tmp_path, "<CoSimulation .*?/>", '<ModelExchange modelIdentifier="x" />')
    with (
        pytest.raises(SspError, match=r"not an FMI 2.0 co-simulation unit: for model exchange only"),
        ssp_case(path),
    ):
        pass
