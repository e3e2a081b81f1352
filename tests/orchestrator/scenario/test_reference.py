"""The page of the scenario's keys is that of the models."""

from orchestrator.scenario.reference import PAGE, page, reference
from orchestrator.scenario.scenario import Scenario


def test_the_page_is_up_to_date():
    """Or else: python -m orchestrator.scenario.reference."""
    text = PAGE.read_text(encoding="utf-8")
    assert page(text) == text


def test_every_key_is_explained():
    rows = [line.split(" | ") for line in reference().splitlines()[2:]]
    assert {row[0].removeprefix("| ").strip("`") for row in rows} >= set(Scenario.model_fields) - {"folder"}
    assert all(row[2].removesuffix(" |").strip() for row in rows), rows
