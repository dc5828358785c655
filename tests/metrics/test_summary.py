"""All numbers of a run whose constants are known."""

import json
import math

import numpy as np
import pytest

import synthetic
from pestle.metrics import summarise, write_metrics
from pestle.metrics.tablet_metrics import key_frames
from pestle.results import RunFolder
from synthetic import write_run


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = write_run(tmp_path_factory.mktemp("run"), count=60, rounds=24)
    with RunFolder(folder) as opened:
        yield opened


@pytest.fixture(scope="module")
def summary(run):
    return summarise(run)


@pytest.mark.parametrize(
    ("key", "expected", "rel"),
    [
        ("peak_axial_stress", synthetic.PEAK, 1e-9),
        ("axial_transmission", 0.8, 1e-9),
        ("radial_transmission", synthetic.RADIAL_RATIO, 1e-9),
        ("heckel_yield_pressure", synthetic.YIELD_PRESSURE, 1e-6),
        ("residual_die_wall_stress", synthetic.RESIDUAL, 0.2),
        ("axial_spring_back", synthetic.AXIAL_SPRING_BACK, 1e-9),
        ("radial_spring_back", synthetic.RADIAL_SPRING_BACK, 1e-9),
        ("particles", 60, 0),
        ("tablet_share", 1.0, 0),
        ("ledger_residual", 9.4e-4, 0.02),
    ],
)
def test_known_constants_come_back(summary, key, expected, rel):
    assert summary.value(key) == pytest.approx(expected, rel=rel)


def test_ejection_stress_and_strength_use_the_tablet_size(summary, run):
    curves = summary.curves
    height = curves.height[curves.release]
    wall = 2 * math.pi * synthetic.DIE_RADIUS * height
    force = synthetic.EJECTION_FORCE * 0.9
    assert summary.value("ejection_stress") * wall == pytest.approx(force, rel=0.02)
    size = summary.value("tablet_diameter") * summary.value("tablet_thickness")
    force = summary.value("tensile_strength") * math.pi * size / 2
    assert force == pytest.approx(synthetic.CRUSH_FORCE, rel=0.03)
    assert run.results is not None


def test_density_out_of_die_is_lower_by_the_spring_back(summary):
    growth = (1 + synthetic.AXIAL_SPRING_BACK) * (1 + synthetic.RADIAL_SPRING_BACK) ** 2
    expected = summary.value("peak_relative_density") / growth
    assert summary.value("tablet_relative_density") == pytest.approx(expected, rel=1e-6)


def test_key_frames_follow_the_process(run):
    frames = key_frames(run)
    order = ("filled", "pressed", "released", "ejected", "crushed")
    assert list(dict(sorted(frames.items(), key=lambda item: item[1]))) == list(order)


def test_metrics_file_is_plain_json(summary, tmp_path):
    write_metrics(tmp_path, summary)
    found = json.loads((tmp_path / "metrics.json").read_text())
    entry = found["metrics"]["peak_axial_stress"]
    assert entry["value"] == pytest.approx(synthetic.PEAK)
    assert entry["unit"] == "Pa"
    assert entry["definition"]
    assert found["warnings"] == []


def test_an_unfinished_run_has_fewer_numbers(tmp_path):
    folder = write_run(tmp_path / "run", count=30, rounds=6, stop_after="press")
    with RunFolder(folder) as run:
        found = summarise(run)
    assert found.value("peak_axial_stress") == pytest.approx(synthetic.PEAK)
    assert not found.curves.is_released
    for key in ("residual_die_wall_stress", "ejection_stress", "axial_spring_back"):
        assert found.value(key) is None


def test_a_bad_ledger_is_a_warning(tmp_path):
    folder = write_run(tmp_path / "run", count=30, rounds=6)
    lines = (folder / "history.csv").read_text().splitlines()
    place = lines[0].split(",").index("energy.residual [J]")
    row = lines[-1].split(",")
    row[place] = "0.01"
    (folder / "history.csv").write_text("\n".join([*lines[:-1], ",".join(row), ""]))
    with RunFolder(folder) as run:
        found = summarise(run)
    assert any("ledger" in text for text in found.warnings)
    assert np.isfinite(found.value("ledger_residual"))
