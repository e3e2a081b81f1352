"""The rows of the comparison: figures with known answers, verdicts both ways, what cannot be evaluated."""

import csv
import json
import math
import re
from dataclasses import dataclass, replace
from io import StringIO
from pathlib import Path

import numpy as np
import pytest

from orchestrator.results.quantities import GAP, RATIO, VIBRATION
from orchestrator.results.verdicts.conclusion import Action
from orchestrator.results.verdicts.verdict import held
from orchestrator.scenario.file import load_scenario, with_overrides
from orchestrator.study.depth_run import DepthRun, read_run
from orchestrator.study.paper import published
from orchestrator.study.paper.criterion import by_criterion
from orchestrator.study.paper.report import PaperReport, largest_change, speaks_of
from orchestrator.study.paper.requirement import Requirement, Row, Verdict
from orchestrator.study.paper.rows import rows
from tests.orchestrator.results import synthetic_record
from tests.orchestrator.study.paper_runs import FINE, runs, spoiled


@dataclass(frozen=True)
class NoLimit:
    """A limit of its own."""

    source: str
    read: bool = True


def with_run(found, run):
    return replace(found, runs={**found.runs, run.depth: run})


def test_runs_like_the_papers_meet_every_row():
    table = rows(runs())
    assert [row.number for row in table] == list(range(1, 15))
    assert [row.verdict for row in table] == [Verdict.MET] * 14, [row.missed_by for row in table]
    assert not any(row.missed_by or row.reason or row.obstacle for row in table)


# Row, run, phase, what is other there: a value just outside, one just inside; words that say by how much.
EDGES = [
    (1, "v3", "before", "force_mean", 1.989e6, 1.971e6, "V3: +10.5 %, allowed ±10 %"),
    (2, "v2", "before", "sommerfeld_mean", 3.86, 3.88, "V2: -10.2 %"),
    (3, "v1", "before", "least_gap_mean", 110.5e-6, 109.5e-6, "V1: +10.5 %"),
    (4, "v1", "before", "least_gap_harmonic", 3.4e-6, 3.6e-6, "V1: -32 %"),
    (5, "v2", "before", "least_gap_mean", 120e-6, 119e-6, "V2 - V1: +33.3 %"),
    (6, "v3", "before", "least_gap_mean", 222e-6, 138e-6, "V3 - V1: +307 %, allowed ±30 %"),
    (7, "v1", "before", "amplitude_max", 0.37e-3, 0.35e-3, "V1: +23.3 %"),
    (8, "v3", "before", "stress_max", 31e6, 33e6, "V3: -22.5 %"),
    (9, "v1", "after", "sommerfeld_mean", 6.5, 6.6, "V1: -15.6 %"),
    (
        10,
        "v1",
        "after",
        "contact_largest",
        1.8e3,
        1.9e3,
        "after: 1.80 kN, required above 1.80 kN",
    ),
    (10, "v1", "before", "contact_largest", 1.9e3, 1.7e3, "contact force before"),
    (
        10,
        "v1",
        "after",
        "centre_line_gap_min",
        19e-6,
        21e-6,
        "against roughness: 19.0 µm, required at least 20",
    ),
    (10, "v1", "after", "ends", (0.0, 1.0), (0.02, 0.98), "other end: 0 %, required at least 1 %"),
    (11, "v2", "after", "contact_largest", 1.9e3, 1.7e3, "contact force V2"),
    (11, "v3", "after", "contact_largest", 1.9e3, 1.7e3, "contact force V3"),
    (11, "v2", "before", "least_gap_min", 30e-6, 31e-6, "V2 after: 30.0 µm, required below 30.0 µm"),
    (
        11,
        "v3",
        "after",
        "least_gap_min",
        29e-6,
        31e-6,
        "smallest gap V3 after: 29.0 µm, required above 30.0 µm",
    ),
    (12, "v2", "after", "force_max", 12e6, 5e6, "V1/V2: -66.7 %, allowed ±30 %"),
    (13, "v1", "after", "moment_max", 0.3e6, 0.4e6, "3.9 %, required at least 5 %"),
    (13, "v2", "after", "moment_max", 1.0, 0.0, "moment V2: 1.00 N m, required at most 0 MN m"),
    (14, "v2", "after", "amplitude_max", 2.2e-3, 2.19e-3, "amplitude V2/V3: 1, required below 1"),
    (14, "v3", "after", "stress_max", 90e6, 89e6, "stress V2/V3: 1, required above 1"),
]


@pytest.mark.parametrize(("number", "depth", "phase", "name", "outside", "inside", "words"), EDGES)
def test_a_verdict_turns_where_its_criterion_says(number, depth, phase, name, outside, inside, words):
    missed = rows(spoiled(runs(), depth, phase, **{name: outside}))[number - 1]
    assert missed.verdict is Verdict.MISSED
    assert words in missed.missed_by
    assert missed.reason
    assert rows(spoiled(runs(), depth, phase, **{name: inside}))[number - 1].verdict is Verdict.MET


def test_the_mechanisms_are_told_with_the_figures_of_the_run():
    found = spoiled(runs(), "v3", "before", least_gap_mean=222e-6)
    assert "here 1.93 at So 4.30 and b/d 0.80, far above the paper's 1.13" in rows(found)[5].reason
    for depth in ("v2", "v3"):
        found = spoiled(found, depth, "after", force_max=11e6)
    assert "the blade's 4.30 MN pass through the bearings" in rows(found)[11].reason
    for depth in ("v2", "v3"):
        found = spoiled(found, depth, "after", force_max=6.1e6)
    assert "V1's answer at half the speed" in rows(found)[11].reason
    assert "rear end" in rows(spoiled(runs(), "v1", "after", ends=(0.0, 1.0)))[9].reason
    assert "first swing" in rows(spoiled(runs(), "v2", "after", amplitude_max=3e-3))[13].reason


def test_what_is_not_a_number_is_never_met():
    assert not Requirement.above("x", math.nan, 0.0, RATIO).met
    assert not Requirement.below("x", math.nan, 0.0, GAP).met
    assert Row(1, "", "", "", "", "").verdict is Verdict.NOT_EVALUATED


def test_rows_say_why_they_cannot_be_evaluated():
    full = runs()
    calm = replace(full, runs={d: replace(run, after=None) for d, run in full.runs.items()})
    table = rows(calm)
    assert [row.verdict for row in table[:8]] == [Verdict.MET] * 8
    assert {row.verdict for row in table[8:]} == {Verdict.NOT_EVALUATED}
    assert {row.obstacle for row in table[8:]} == {"no blade fracture in the run"}

    cut = replace(full.runs["v1"], unfinished="step-refused at t = 1.2 s")
    table = rows(with_run(full, cut))
    assert [row.number for row in table if row.verdict is Verdict.NOT_EVALUATED] == [9, 10, 12, 13]
    assert table[8].obstacle == "V1 step-refused at t = 1.2 s"

    gone = DepthRun("v2", "process-died at t = 0 s: ended by SIGKILL")
    table = rows(with_run(full, gone))
    met = [row.number for row in table if row.verdict is Verdict.MET]
    assert met == [3, 4, 6, 9, 10]
    assert "V2 process-died" in table[0].obstacle


def test_the_papers_criterion_asks_for_contact_gap_and_stress():
    def actions(found):
        return {depth: item.action for depth, item in by_criterion(found)}

    found = runs()
    assert list(actions(found).values()) == [Action.TRIP, Action.TOLERABLE, Action.TOLERABLE]
    assert dict(by_criterion(found))["v1"].grounds.startswith("solid contact 20 %")
    narrow = spoiled(found, "v2", "after", least_gap_min=9.9e-6)
    assert actions(narrow)["v2"] is Action.INSPECT
    strained = spoiled(found, "v3", "after", stress_max=published.STRESS_LIMIT * 1.01)
    assert actions(strained)["v3"] is Action.INSPECT
    cut = replace(found.runs["v2"], unfinished="interrupted at t = 1.5 s")
    unknown = dict(by_criterion(with_run(found, cut)))["v2"]
    assert unknown.action is Action.UNKNOWN and "interrupted" in unknown.grounds


def test_an_engineer_holds_every_depth_against_every_limit():
    """What the paper's criterion lets pass may still break a limit, and the table says which."""
    shaking = held(NoLimit("own"), "shaft vibration", ("after", "rear"), VIBRATION, 3e-4, 2e-4, trips=True)
    calm = held(NoLimit("own"), "least film", ("after", "rear"), GAP, 3e-5, 1e-5, share=1.0 / 3.0)
    found = replace(runs(), verdicts={"v1": (shaking,), "v2": (calm, shaking), "v3": (calm,)})
    text = PaperReport(found).to_text()
    assert re.search(r"what follows +trip +trip +tolerable", text)
    words = " ".join(text.split())
    assert "V2 - trip: shut the train down at once: shaft vibration 300 µm at rear against 200 µm." in words
    assert "V2 - tolerable" in text.partition("The paper's criterion alone")[2]
    data = json.loads(PaperReport(found).to_json())
    assert [item["action"].partition(":")[0] for item in data["conclusions"]] == ["trip", "trip", "tolerable"]
    assert data["paper_criterion"][1]["action"].startswith("tolerable")


def test_the_headline_of_the_readme_is_that_of_the_comparison():
    """Of each depth: contact, gap, what follows from every limit, and by the paper's criterion."""
    root = Path(__file__).parents[3]
    text = (root / "orchestrator/scenario/bundled/paper/comparison.txt").read_text()
    paper = " ".join(text.partition("The paper's criterion alone")[2].split())
    (follows,) = re.findall(r"what follows +(\w+) +(\w+) +(\w+)", text)
    rows = re.findall(r"^\| `(v\d)` \|(.+)\|$", (root / "README.md").read_text(), re.MULTILINE)
    assert [depth for depth, _ in rows] == ["v1", "v2", "v3"]
    for (depth, cells), action in zip(rows, follows, strict=True):
        _, contact, gap, every, criterion = (cell.strip() for cell in cells.split("|"))
        sentence = paper.partition(f"{depth.upper()} - ")[2].partition("N/mm²")[0]
        assert sentence.startswith(f"{criterion}: ") and f"least gap {gap}" in sentence
        assert (f"solid contact {contact}" if contact != "none" else "no contact") in sentence
        assert every == action


def test_a_finer_resolution_tells_what_it_changes():
    fine = spoiled(replace(runs(), settings=FINE), "v1", "before", least_gap_mean=101e-6)
    fine = spoiled(fine, "v1", "after", sommerfeld_mean=6.0)
    finest = replace(runs(), settings=replace(FINE, columns=192))
    report = PaperReport(runs(), [fine, finest])
    change, label = largest_change(report.rows[2], rows(fine)[2])
    assert change == pytest.approx(0.01 / 1.1) and label == "V1"  # against the upper bound, 110 µm
    text = report.to_text()
    assert "The verdict changes in rows 9." in text and "met -> missed" in text
    assert "film 96 x 16, macro step 0.05 ms" in text
    assert "Check: film 192 x 16" in text and "No verdict changes." in text
    told = [one["changes"] for one in json.loads(report.to_json())["check"]]
    assert [[item["row"] for item in one if item["verdict_changes"]] for one in told] == [[9], []]
    assert report.to_csv().splitlines()[0].count("verdict there") == 2


def test_text_json_and_csv_say_the_same():
    report = PaperReport(spoiled(runs(), "v3", "before", least_gap_mean=222e-6))
    text = report.to_text()
    assert "13 met, 1 missed of 14 rows" in text
    assert "V3 - V1: +307 %" in text and "Reason, row 6: the gap ratio" in text
    assert "means and harmonic parts 1.400 to 2.000 s" in text
    data = json.loads(report.to_json())
    table = list(csv.DictReader(StringIO(report.to_csv())))
    assert [row["verdict"] for row in data["rows"]] == [row["verdict"] for row in table]
    assert data["rows"][5]["requirements"][0]["value"] == pytest.approx(122e-6)
    assert table[5]["missed by"] == "V3 - V1: +307 %, allowed ±30 %"
    assert data["rows"][9]["requirements"][0]["high"] is None  # no bound


def test_the_paper_speaks_of_its_own_train_blade_and_bearing_only():
    own, all_depths = load_scenario("paper"), ("v1", "v2", "v3")
    assert speaks_of(own, all_depths) and not speaks_of(own, all_depths[:2])
    numerics = {"end": 1.5, "step": 5e-5, "film": {"rows": 12}, "reduction": "guyan", "title": "Mine"}
    assert speaks_of(with_overrides(own, numerics), all_depths)
    for other in (
        {"event": None},
        {"event": {"unbalance": 200.0}},
        {"analysed_bearing": "LP2-front"},
        {"unbalance": {"grade": 6.3e-3}},
    ):
        assert not speaks_of(with_overrides(own, other), all_depths)
    assert speaks_of(load_scenario("inertia"), all_depths)
    assert not speaks_of(load_scenario("small"), all_depths)


def test_a_record_gives_its_known_figures():
    record = synthetic_record.record("v1")
    time = record["time"].values
    # The least gap at the front end for a quarter of the time after the fracture, at the rear end otherwise.
    front = (time > 1.0) & (np.floor(time * 100) % 4 == 0)
    position = np.where(front, -0.32, 0.32)[:, None] * np.ones(record.sizes["bearing"])
    record["least_gap_position"] = (("time", "bearing"), position)
    seen = read_run(record, "v1", "LP2-front")
    assert seen.after.ends == pytest.approx((0.25, 0.75), abs=0.01)
    assert seen.before.ends == pytest.approx((0.0, 1.0), abs=0.01)
    assert seen.before.bearing.least_gap_mean == pytest.approx(100e-6, rel=0.01)
    assert seen.before.contact_largest == 0.0
    assert seen.after.contact_largest > seen.contact_from
    assert seen.start.drift == pytest.approx(0.0, abs=1e-6)
    assert seen.start.harmonic_first == pytest.approx(5e-6, rel=0.01)


def test_a_start_that_decays_shows_as_drift():
    record = synthetic_record.record("v2")
    decay = 1 + 0.2 * np.exp(-record["time"] / 0.05)
    record["least_gap"] = record["least_gap"] * decay
    start = read_run(record, "v2", "LP2-front").start
    mean = 0.2 * 0.05 / 0.08 * (1 - np.exp(-0.08 / 0.05))
    assert start.drift == pytest.approx(1 / (1 + mean) - 1, abs=3e-3)
