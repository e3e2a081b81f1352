"""What the XML and the references of a foreign FMU or SSP could do is refused, too."""

from pathlib import Path
from zipfile import ZipFile

import pytest

from fmus.build.archive import guid_in, write_archive
from orchestrator.case.case import ssp_case
from orchestrator.ssp.structure import SspError
from tests.faults import fault
from tests.orchestrator.foreign import refused, with_doctype, with_text

LAUGHS = '<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">'
EXTERNAL = '<!ENTITY a SYSTEM "file:///etc/hostname">'


@pytest.mark.parametrize(
    "entities",
    [
        pytest.param(
            LAUGHS,
            marks=fault(
                "archive",
                "a modelDescription with entities that expand",
                "exit 2; archive, `document type or entities`",
                guard="orchestrator.fmi.xml:read_xml",
            ),
        ),
        pytest.param(
            EXTERNAL,
            marks=fault(
                "archive",
                "a modelDescription with an external entity, which would read a file of the user",
                "exit 2; archive, `document type or entities`",
                guard="orchestrator.fmi.file:FmuFile.__init__",
            ),
        ),
    ],
)
def test_a_description_with_entities(entities, small_fmus, room, tmp_path):
    bearing = small_fmus / "bearing_v3.fmu"
    path = with_doctype(bearing, tmp_path / "foreign.fmu", "modelDescription.xml", entities)
    assert "modelDescription.xml has a document type or entities" in refused(path, room, small_fmus)


@pytest.mark.parametrize(
    "member",
    [
        pytest.param(
            "SystemStructure.ssd",
            marks=fault(
                "archive",
                "an SSD with an external entity",
                "exit 2; archive, file, `document type or entities`",
                guard="orchestrator.ssp.reader:read_ssp",
            ),
        ),
        pytest.param(
            "resources/rotor.ssv",
            marks=fault(
                "archive",
                "an SSV with an external entity",
                "exit 2; archive, file, `document type or entities`",
                guard="orchestrator.ssp.values:Bindings._source",
            ),
        ),
    ],
)
def test_an_ssp_with_entities(member, small_ssp, small_fmus, room, tmp_path):
    path = with_doctype(small_ssp, tmp_path / "foreign.ssp", member, EXTERNAL)
    text = refused(path, room, small_fmus)
    assert f"{Path(member).name} has a document type or entities" in text


@pytest.mark.parametrize(
    ("old", "new"),
    [
        pytest.param(
            'source="resources/bearing_v3.fmu"', 'source="../../foreign.fmu"',
            marks=fault(
                "archive",
                "an SSP whose component is an FMU outside the archive",
                "exit 2; archive, path, `leads out of the archive`",
                guard="orchestrator.ssp.contents:understand",
            ),
        ),
        pytest.param(
            'source="resources/rotor.ssv"', 'source="/etc/hostname"',
            marks=fault(
                "archive",
                "an SSP whose parameters lie outside the archive",
                "exit 2; archive, path, `leads out of the archive`",
                guard="orchestrator.ssp.values:Bindings._source",
            ),
        ),
    ],
)  # fmt: skip
def test_an_ssp_that_refers_to_files_outside(old, new, small_ssp, small_fmus, room, tmp_path):
    path = with_text(small_ssp, tmp_path / "foreign.ssp", "SystemStructure.ssd", old, new)
    text = refused(path, room, small_fmus)
    assert "leads out of the archive; allowed are files in it" in text
    assert new.split('"')[1] in text


@fault(
    "archive",
    "a model identifier that names a library outside the FMU",
    "exit 2; archive, `modelIdentifier`, what is allowed",
    guard="orchestrator.fmi.file:FmuFile.__init__",
)
def test_a_model_identifier_with_a_path(small_fmus, room, tmp_path):
    change = ("modelDescription.xml", 'modelIdentifier="bladeloss_', 'modelIdentifier="../../../')
    path = with_text(small_fmus / "bearing_v3.fmu", tmp_path / "foreign.fmu", *change)
    assert "modelIdentifier '../../../bearing_v3'; allowed are letters, " in refused(path, room, small_fmus)


@fault(
    "archive",
    "a parameter of an SSP that is no number",
    "SspError; parameter and text",
    guard="orchestrator.ssp.values:_converted",
)
@pytest.mark.parametrize("text", ["nan", "1,5"])
def test_a_parameter_that_is_no_number(text, small_ssp, tmp_path):
    change = ("resources/front.ssv", 'value="0.22"', f'value="{text}"')
    path = with_text(small_ssp, tmp_path / "x.ssp", *change)
    with pytest.raises(SspError, match=rf"parameter diameter: '{text}' is no Real"), ssp_case(path):
        pass


@fault(
    "archive",
    "an SSP whose rotor holds a damaged train",
    "SspError; FMU, `train.json is no train`",
    guard="orchestrator.ssp.contents:_train",
)
def test_a_damaged_train(small_ssp, small_fmus, tmp_path):
    rotor = tmp_path / "rotor.fmu"
    with_text(small_fmus / "rotor_small.fmu", rotor, "resources/train.json", "name", "nom")
    with ZipFile(small_ssp) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    files["resources/rotor_small.fmu"] = rotor.read_bytes()
    write_archive(tmp_path / "x.ssp", files)
    with (
        pytest.raises(SspError, match=r"x\.ssp: rotor_small\.fmu: train\.json is no train"),
        ssp_case(tmp_path / "x.ssp"),
    ):
        pass


@fault(
    "archive",
    "a doctored FMU in the build folder, with a document type",
    "it counts as stale, and is built anew",
    guard="fmus.build.archive:guid_in",
)
def test_the_guid_is_read_with_the_same_care(small_fmus, tmp_path):
    bearing = small_fmus / "bearing_v3.fmu"
    path = with_doctype(bearing, tmp_path / "foreign.fmu", "modelDescription.xml", "")
    assert guid_in(bearing) and guid_in(path) is None
