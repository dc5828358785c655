"""Calibrations against data whose truth is known, often enough to count; minutes."""

from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binom

from pestle import simulation
from pestle.calibrate import calibrate, single
from pestle.config import Case
from pestle.config.calibration import CalibrationSettings
from pestle.config.study import read_settings
from pestle.metrics.die_curves import die_curves
from pestle.particle import build
from pestle.results.folder import RunFolder

EXAMPLES = Path(__file__).parents[2] / "examples"
CASE = EXAMPLES / "small_tablet.toml"
RADIUS = 50e-6
TRIALS = 300

PARTICLE = """
source = "synthetic"
seed = {seed}
[particle]
file = "particle.csv"
law = "{law}"
diameter = "100 um"
fixed = {{ poisson_ratio = 0.3 }}
[parameters]
yield_stress = {{ low = "5 MPa", high = "100 MPa", scale = "log" }}
youngs_modulus = {{ low = "1 GPa", high = "50 GPa", scale = "log" }}
"""

BULK = """
source = "synthetic"
[bulk]
case = "{case}"
set = {{ particles.count = 500, die.height = "10 mm", process.1.to = "260 MPa" }}
most = 60
{targets}
[parameters]
"materials.powder.yield_stress" = {{ low = "70 MPa", high = "200 MPa", scale = "log" }}
"contacts.pairs.0.sliding_friction" = {{ low = 0.05, high = 0.5 }}
"""
TARGET = """[[bulk.targets]]
curve = "{curve}"
file = "tablet.csv"
points = {points}
deviation = "{deviation} MPa"
"""
AXIAL = TARGET.format(curve="axial_stress", points=4, deviation=3)
DIE_WALL = TARGET.format(curve="die_wall_stress", points=4, deviation=1.5)
ALL = "".join(
    TARGET.format(curve=curve, points=8, deviation=1.5)
    for curve in ("axial_stress", "transmitted_stress", "die_wall_stress")
)
TRUTH = np.array([130e6, 0.3])


def write(path: Path, **columns: np.ndarray) -> None:
    """CSV of columns; a double underscore begins the unit."""
    names = (name.replace("__", " [") + "]" for name in columns)
    rows = np.column_stack(list(columns.values()))
    np.savetxt(path, rows, delimiter=",", header=",".join(names), comments="")


@pytest.mark.slow
def test_credible_intervals_hold_the_truth_as_often_as_they_say(tmp_path):
    """300 curves: loading and unloading of one particle with 1 % of noise."""
    law = "shahin2021+edmans2020"
    truth = {"yield_stress": 2e7, "youngs_modulus": 5e9}
    d = RADIUS * np.linspace(0.0, 0.3, 61)[1:]
    d = np.concatenate([d, d[-1] * np.linspace(1.0, 0.93, 21)[1:]])
    clean = build(law, {**truth, "poisson_ratio": 0.3}).follow(d, radius=RADIUS).force
    hits = np.zeros(2, dtype=int)
    for seed in range(TRIALS):
        noise = np.random.default_rng(seed).normal(size=len(d))
        force = clean + 0.01 * clean.max() * noise
        write(tmp_path / "particle.csv", displacement__m=2.0 * d, force__N=force)
        (tmp_path / "case.toml").write_text(PARTICLE.format(seed=seed, law=law))
        settings = read_settings(CalibrationSettings, tmp_path / "case.toml")
        _, found = single.calibrate(settings)
        low, high = found.interval().T
        true = np.array([truth[name] for name in found.names])
        hits += (low <= true) & (true <= high)
    low, high = binom.interval(0.99, TRIALS, 0.95)
    assert np.all((hits >= low) & (hits <= high)), f"{hits} of {TRIALS}"


@pytest.fixture(scope="module")
def tablets(tmp_path_factory):
    """Folder with the mean curves of six compactions of 500 particles."""
    return measured(tmp_path_factory.mktemp("tablets"), range(101, 107))


def measured(folder, seeds):
    """Write the mean curves of tablets of 500 particles, with noise."""
    tablets = [pressed(folder / str(seed), seed) for seed in seeds]
    x = np.linspace(0.66, min(density[-1] for density, *_ in tablets), 20)
    upper, lower, wall = (
        np.mean([np.interp(x, t[0], t[column]) for t in tablets], axis=0)
        for column in (1, 2, 3)
    )
    noise = np.random.default_rng(101).normal(0.0, 1.5e6, (3, len(x)))
    write(
        folder / "tablet.csv",
        **{"relative_density__-": x},
        axial_stress__Pa=upper + noise[0],
        transmitted_stress__Pa=lower + noise[1],
        die_wall_stress__Pa=wall + noise[2],
    )
    return folder


def pressed(folder, seed):
    """Density and stresses of both punches and the wall, with the true values."""
    changes = [
        "particles.count=500",
        "die.height=10 mm",
        f"seed={seed}",
        f"materials.powder.yield_stress={TRUTH[0]}",
        f"contacts.pairs.0.sliding_friction={TRUTH[1]}",
    ]
    simulation.run(Case.from_file(CASE, changes), folder)
    with RunFolder(folder) as run:
        curves = die_curves(run)
    rows = curves.loading
    density = np.maximum.accumulate(curves.density[rows])
    return density, curves.axial[rows], curves.transmitted[rows], curves.radial[rows]


def found_with(folder, targets):
    """What a calibration to some targets finds; both share their runs."""
    text = BULK.format(case=CASE, targets=targets)
    (folder / "calibration.toml").write_text(text)
    settings = read_settings(CalibrationSettings, folder / "calibration.toml")
    return calibrate(settings, folder / "found", say=print)


@pytest.fixture(scope="module")
def tablet(tmp_path_factory):
    """Folder with the measured curves of a compaction of 500 particles."""
    return measured(tmp_path_factory.mktemp("tablet"), [101])


@pytest.mark.slow
def test_yield_stress_and_friction_of_a_compaction(tablet):
    """Of 500 particles, from axial and die-wall stress, in at most 60 runs."""
    numbers = found_with(tablet, AXIAL + DIE_WALL)
    values = [row["value"] for row in numbers["parameters"].values()]
    np.testing.assert_allclose(values, TRUTH, rtol=0.1)
    assert numbers["runs"] <= 60
    assert not any("told apart" in text for text in numbers["warnings"])


@pytest.mark.slow
@pytest.mark.parametrize("seed", [101, 102, 103])
def test_yield_stress_and_friction_with_both_punches(tmp_path, seed):
    """Of 500 particles, from the stresses of both punches and of the wall."""
    numbers = found_with(measured(tmp_path, [seed]), ALL)
    values = [row["value"] for row in numbers["parameters"].values()]
    np.testing.assert_allclose(values, TRUTH, rtol=0.1)
    assert numbers["runs"] <= 60
    assert not any("told apart" in text for text in numbers["warnings"])


@pytest.mark.slow
def test_yield_stress_and_friction_of_six_compactions(tablets):
    """Of their mean, from the stresses of the upper punch and of the wall."""
    numbers = found_with(tablets, AXIAL + DIE_WALL)
    values = [row["value"] for row in numbers["parameters"].values()]
    np.testing.assert_allclose(values, TRUTH, rtol=0.1)
    assert numbers["runs"] <= 60


@pytest.mark.slow
def test_the_axial_stress_alone_cannot_tell_them_apart(tablet):
    numbers = found_with(tablet, AXIAL)
    assert any("cannot be told apart" in text for text in numbers["warnings"])
