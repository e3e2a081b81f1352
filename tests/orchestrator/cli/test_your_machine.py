"""The page "Your machine in thirty minutes": its commands run as they stand there."""

import re
import shlex
import subprocess
from pathlib import Path

import pytest
from typer.testing import CliRunner

from orchestrator.cli.main import app
from orchestrator.report import document

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "orchestrator" / "YOUR_MACHINE.md"
DRAWING = ROOT / "rotor_fmu" / "train" / "README.md"


def commands():
    blocks = re.findall(r"<!-- commands -->\n```\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    return "".join(blocks).splitlines()


def modes_of(text):
    """Shares of the modes of the films, frequencies to 0.1 Hz of those that bend, as `modes` says them."""
    rows = [line.split() for line in text.splitlines() if re.match(r" +\d+ +\d+\.\d{3} ", line)]
    films = [row[4] for row in rows if float(row[1]) < 26.0]
    return films, [f"{float(row[1]):.1f}" for row in rows if float(row[4]) > 80.0]


def test_the_commands_of_the_page_lead_to_a_report(once, tmp_path, monkeypatch):
    """With FMUs from a folder of the tests, and shorter runs; figures are drawn elsewhere."""
    monkeypatch.setattr(document, "require_library", lambda: lambda: "library")
    monkeypatch.setattr("orchestrator.report.print.figures_of", lambda *_, **__: iter(()))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    fmus = ["--fmus", str(once("your_machine", lambda folder: None))]
    said = []
    for command in commands():
        program, *words = shlex.split(command)
        if program != "bladeloss":
            subprocess.run([program, *words], check=True)
            continue
        more = {"run": [*fmus, "--end", "0.03", "--no-figures"], "modes": fmus}.get(words[0], [])
        result = CliRunner().invoke(app, [*words, *more], env={"COLUMNS": "120"})
        assert result.exit_code == 0, (command, result.output)
        said.append(result.output)
    assert "468.4 kg" in said[0]
    films, bending = modes_of(said[1])
    drawn = DRAWING.read_text(encoding="utf-8")
    said_bending = r"motor at (\S+) and (\S+) Hz, the overhung impeller at (\S+) and (\S+) Hz"
    assert bending[:4] == list(re.search(said_bending, drawn).groups())
    assert films == list(re.search(r"has (\d+), (\d+), (\d+) and (\d+) %", drawn).groups())
    assert "the first bending modes are at {} and {} Hz".format(*bending) in PAGE.read_text(encoding="utf-8")
    assert (tmp_path / "depths.html").is_file() and (tmp_path / "depths.pdf").is_file()
    assert len(said) == 5


@pytest.mark.parametrize("link", sorted(set(re.findall(r"\]\(([^)#]+)", PAGE.read_text(encoding="utf-8")))))
def test_its_links_lead_somewhere(link):
    assert (PAGE.parent / link).exists()
