"""The report as a browser shows it: every figure drawn, slider, choice and hover at work, no network."""

import pytest

pytest.importorskip("plotly", reason="the report is drawn by plotly, which is not installed")

from orchestrator.report.source import results_of
from orchestrator.report.write import write_report
from tests.orchestrator.report import browser
from tests.orchestrator.results import synthetic_record

pytestmark = pytest.mark.skipif(
    browser.path() is None, reason=f"no browser: none of {', '.join(browser.NAMES)}"
)

SHOWN = "[...document.querySelectorAll('.panel:not(.other)')]"
SCROLL = """(async () => {
  for (const panel of document.querySelectorAll(".panel:not(.other)")) {
    panel.scrollIntoView();
    for (let k = 0; k < 3000 && panel.dataset.drawn !== "yes"; k++)
      await new Promise((done) => setTimeout(done, 20));
  }
})()"""
CHOOSE = """(() => {
  const choice = document.querySelector("#bearing");
  choice.value = "LP1-rear";
  choice.dispatchEvent(new Event("change"));
})()"""
SLIDE = """(() => {
  const bar = document.querySelector("#shaft3d input");
  bar.value = 0;
  bar.dispatchEvent(new Event("input"));
})()"""
MIDDLE = """(() => {
  const box = document.querySelector("#series .panel:not(.other) .nsewdrag").getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2];
})()"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """Of two runs side by side, in a folder of its own."""
    records = [synthetic_record.record(depth, end=1.4).isel(bearing=[3, 4]) for depth in ("v1", "v3")]
    file = write_report(results_of(records), tmp_path_factory.mktemp("empty") / "report.html")
    with browser.Page() as page:
        page.resize(390, 900)
        page.open(file)
        page.value(SCROLL)
        yield page


def test_every_figure_is_drawn(page):
    assert page.value(f"{SHOWN}.map((panel) => panel.dataset.drawn)") == ["yes"] * 15
    drawn = "panel.querySelectorAll('.main-svg, canvas').length > 0"
    assert page.value(f"{SHOWN}.every((panel) => {drawn})")


@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_is_as_wide_as_the_window(page, width):
    page.resize(width, 900)
    assert page.value("document.documentElement.scrollWidth") == width
    widest = "Math.max(...[...document.querySelectorAll('.plot .main-svg')].map((svg) => svg.clientWidth))"
    page.until(f"{widest} <= {width}", 20.0)


def test_another_bearing_can_be_chosen(page):
    heading = "document.querySelector('#series .panel:not(.other) h3').textContent"
    assert page.value(heading) == "LP2-front: force, least gap, contact"
    page.value(CHOOSE)
    assert page.value(heading) == "LP1-rear: force, least gap, contact"
    page.value(SCROLL)
    assert page.value(f"{SHOWN}.every((panel) => panel.dataset.drawn === 'yes')")


def test_the_slider_moves_the_shaft(page):
    line = "document.querySelector('#shaft3d .plot').data[0].y.slice(0, 40).join()"
    before = page.value(line)
    page.value(SLIDE)
    assert page.value(line) != before
    assert page.value("document.querySelector('#shaft3d output').textContent").startswith("t = 0.96")


def test_a_value_is_shown_below_the_mouse(page):
    page.value("document.querySelector('#series').scrollIntoView()")
    x, y = page.value(MIDDLE)
    for shift in range(0, 60, 4):
        page.move_mouse(x + shift, y + shift / 2)
    page.until("document.querySelector('#series .panel:not(.other) .hoverlayer').textContent !== ''", 20.0)


def test_nothing_goes_wrong_and_nothing_is_fetched(page):
    assert page.complaints == []
    assert all(url.startswith(("file:", "data:", "blob:", "about:")) for url in page.requests), page.requests
