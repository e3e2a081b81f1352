"""The page of published cases says what the marks of the tests say."""

from tests.published import PAGE, cases, page


def test_the_page_is_up_to_date():
    """Or else: python -m tests.published."""
    assert PAGE.read_text(encoding="utf-8") == page()


def test_no_case_is_told_twice():
    found = list(cases())
    assert len(found) >= 15
    assert len({(case.case, case.source) for case in found}) == len(found)
