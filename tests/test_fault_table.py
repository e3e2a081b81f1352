"""The page of the tests says what their marks say."""

import os
import subprocess
import sys

from tests.conftest import COLLECTED
from tests.fault_table import BEGIN, END, ROOT, Fault, faults_of, page, problems_of, table


def test_the_page_is_what_the_marks_say(pytestconfig):
    """Of all tests, whichever are selected: where these are not all, collected in a process of its own."""
    collected = pytestconfig.stash[COLLECTED]
    if {item.path for item in collected} == set((ROOT / "tests").rglob("test_*.py")):
        assert problems_of(faults_of(collected)) == []
        return
    environment = {**os.environ, "PYTEST_ADDOPTS": ""}  # such as to count coverage
    command = [sys.executable, "-m", "tests.fault_table", "--check"]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_row_for_each_fault_below_its_area():
    guard = "a.b:check"
    faults = [
        Fault("unit", "it hangs | twice", "outcome unit_hung", guard, ("tests/a/test_b.py::test_c[1]",)),
        Fault(
            "input", "no file", "exit 2", guard, ("tests/test_d.py::test_e[1]", "tests/test_d.py::test_e[2]")
        ),
    ]
    lines = table(faults).splitlines()
    assert lines[0] == "2 faults, 3 tests."
    row = "| it hangs \\| twice | outcome unit\\_hung | [test\\_c](a/test_b.py) |"
    assert lines.index("| no file | exit 2 | [test\\_e](test_d.py) |") < lines.index(row)
    assert page(faults, f"before\n{BEGIN}\nold\n{END}\nafter").startswith("before\n")
