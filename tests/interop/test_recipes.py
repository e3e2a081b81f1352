"""The recipes on the page of the FMUs, run as they stand there."""

import re
import shutil
import subprocess
import sys

import pytest

from tests.interop.tools import REPOSITORY, TOOLS, missing

PAGE = (REPOSITORY / "fmus" / "TOOLS.md").read_text(encoding="utf-8")
RECIPES = dict(re.findall(r"<!-- recipe: (\w+) -->\n```python\n(.*?)```", PAGE, re.DOTALL))


def test_the_page_has_a_recipe_for_each_tool():
    assert tuple(RECIPES) == TOOLS


@pytest.mark.parametrize("tool", TOOLS)
def test_recipe(tool, exported, fmus, tmp_path):
    if missing(tool):
        pytest.skip(f"{tool}: {missing(tool)}")
    for path in (*exported, fmus / "bearing_v1.fmu"):
        shutil.copy(path, tmp_path)
    command = [sys.executable, "-c", RECIPES[tool]]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = re.findall(r"^[(\d.,e+ -]+\)?$", done.stdout, re.MULTILINE)  # a tool may log to the same stream
    last = float(lines[-1].strip("()").split(", ")[tool == "fmpy"])
    assert last > 1e4  # N, upwards
