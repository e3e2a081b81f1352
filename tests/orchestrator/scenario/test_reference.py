"""The page of the keys of scenario and train is that of the models."""

from orchestrator.scenario.reference import PAGE, page, reference, train_reference
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.schema import BearingEntry, TrainToml, WheelEntry


def test_the_page_is_up_to_date():
    """Or else: python -m orchestrator.scenario.reference."""
    text = PAGE.read_text(encoding="utf-8")
    assert page(text) == text


def test_every_key_is_explained():
    rows = [line.split(" | ") for line in reference().splitlines()[2:]]
    assert {row[0].removeprefix("| ").strip("`") for row in rows} >= set(Scenario.model_fields) - {"folder"}
    assert all(row[2].removesuffix(" |").strip() for row in rows), rows


def test_every_key_of_a_train_is_explained():
    rows = [
        [cell.strip() for cell in line.strip("|").split(" | ")] for line in train_reference().splitlines()
    ]
    found = {row[0].strip("`") for row in rows[2:]}
    for model, prefix in ((BearingEntry, "bearing."), (WheelEntry, "wheel."), (TrainToml, "")):
        assert found >= {prefix + name for name in model.model_fields} - {"wheel", "mass", "coupling"}
    assert all(row[4] for row in rows[2:]), [row for row in rows if not row[4]]
    assert "| m | > 0, ≤ 0.1 | *must be given* |" in train_reference()
