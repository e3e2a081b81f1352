"""Archives as somebody else could send them."""

from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from typer.testing import CliRunner

from orchestrator.cli.main import app
from orchestrator.outcome import INPUT_ERROR


def call(*arguments):
    """Run the command in this process."""
    return CliRunner().invoke(app, [str(item) for item in arguments], env={"COLUMNS": "200"})


def refused(path, room, fmus):
    """What ``bladeloss run`` says of an FMU that the user trusts, or of an SSP; nothing of it is left."""
    out = room.parent / "out"
    given = (path,) if path.suffix == ".ssp" else ("small", "--depth", "v3", "--depth-at", f"rear={path}")
    result = call("run", *given, "--trust", "--fmus", fmus, "--out", out)
    assert result.exit_code == INPUT_ERROR, result.output
    assert not list(room.iterdir()) and not out.exists()
    (text,) = result.stderr.strip().splitlines()
    assert path.name in text
    return text


def with_entry(source, target, name, content=b"x", *, mode=0, more=()):
    """Copy an archive and add an entry, whatever its name or kind; and `more` of (name, content)."""
    with ZipFile(source) as archive, ZipFile(target, "w", ZIP_DEFLATED) as out:
        for entry in archive.infolist():
            out.writestr(entry, archive.read(entry))
        for added, text in ((name, content), *more):
            entry = ZipInfo("x")
            entry.filename = added  # as it is, where the constructor would mend it
            entry.compress_type, entry.create_system, entry.external_attr = ZIP_DEFLATED, 3, mode << 16
            out.writestr(entry, text)
    return target


def with_text(source, target, member, old, new):
    """Copy an archive with a text of one member replaced."""
    with ZipFile(source) as archive, ZipFile(target, "w", ZIP_DEFLATED) as out:
        for entry in archive.infolist():
            content = archive.read(entry)
            if entry.filename == member:
                assert old.encode() in content, old
                content = content.replace(old.encode(), new.encode(), 1)
            out.writestr(entry.filename, content)
    return target


def with_doctype(source, target, member, entities):
    """Copy an archive with a document type in one of its XML files."""
    return with_text(source, target, member, "?>", f"?><!DOCTYPE x [{entities}]>")
