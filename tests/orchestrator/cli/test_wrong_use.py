"""Wrong use of the command: one line on stderr, exit status 2, the likely spelling, nothing left behind."""

import pytest
from typer.testing import CliRunner

from bearing_fmu import depths
from orchestrator.cli.main import app
from orchestrator.outcome import INPUT_ERROR
from tests.faults import fault


def case(arguments, words, name, outcome, *, guard):
    mark = fault("input", name, outcome, guard=guard)
    return pytest.param(arguments.split(), words, id=name, marks=mark)


CASES = [
    case(
        "run --depth v4", f"--depth v4: allowed are {', '.join(depths.names())}",
        "--depth v4", "exit 2; one line: option, value, all depths",
        guard="orchestrator.cli.wrong_use:one_of",
    ),
    case(
        "run --coupling linear-implict",
        "--coupling linear-implict: did you mean 'linear-implicit'? allowed are",
        "--coupling misspelt", "exit 2; one line: option, value, the likely spelling, all couplings",
        guard="orchestrator.cli.run:RunOptions",
    ),
    case(
        "run --reduction isr", "--reduction isr: did you mean 'irs'? allowed are irs, irs-plain, guyan",
        "--reduction misspelt", "exit 2; one line: option, value, the likely spelling, all reductions",
        guard="orchestrator.cli.run:RunOptions",
    ),
    case(
        "campbell --depth V2", f"--depth V2: did you mean 'v2'? allowed are {', '.join(depths.films())}",
        "--depth V2 of a linear analysis", "exit 2; one line: option, value, the likely spelling",
        guard="orchestrator.cli.linear:FilmDepth",
    ),
    case(
        "run --depth-at LP2-front=V2",
        "--depth-at LP2-front=V2: not NAME=DEPTH; of depths did you mean 'v2'?",
        "--depth-at with an unknown depth", "exit 2; one line: option, value, the likely one, all depths",
        guard="orchestrator.cli.run:_assignments",
    ),
    case(
        "run small --depth-at frnt=v2",
        "small: depth_at.frnt: no such bearing; did you mean 'front'? allowed are front",
        "--depth-at a bearing that the train lacks", "exit 2; one line: the likely name, all bearings",
        guard="orchestrator.scenario.file:_checked",
    ),
    case(
        "run small --bearing frnt",
        "--bearing frnt: no such bearing; did you mean 'front'? allowed are front, rear",
        "--bearing that the train lacks", "exit 2; one line: the likely name, all bearings",
        guard="orchestrator.case.prepare:prepare",
    ),
    case(
        "run --dept v2", "No such option: --dept",
        "a misspelt option", "exit 2; one line: the option, the likely ones",
        guard="orchestrator.cli.wrong_use:Commands.main",
    ),
    case(
        "rn small", "No such command 'rn'. Did you mean 'run'?",
        "a misspelt command", "exit 2; one line: the command, the likely one",
        guard="orchestrator.cli.main:app",
    ),
    case(
        "run small --end soon", "'--end'",
        "a number that is a word", "exit 2; one line: the option",
        guard="orchestrator.cli.wrong_use:Commands.main",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("arguments", "words"), CASES)
def test_wrong_use_is_one_line_and_leaves_nothing(tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("orchestrator.case.prepare.ensure_fmus", lambda *_: pytest.fail("went on"))
    result = CliRunner().invoke(app, arguments, prog_name="bladeloss")
    assert result.exit_code == INPUT_ERROR, result.output
    (line,) = result.output.splitlines()
    assert line.startswith("error: ") and words in line
    assert list(tmp_path.iterdir()) == []


def test_without_a_command_its_help_is_shown():
    result = CliRunner().invoke(app, [], prog_name="bladeloss")
    assert result.exit_code == INPUT_ERROR
    assert result.output.count("Usage: bladeloss") == 1 and "export-ssp" in result.output


def test_a_command_can_be_called_from_python():
    result = CliRunner().invoke(app, ["--version"], prog_name="bladeloss", standalone_mode=False)
    assert result.output.startswith("bladeloss ")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--budget", "inf"), "--budget inf: allowed is a finite number"),
        (("--checkpoint", "inf"), "--checkpoint inf: allowed is a finite number"),
        (("--depth-at", "rear=v1", "--depth-at", "rear=v3"), "rear has been given v1; allowed is one depth"),
    ],
)
def test_what_could_be_meant_in_two_ways_is_refused(arguments, said):
    result = CliRunner().invoke(app, ["run", "small", *arguments])
    assert result.exit_code == INPUT_ERROR and said in result.stderr
