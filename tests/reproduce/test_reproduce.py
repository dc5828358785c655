"""Figures and tables of the papers: all are made, and printed numbers come out."""

import numpy as np
import pytest

from pestle.cli import main
from pestle.errors import InputError
from pestle.reproduce import PAPERS
from pestle.reproduce.draw import draw

WANTED = {
    "zunker2024": "figure-5 figure-8 figure-9 figure-10 figure-11 figure-12 figure-13a "
    "figure-13b figure-13cd figure-B.15 figure-B.16 figure-F.17 figure-F.18 "
    "figure-F.19 figure-F.20 figure-F.21",
    "shahin2021": " ".join(f"figure-2.{n}" for n in [*range(9, 24), *range(26, 31)])
    + " figure-3.6 figure-3.7 figure-3.8 figure-3.9 figure-3.10 table-2.4 table-3.1 "
    "table-A.1 table-C.1",
    "edmans2020": " ".join(f"figure-{n}" for n in [1, *range(3, 14), *range(15, 23)])
    + " table-1",
    "nan2022": "figure-5 figure-6 figure-7 figure-8 figure-9 figure-10 figure-13 "
    "table-2 table-3 table-6 table-cy",
}
ITEMS = [(name, key) for name, keys in WANTED.items() for key in keys.split()]


def result(name, key):
    return PAPERS[name].items[key].make()


def test_the_list_is_whole():
    assert set(PAPERS) == set(WANTED)
    for name, keys in WANTED.items():
        assert set(PAPERS[name].items) == set(keys.split())


@pytest.mark.parametrize(("name", "key"), ITEMS)
def test_every_item_is_made(name, key):
    """Axes have units, curves have numbers, and there is a sentence."""
    made = result(name, key)
    assert made.said.endswith((".", "%."))
    assert bool(made.panels) != bool(made.columns)
    for panel in made.panels:
        assert panel.lines or panel.regions
        assert "[" in panel.xlabel
        assert "[" in panel.ylabel
        for line in panel.lines:
            assert len(line.x) == len(line.y) > 1
            assert np.any(np.isfinite(np.asarray(line.y, dtype=float)))
    lengths = {len(column) for column in made.columns.values()}
    assert len(lengths) <= 1


@pytest.mark.parametrize(
    ("name", "key", "panels"),
    [("shahin2021", "figure-2.22", 3), ("zunker2024", "figure-F.21", 6)],
)
def test_a_figure_is_drawn(name, key, panels):
    figure = draw(result(name, key))
    assert len(figure.axes) == panels
    assert all(axes.get_xlabel() for axes in figure.axes if axes.axison)


def pairs(columns, ours, printed):
    rows = zip(columns[ours], columns[printed], strict=True)
    return [(a, b) for a, b in rows if isinstance(b, float)]


@pytest.mark.parametrize(
    ("name", "key", "ours", "printed", "tolerance"),
    [
        ("shahin2021", "table-A.1", "lambda", "lambda, printed", 2.8e-4),
        ("shahin2021", "table-C.1", "discriminant/4R^2", "printed", 5e-5),
        ("nan2022", "table-2", "value [N/m]", "printed [N/m]", 0.031),
        ("nan2022", "table-3", "(44)", "printed", 0.02),
        ("nan2022", "table-3", "(48)", "printed (48)", 0.02),
        ("nan2022", "table-6", "value [m/s]", "printed [m/s]", 0.0125),
    ],
)
def test_printed_numbers(name, key, ours, printed, tolerance):
    found = pairs(result(name, key).columns, ours, printed)
    assert found
    assert max(abs(a / b - 1.0) for a, b in found) < tolerance


def test_table_3_1_but_for_its_misprint():
    columns = result("shahin2021", "table-3.1").columns
    off = [abs(a / b - 1.0) for a, b in pairs(columns, "value", "printed")]
    assert max(off[:-1]) < 2e-5
    assert columns["value"][-1] == pytest.approx(49.866, abs=5e-4)


def test_die_forces_of_figure_12_are_the_reference_ones():
    panels = result("zunker2024", "figure-12").panels
    assert panels[0].lines[0].y[-1] == pytest.approx(0.156411314, rel=1e-7)
    assert panels[1].lines[0].y[-1] == pytest.approx(0.053664551, rel=1e-7)


class TestCommand:
    def test_lists_papers_and_items(self, capsys):
        assert main(["reproduce"]) == 0
        out = capsys.readouterr().out
        for name, key in ITEMS:
            assert name in out
            assert key in out

    @pytest.mark.parametrize("words", ["Table 2.4", "table-2.4", "2.4"])
    def test_makes_a_table(self, capsys, tmp_path, words):
        assert main(["reproduce", "shahin2021", words, "--out", str(tmp_path)]) == 0
        assert "Cannot be derived" in capsys.readouterr().out
        assert (tmp_path / "shahin2021-table-2.4.csv").exists()

    def test_makes_an_image(self, tmp_path):
        words = ["reproduce", "nan2022", "fig 5", "--out", str(tmp_path)]
        assert main([*words, "--format", "svg"]) == 0
        assert (tmp_path / "nan2022-figure-5.svg").read_text().startswith("<?xml")

    def test_a_number_may_mean_a_figure_and_a_table(self):
        assert [i.key for i in PAPERS["nan2022"].find("6")] == ["figure-6", "table-6"]

    def test_says_what_there_is(self, capsys):
        assert main(["reproduce", "nan2023"]) == 2
        assert "nan2022" in capsys.readouterr().err
        with pytest.raises(InputError, match="unknown-figure"):
            PAPERS["nan2022"].find("figure 99")
