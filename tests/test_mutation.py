"""What the mutation run takes for a proof."""

import pytest

from tests.fault_table import ROOT
from tests.mutant_tree import Outcomes, kernel_modules
from tests.mutation import judged


def outcomes(*failed, passed=()):
    result = Outcomes()
    result.passed = dict.fromkeys(passed, 1.0)
    result.failed = {f"test_{k}": each for k, each in enumerate(failed)}
    return result


@pytest.mark.parametrize(
    "found, word",
    [
        (outcomes(("AssertionError", "no")), "killed"),
        (outcomes(("assert 1 == 2", "no"), passed=["other"]), "killed"),
        (outcomes(passed=["one"]), "survived"),
        (outcomes(), "invalid"),
        (outcomes(("its setup", "KeyError: x")), "invalid"),
        (outcomes(("its collection", "SyntaxError")), "invalid"),
        (outcomes(("NameError", "name 'x' is not defined")), "invalid"),
        (outcomes(("its teardown", "x"), ("Failed", "DID NOT RAISE")), "killed"),
    ],
)
def test_only_a_failure_of_the_test_itself_kills(found, word):
    assert judged(found).word == word


def test_kernels_are_compiled_anew_where_they_or_their_constants_change():
    modules = kernel_modules(ROOT)
    assert {
        "bearing_fmu/films/tilted/reynolds.py",
        "bearing_fmu/outputs.py",
        "bearing_fmu/status.py",
    } <= modules
    assert not {"bearing_fmu/film.py", "bearing_fmu/parameters.py", "bearing_fmu/facade.py"} & modules
