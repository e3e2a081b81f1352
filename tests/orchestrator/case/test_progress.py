"""Progress in numbers, as lines and as a bar."""

from io import StringIO

import pytest
from rich.console import Console

from orchestrator.case.progress import Pace, Stage, show_progress


def test_pace_counts_from_the_start_of_the_time_loop():
    wall = iter([0.0, 10.0, 30.0, 30.0])
    pace = Pace(2.0, lambda: next(wall))
    pace.start(0.0)
    assert pace.speed(0.5) == pytest.approx(0.025)
    assert pace.text(0.5) == "0.500 of 2 s, 0.025 s a second, 1:00 min left"


def test_no_speed_before_time_has_passed():
    pace = Pace(2.0, lambda: 5.0)
    assert pace.text(0.0) == "0.000 of 2 s"


def run(console):
    with show_progress(2.0, console) as report:
        report(Stage.LOAD, 0.0)
        report(Stage.WARM_UP, 0.0)
        report(Stage.EQUILIBRIUM, 0.0)
        report(Stage.RUN, 0.0)
        for k in range(1, 20001):
            report(Stage.RUN, k * 1e-4)


def test_a_log_gets_a_line_every_ten_per_cent():
    buffer = StringIO()
    run(Console(file=buffer, width=100))
    lines = buffer.getvalue().splitlines()
    assert lines[:4] == [f"{stage} ..." for stage in Stage]
    assert [line.split(" %")[0].strip() for line in lines[4:]] == [str(k) for k in range(10, 101, 10)]
    assert "\x1b" not in buffer.getvalue()


def test_a_terminal_gets_a_bar_that_vanishes():
    buffer = StringIO()
    run(Console(file=buffer, width=100, force_terminal=True))
    text = buffer.getvalue()
    assert "static equilibrium" in text and "of 2 s" in text
    assert text.count("of 2 s") < 50
