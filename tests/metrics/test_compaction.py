"""Stresses and fits against their definitions."""

import math

import numpy as np
import pytest

from pestle.metrics.compaction import (
    axial_stress,
    die_wall_stress,
    ejection_stress,
    heckel,
    kawakita,
    work_of,
)
from pestle.metrics.strength import diametral_tensile_strength


def test_stress_is_force_over_area():
    assert axial_stress(np.array([math.pi]), 1e-3)[0] == pytest.approx(1e6)
    wall = die_wall_stress(np.array([math.pi]), 1e-3, np.array([2e-3]))
    assert wall[0] == pytest.approx(0.25e6)
    assert np.isnan(die_wall_stress(np.array([1.0]), 1e-3, np.array([0.0])))[0]
    assert ejection_stress(math.pi, 1e-3, 2e-3) == pytest.approx(0.25e6)


def test_tensile_strength():
    expected = 2 * 50.0 / (math.pi * 8e-3 * 4e-3)
    assert diametral_tensile_strength(50.0, 8e-3, 4e-3) == pytest.approx(expected)


def test_work_of_a_linear_punch():
    moved = np.linspace(0.0, 1e-3, 11)
    assert work_of(2e5 * moved, moved) == pytest.approx(0.1)


def test_heckel_fits_its_range_only():
    pressure = np.linspace(0.0, 200e6, 400)
    exponent = np.where(pressure < 50e6, pressure / 40e6, 0.65 + pressure / 83e6)
    line = heckel(pressure, 1.0 - np.exp(-exponent))
    assert (line.low, line.high) == (60e6, 180e6)
    assert line.yield_pressure == pytest.approx(83e6, rel=1e-9)
    assert line.intercept == pytest.approx(0.65, rel=1e-9)
    assert line.r_squared == pytest.approx(1.0)
    low = heckel(pressure, 1.0 - np.exp(-exponent), low=1e6, high=45e6)
    assert low.yield_pressure == pytest.approx(40e6, rel=1e-9)


def test_heckel_leaves_out_densities_above_one():
    pressure = np.linspace(1e6, 100e6, 100)
    density = 0.5 + 0.6 * pressure / 100e6
    line = heckel(pressure, density)
    assert line.points == np.sum((pressure >= 30e6) & (density < 1.0))


def test_fits_of_nothing_are_none():
    few = np.array([1e6, 2e6])
    assert heckel(few, np.array([0.5, 0.6])) is None
    assert heckel(np.zeros(0), np.zeros(0)) is None
    falling = np.linspace(1e6, 1e8, 50)
    assert heckel(falling, np.linspace(0.9, 0.5, 50)) is None
    assert kawakita(few, np.array([0.5, 0.6]), 0.4) is None


def test_kawakita_recovers_its_constants():
    pressure = np.linspace(1e5, 150e6, 500)
    a, b = 0.62, 1.0 / 7e6
    reduction = a * b * pressure / (1.0 + b * pressure)
    fit = kawakita(pressure, 0.38 / (1.0 - reduction), 0.38)
    assert fit.a == pytest.approx(a, rel=1e-9)
    assert fit.b == pytest.approx(b, rel=1e-9)
    assert (fit.low, fit.high) == pytest.approx((7.5e6, 150e6))
