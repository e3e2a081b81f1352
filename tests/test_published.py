"""The page of published cases says what the marks of the tests say."""

from tests.published import PAGE, PICTURES, cases, page
from tests.published_figures import FIGURES, beam, file_of


def test_the_page_is_up_to_date():
    """Or else: python -m tests.published."""
    assert PAGE.read_text(encoding="utf-8") == page()


def test_no_case_is_told_twice():
    found = list(cases())
    assert len(found) >= 15
    assert len({(case.case, case.source) for case in found}) == len(found)


def test_every_picture_of_the_page_is_drawn_and_lies_in_the_tree():
    assert list(FIGURES) == list(PICTURES)
    for name in FIGURES:
        assert file_of(name).read_bytes().startswith(b"\x89PNG") and file_of(name).stat().st_size < 100_000


def test_a_picture_shows_what_the_code_finds():
    lines = beam().axes[0].lines
    assert len(lines) == 6 and lines[0].get_ydata()[-1] < 1e-5
