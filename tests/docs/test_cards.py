"""Cards of the laws: whole, and what they name exists."""

import re
from pathlib import Path

import law_cards
import pytest

ROOT = Path(__file__).parent.parent.parent
NAMES = law_cards.names()
SECTIONS = (
    "Equations",
    "Parameters",
    "Where it holds",
    "Known defects",
    "Checked against",
    "Tests",
    "Cost",
    "Reference",
)


def test_every_law_has_a_card_and_no_other():
    assert set(law_cards.words()) - {"where"} == set(NAMES)
    assert len(NAMES) >= 20


@pytest.mark.parametrize("name", NAMES)
def test_card_is_whole(name):
    page = law_cards.page(name)
    assert re.findall(r"(?m)^## (.*)$", page) == list(SECTIONS)
    for part in re.split(r"(?m)^## .*$", page):
        assert len(part.strip()) > 10
    assert "```latex" not in page  # every formula can be set
    assert f"{name}.svg" in page


@pytest.mark.parametrize("name", NAMES)
def test_named_tests_exist(name):
    for test, tolerance in law_cards.words()[name]["tests"]:
        file, _, inner = test.partition("::")
        text = (ROOT / file).read_text(encoding="utf-8")
        if inner:
            assert re.search(rf"(?m)^(class|def) {inner}\b", text), test
        assert len(tolerance) > 3


@pytest.mark.parametrize("name", NAMES)
def test_reference_values_exist(name):
    for feature, count, rtol in law_cards._cases(law_cards.words()[name]):
        assert count > 0, feature
        assert 0.0 < rtol <= 1e-5


def test_words_on_parameters_are_used():
    used = set()
    for name in NAMES:
        used |= set(re.findall(r"(?m)^\| `(\w+)` \|", law_cards.page(name)))
    assert set(law_cards.words()["where"]) <= used


def test_overview_has_every_law_with_a_cost():
    rows = law_cards.overview().splitlines()[2:]
    assert len(rows) == len(NAMES)
    for row in rows:
        assert float(row.split("|")[-2]) > 0.0


@pytest.mark.parametrize("name", ["hertz", "luding2008", "edmans2020", "biwa1995"])
def test_figures(name):
    figure = law_cards.figure(name)
    x, y = figure.axes[0].lines[0].get_data()
    assert y.max() > 0.0
    assert x[-1] < x.max()  # it unloads
