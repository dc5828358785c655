"""Figures are drawn, are valid SVG and follow the page."""

import io
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from pestle import plots
from pestle.metrics import summarise
from pestle.metrics.tablet_metrics import key_frames
from pestle.plots.scene import common_view, kept_wall_facets, picture
from pestle.plots.style import VARIABLES
from pestle.results import HistoryTable, RunFolder
from synthetic import write_run


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = write_run(tmp_path_factory.mktemp("run"), count=60, rounds=24)
    with RunFolder(folder) as opened:
        yield opened


@pytest.fixture(scope="module")
def figures(run):
    summary = summarise(run)
    frames = {key: run.results[n] for key, n in key_frames(run).items()}
    drawn = {
        "compaction": plots.compaction_curve(summary.curves, 0.9),
        "stress": plots.stress_paths(summary.curves),
        "heckel": plots.heckel_and_kawakita(summary.curves),
        "energy": plots.energy_ledger(run.history),
        "sizes": plots.sizes_and_forces(frames),
        "walls": plots.wall_forces(run.history),
    }
    return {name: plots.to_svg(figure, name) for name, figure in drawn.items()}


def test_every_figure_is_valid_and_follows_the_page(figures):
    for svg in figures.values():
        root = ElementTree.fromstring(svg)
        assert root.tag.endswith("svg")
        assert "var(--ink" in svg
        for colour in VARIABLES:
            assert not re.search(rf"(?<!, ){colour}", svg)


def test_ids_are_unique_on_a_page(figures):
    ids = [
        name for svg in figures.values() for name in re.findall(r'\bid="(.*?)"', svg)
    ]
    assert len(ids) == len(set(ids))
    for svg in figures.values():
        for used in re.findall(r"url\(#(.*?)\)", svg):
            assert f'id="{used}"' in svg


def test_the_same_run_gives_the_same_figure(run, figures):
    again = plots.to_svg(plots.energy_ledger(run.history), "energy")
    assert again == figures["energy"]


def test_hostile_names_are_only_text():
    name = "<script>$\\frac{"
    columns = {"time [s]": np.arange(3.0), f"{name}.displacement [m]": np.zeros(3)}
    columns |= {f"{name}.force_{axis} [N]": np.ones(3) for axis in "xyz"}
    svg = plots.to_svg(plots.wall_forces(HistoryTable(columns, ("a",) * 3)), "x")
    assert "<script" not in svg
    assert "&lt;script" in svg


def test_no_wall_felt_anything():
    columns = {"time [s]": np.arange(3.0), "x.displacement [m]": np.zeros(3)}
    columns |= {f"x.force_{axis} [N]": np.zeros(3) for axis in "xyz"}
    assert plots.wall_forces(HistoryTable(columns, ("a",) * 3)) is None


def test_pictures_share_scale_and_show_the_powder(run):
    from matplotlib.image import imread

    frames = {key: run.results[n] for key, n in key_frames(run).items()}
    view = common_view(list(frames.values()), pixels=90)
    kept = kept_wall_facets(frames["pressed"], frames["ejected"], np.eye(3))
    assert len(kept.particle)
    shots = {
        "outside": picture(frames["pressed"], view),
        "inside": picture(frames["pressed"], view, values=np.arange(60.0), cut=True),
        "tablet": picture(frames["ejected"], view, kept=kept),
    }
    covered = {}
    for name, shot in shots.items():
        pixels = imread(io.BytesIO(shot.png))
        assert pixels.shape == (shot.height, shot.width, 4)
        covered[name] = float(pixels[..., 3].mean())
    assert 0.15 < covered["inside"] < covered["outside"] < 0.9
    x, y = shots["outside"].place(np.array([0.0, 0.0, 0.0]))
    assert abs(x - shots["outside"].width / 2) < 6
    assert 0 < y < shots["outside"].height
