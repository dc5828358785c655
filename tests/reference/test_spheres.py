"""Hertz and JKR: derivatives, energies and known limits."""

from math import pi, sqrt

import numpy as np
import pytest

from pestle.reference import elasticity, hertz, jkr

K = {"modulus": 22000.0, "work_of_adhesion": 1.0}


def slope(function, x, h=1e-6):
    """Central difference of fourth order."""
    d = h * x
    near = function(x + d) - function(x - d)
    far = function(x + 2 * d) - function(x - 2 * d)
    return (8 * near - far) / (12 * d)


def test_rigid_partner_leaves_plane_strain_modulus():
    own = elasticity.plane_strain_modulus(2.0, 0.25)
    assert elasticity.composite_modulus(own) == own
    assert elasticity.composite_modulus(own, 1e30) == pytest.approx(own, rel=1e-14)


def test_moduli_are_those_of_one_material():
    e, nu = 3.0, 0.2
    g, k = elasticity.shear_modulus(e, nu), elasticity.bulk_modulus(e, nu)
    assert 9 * k * g / (3 * k + g) == pytest.approx(e, rel=1e-14)


def test_hertz_stiffness_and_energy_belong_to_the_force():
    delta, r = 0.013, 0.7
    force = hertz.force(delta, r, modulus=5.0)
    measured = slope(lambda d: hertz.force(d, r, modulus=5.0), delta)
    assert hertz.stiffness(delta, r, modulus=5.0) == pytest.approx(measured, rel=1e-9)
    measured = slope(lambda d: hertz.stored_energy(d, r, modulus=5.0), delta)
    assert force == pytest.approx(measured, rel=1e-9)


def test_hertz_mean_pressure_is_force_over_area():
    a = hertz.contact_radius(0.02, 1.3)
    force = hertz.force(0.02, 1.3, modulus=5.0)
    mean = hertz.mean_pressure(0.02, 1.3, modulus=5.0)
    assert mean == pytest.approx(force / (pi * a * a), rel=1e-14)
    top = hertz.pressure(0.0, 0.02, 1.3, modulus=5.0)
    assert top == pytest.approx(1.5 * mean, rel=1e-14)


def test_hertz_is_nothing_without_overlap():
    assert hertz.force(-0.1, 1.0, modulus=1.0) == 0.0
    assert hertz.contact_radius(-0.1, 1.0) == 0.0
    assert hertz.stored_energy(-0.1, 1.0, modulus=1.0) == 0.0


def test_jkr_pull_off_is_the_least_force():
    a = np.linspace(0.02, 0.2, 20001)
    least = min(jkr.force(x, 1.0, **K) for x in a)
    assert least == pytest.approx(jkr.pull_off(1.0, work_of_adhesion=1.0), rel=1e-7)
    assert jkr.pull_off(1.0, work_of_adhesion=1.0) == pytest.approx(-1.5 * pi)


def test_jkr_displacement_limit_is_the_least_overlap():
    a_c = jkr.critical_radius(1.0, **K, control="displacement")
    assert abs(slope(lambda a: jkr.overlap(a, 1.0, **K), a_c)) < 1e-8
    force = jkr.pull_off(1.0, work_of_adhesion=1.0, control="displacement")
    assert jkr.force(a_c, 1.0, **K) == pytest.approx(force, rel=1e-13)


def test_jkr_self_contact_has_no_force():
    a = jkr.self_contact_radius(1.0, **K)
    assert abs(jkr.force(a, 1.0, **K)) < 1e-12


def test_jkr_scales_with_its_own_units():
    """F/(W R), delta/R and a/R depend on E* R/W alone."""
    big = {"modulus": 22000.0 / 2.5, "work_of_adhesion": 3.0}
    r = 7.5
    assert jkr.force(0.1 * r, r, **big) == pytest.approx(
        jkr.force(0.1, 1.0, **K) * 3.0 * r, rel=1e-13
    )
    assert jkr.overlap(0.1 * r, r, **big) == pytest.approx(
        jkr.overlap(0.1, 1.0, **K) * r, rel=1e-13
    )


def test_tabor_number_grows_with_softness():
    soft = jkr.tabor_number(
        1e-4, modulus=1e6, work_of_adhesion=0.1, range_of_force=3e-10
    )
    hard = jkr.tabor_number(
        1e-4, modulus=1e9, work_of_adhesion=0.1, range_of_force=3e-10
    )
    assert soft / hard == pytest.approx(100.0, rel=1e-9)
    assert sqrt(soft) > 1.0
