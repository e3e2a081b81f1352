"""What is shipped is valid, and the validation sees what is not."""

import subprocess
import sys
from zipfile import ZipFile

import pytest

from bearing_fmu import depths
from tests.interop.tools import REPOSITORY
from tests.validate_fmus import findings


@pytest.mark.slow  # builds all that is shipped
def test_the_one_command_finds_nothing():
    command = [sys.executable, "-m", "tests.validate_fmus"]
    done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    files = 2 + len(depths.names()) + 2  # rotors, bearings, SSPs
    assert f"\n0 findings in {files} files\n" in done.stdout


def changed(source, target, member, old, new):
    """Copy an archive with a text changed in one of its files."""
    with ZipFile(source) as archive, ZipFile(target, "w") as out:
        for name in archive.namelist():
            content = archive.read(name)
            if name == member:
                assert old in content
                content = content.replace(old, new)
            out.writestr(name, content)
    return target


def test_it_sees_a_spoilt_fmu(fmus, tmp_path):
    bad = changed(
        fmus / "bearing_v3.fmu",
        tmp_path / "bad.fmu",
        "modelDescription.xml",
        b'causality="input"',
        b'causality="put"',
    )
    assert list(findings(bad))


def test_it_sees_a_spoilt_ssp(exported, tmp_path):
    bad = changed(exported[0], tmp_path / "bad.ssp", "SystemStructure.ssd", b'kind="input"', b'kind="put"')
    assert list(findings(bad))
    bad = changed(exported[0], tmp_path / "bad.ssp", "resources/front.ssv", b"ssv:Real", b"ssv:Reel")
    assert list(findings(bad))
