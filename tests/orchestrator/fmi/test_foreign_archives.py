"""FMUs and SSPs of others: what could do harm is refused before anything of it is run, read or kept."""

import os
import stat
import warnings
from pathlib import Path
from zipfile import ZIP_BZIP2, ZipFile

import pytest

from fmus.build.archive import write_archive
from orchestrator.errors import FmuError
from orchestrator.fmi.archive import ArchiveError, Limits, extract
from orchestrator.fmi.file import FmuStore
from tests.faults import fault
from tests.orchestrator.foreign import refused, with_entry
from tests.orchestrator.limits import largest_file


def entry_fault(case, outcome, guard):
    return fault("archive", case, f"exit 2; {outcome}", guard=f"orchestrator.fmi.archive:{guard}")


ENTRIES = [
    pytest.param(
        "/evil", {}, "'/evil' is absolute",
        marks=entry_fault(
            "an entry with an absolute path", "archive, entry, `is absolute`", "_problem"
        ),
    ),
    pytest.param(
        "resources/../../../evil", {}, "'resources/../../../evil' leaves its folder",
        marks=entry_fault(
            "an entry with `..`", "archive, entry, `leaves its folder`",
            "_problem",
        ),
    ),
    pytest.param(
        "resources\\..\\evil", {}, "has a drive or a backslash",
        marks=entry_fault(
            "an entry with backslashes", "archive, entry, `a drive or a backslash`", "_problem"
        ),
    ),
    pytest.param(
        "C:evil", {}, "'C:evil' is absolute or has a drive",
        marks=entry_fault("an entry on a drive", "archive, entry, `a drive`", "_problem"),
    ),
    pytest.param(
        "resources/a\x1b[2Jb", {}, "control character",
        marks=entry_fault(
            "an entry with control characters in its name", "archive, entry, `control character`",
            "_problem",
        ),
    ),
    pytest.param(
        "resources/link", {"content": b"/etc", "mode": stat.S_IFLNK}, "'resources/link' is a symbolic link",
        marks=entry_fault(
            "a symbolic link", "archive, entry, `a symbolic link`", "_KINDS"
        ),
    ),
    pytest.param(
        "resources/pipe", {"mode": stat.S_IFIFO | 0o666}, "'resources/pipe' is a pipe",
        marks=entry_fault("a pipe or a device", "archive, entry, `is a pipe`", "_KINDS"),
    ),
    pytest.param(
        "modelDescription.xml", {}, "'modelDescription.xml' is there twice",
        marks=entry_fault(
            "two entries of one name, for tools to see one or the other", "archive, entry, `twice`",
            "_check",
        ),
    ),
    pytest.param(
        "resources/zeros", {"content": bytes(18 << 20)}, "'resources/zeros' makes more than 200 bytes of one",
        marks=entry_fault(
            "a size bomb: 18 MiB from 18 kB", "archive, entry, `more than 200 bytes of one`",
            "_write",
        ),
    ),
]  # fmt: skip


@pytest.mark.parametrize(("name", "entry", "said"), ENTRIES)
def test_an_entry_that_could_do_harm_ends_the_command(name, entry, said, small_fmus, room, tmp_path):
    source = small_fmus / "bearing_v3.fmu"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # zipfile warns of the doubled name
        small = tmp_path / "plain.fmu"
        write_archive(small, {"modelDescription.xml": ZipFile(source).read("modelDescription.xml")})
        path = with_entry(small, tmp_path / "foreign.fmu", name, **entry)
    assert said in refused(path, room, small_fmus)
    assert not (tmp_path / "evil").exists() and not Path("/evil").exists()


@fault(
    "archive",
    "an SSP with an entry outside its folder",
    "exit 2; archive, entry, `leaves its folder`; nothing extracted remains",
    guard="orchestrator.fmi.archive:extract",
)
def test_an_ssp_is_extracted_with_the_same_care(small_ssp, small_fmus, room, tmp_path):
    path = with_entry(small_ssp, tmp_path / "foreign.ssp", "../evil")
    assert "entry '../evil' leaves its folder" in refused(path, room, small_fmus)
    assert not (tmp_path / "evil").exists()


def tampered(path, offset, value):
    """Overwrite bytes at an offset of the last record of the central directory."""
    data = bytearray(path.read_bytes())
    at = data.rindex(b"PK\x01\x02") + offset
    data[at : at + len(value)] = value
    path.write_bytes(data)
    return path


@fault(
    "archive",
    "an encrypted entry",
    "exit 2; archive, entry, `is encrypted`",
    guard="orchestrator.fmi.archive:_problem",
)
def test_an_encrypted_entry(small_fmus, room, tmp_path):
    path = with_entry(small_fmus / "bearing_v3.fmu", tmp_path / "foreign.fmu", "resources/secret")
    text = refused(tampered(path, 8, b"\x01\x00"), room, small_fmus)
    assert "'resources/secret' is encrypted; allowed are plain entries" in text


@fault(
    "archive",
    "an entry compressed by a method of unbounded gain",
    "exit 2; archive, entry, `compressed by method`",
    guard="orchestrator.fmi.archive:_problem",
)
def test_methods_of_compression(small_fmus, room, tmp_path):
    path = tmp_path / "foreign.fmu"
    path.write_bytes((small_fmus / "bearing_v3.fmu").read_bytes())
    with ZipFile(path, "a", ZIP_BZIP2) as archive:
        archive.writestr("resources/x", b"x")
    assert "'resources/x' is compressed by method 12" in refused(path, room, small_fmus)


@fault(
    "archive",
    "an entry that is longer than its header says",
    "exit 2; archive, `not a readable FMU`; nothing extracted remains",
    guard="orchestrator.fmi.archive:extract",
)
def test_a_header_that_lies_about_the_size(small_fmus, room, tmp_path):
    path = with_entry(small_fmus / "bearing_v3.fmu", tmp_path / "foreign.fmu", "resources/x", bytes(1 << 20))
    with pytest.raises(ArchiveError, match=r"foreign\.fmu: not a readable FMU: Bad CRC"):
        extract(tampered(path, 24, (10).to_bytes(4, "little")), room / "x", "FMU")
    assert not list(room.iterdir())


@fault(
    "archive",
    "more bytes, by the headers, than an archive may hold",
    "FmuError before anything is written; `more than the … MiB that are allowed`",
    guard="orchestrator.fmi.archive:_check",
)
def test_the_sum_of_all_sizes(small_fmus, room, monkeypatch):
    monkeypatch.setattr(Path, "mkdir", None)  # nothing may be written
    with pytest.raises(ArchiveError, match="holds more than the 0 MiB that are allowed"):
        extract(small_fmus / "bearing_v3.fmu", room / "x", "FMU", Limits(total=100_000))


@fault(
    "archive",
    "more entries than an archive may hold",
    "ArchiveError; number and what is allowed",
    guard="orchestrator.fmi.archive:_check",
)
def test_the_number_of_entries(small_fmus, room):
    with pytest.raises(ArchiveError, match=r"bearing_v3\.fmu: holds \d+ entries; allowed are 3"):
        extract(small_fmus / "bearing_v3.fmu", room / "x", "FMU", Limits(entries=3))


@fault(
    "archive",
    "many FMUs, each of an allowed size, that fill the disk together",
    "FmuError; `more than the … MiB that are allowed`",
    guard="orchestrator.fmi.file:FmuStore.open",
)
def test_all_fmus_of_a_run_share_one_limit(small_fmus, monkeypatch):
    monkeypatch.setattr("orchestrator.fmi.file.LIMITS", Limits(total=1_500_000))
    with FmuStore() as store:
        store.open(small_fmus / "bearing_v3.fmu")
        with pytest.raises(FmuError, match="more than the 0 MiB that are allowed"):
            store.open(small_fmus / "rotor_small.fmu")


@fault(
    "machine",
    "a full disk, or a limit of file sizes, while an FMU is extracted",
    "exit 2; archive, folder, reason, `TMPDIR`; nothing extracted remains",
    guard="orchestrator.fmi.archive:extract",
)
def test_no_room_for_what_is_extracted(small_fmus, room):
    with largest_file(20_000), pytest.raises(ArchiveError) as info:
        extract(small_fmus / "bearing_v3.fmu", room / "x", "FMU")
    text = str(info.value)
    assert f"cannot be extracted to {room}: {os.strerror(27)}" in text and "TMPDIR" in text
    assert not list(room.iterdir())


@fault(
    "archive",
    "a pipe or a device, which has no end, in the place of an SSP or an FMU",
    "exit 2; archive, `no file`",
    guard="orchestrator.fmi.archive:extract",
)
def test_what_is_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe.ssp")
    for path in (tmp_path / "pipe.ssp", Path("/dev/zero")):
        with pytest.raises(ArchiveError, match="not a readable SSP: no file"):
            extract(path, tmp_path / "x", "SSP")
