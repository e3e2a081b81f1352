"""Samples of a study: products, strata, designs, and the seed that fixes them."""

import numpy as np
import pytest

from orchestrator.results.ensemble.probability import clopper_pearson
from orchestrator.study.ensemble.sampling.changes import KeyPathError, changed
from orchestrator.study.ensemble.sampling.samples import samples_of, size_of
from orchestrator.study.ensemble.sampling.schema import Span, Study

UNIFORM = {"key": "a", "distribution": "uniform", "arguments": {"loc": 2.0, "scale": 3.0}}


def study(parameters, **more):
    return Study.model_validate({"parameters": parameters, **more})


def test_lists_go_together_and_grids_in_all_combinations():
    found = samples_of(
        study(
            {
                "a": {"key": "a", "values": [1, 2]},
                "b": {"key": "b", "values": ["x", "y"]},
                "c": {"key": "c", "grid": [0.1, 0.2, 0.3]},
                "d": {"key": "d", "grid": [True]},
            }
        )
    )
    assert [tuple(found[k].values()) for k in range(len(found))] == [
        (a, b, c, True) for a, b in ((1, "x"), (2, "y")) for c in (0.1, 0.2, 0.3)
    ]


@pytest.mark.parametrize("method", ["latin-hypercube", "sobol"])
def test_a_draw_lies_in_each_stratum(method):
    """Of n draws one in each n-th of the probability, for each parameter."""
    found = samples_of(
        study({"a": UNIFORM, "b": {**UNIFORM, "key": "b"}}, sampling={"method": method, "count": 64})
    )
    for name in ("a", "b"):
        strata = np.floor((np.array(found.columns[name]) - 2.0) / 3.0 * 64).astype(int)
        assert sorted(strata) == list(range(64))


def test_the_seed_decides_and_the_distribution_is_met():
    asked = {"a": {"key": "a", "distribution": "norm", "arguments": {"loc": 5.0, "scale": 0.1}}}
    sampling = {"method": "latin-hypercube", "count": 500}
    one, same, other = (samples_of(study(asked, sampling=sampling, seed=s)).columns["a"] for s in (1, 1, 2))
    assert one == same != other
    assert np.mean(one) == pytest.approx(5.0, abs=1e-3) and np.std(one) == pytest.approx(0.1, rel=0.02)


def test_whole_numbers_stay_whole():
    asked = {"a": {"key": "a", "distribution": "randint", "arguments": {"low": 3, "high": 6}}}
    found = samples_of(study(asked, sampling={"method": "random", "count": 30})).columns["a"]
    assert set(found) == {3, 4, 5} and all(type(value) is int for value in found)


@pytest.mark.parametrize(("method", "size"), [("sensitivity-sobol", 8 * 5), ("sensitivity-morris", 8 * 4)])
def test_a_design_has_its_size(method, size):
    pytest.importorskip("SALib", reason="designs are drawn by SALib, which is not installed")
    asked = study({n: {**UNIFORM, "key": n} for n in "abc"}, sampling={"method": method, "count": 8})
    found = samples_of(asked)
    assert len(found) == size_of(asked) == size == len(found.unit)
    assert min(found.columns["a"]) >= 2.0 and max(found.columns["c"]) <= 5.0


def test_a_span_in_ratios():
    span = Span.model_validate({"start": 1.0, "stop": 100.0, "count": 3, "spacing": "log"})
    asked = study({"a": {"key": "a", "grid": [0.0]}})
    asked.parameters["a"] = asked.parameters["a"].model_copy(update={"grid": span})
    np.testing.assert_allclose(samples_of(asked).columns["a"], [1.0, 10.0, 100.0])


def test_keys_lead_through_tables_and_lists_and_leave_the_original():
    data = {"damping": {"alpha": 1.0}, "bearing": [{"name": "front", "c": 1.0}, {"name": "rear", "c": 2.0}]}
    assert changed(data, "bearing.rear.c", 9.0)["bearing"][1] == {"name": "rear", "c": 9.0}
    assert [b["c"] for b in changed(data, "bearing.*.c", 2.0, factor=True)["bearing"]] == [2.0, 4.0]
    assert changed(data, "bearing.0.c", 5.0)["bearing"][0]["c"] == 5.0
    drawn = {"bearing": [{"c": "75 um", "k": ["20 kN/mm", 3.0]}]}
    assert changed(drawn, "bearing.*.c", 0.5, factor=True)["bearing"][0]["c"] == "37.5 um"
    assert changed(drawn, "bearing.0.k", 2.0, factor=True)["bearing"][0]["k"] == ["40.0 kN/mm", 6.0]
    assert changed(data, "new.key", 5.0)["new"] == {"key": 5.0}
    assert data["bearing"][1]["c"] == 2.0 and "new" not in data
    with pytest.raises(KeyPathError, match="reer: did you mean 'rear'"):
        changed(data, "bearing.reer.c", 1.0)
    with pytest.raises(KeyPathError, match="is 'front' there; allowed is a number"):
        changed(data, "bearing.0.name", 1.0, factor=True)
    with pytest.raises(KeyPathError, match=r"leads through 1\.0"):
        changed(data, "damping.alpha.more", 1.0)


def test_bounds_of_a_probability():
    """In closed form where it never happened: 1 - (alpha/2)^(1/n); the unknown widen them."""
    assert clopper_pearson(0, 20) == (0.0, pytest.approx(1.0 - 0.025 ** (1 / 20)))
    assert clopper_pearson(20, 20) == (pytest.approx(0.025 ** (1 / 20)), 1.0)
    low, high = clopper_pearson(3, 10)  # Clopper and Pearson's chart; 0.067 and 0.652
    assert (low, high) == (pytest.approx(0.06674, abs=1e-5), pytest.approx(0.65245, abs=1e-5))
    assert clopper_pearson(3, 12, 2) == (clopper_pearson(3, 12)[0], clopper_pearson(5, 12)[1])
