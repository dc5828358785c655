"""Limits that laws share: Hertz, JKR, DMT, rigid-plastic; and printed curves."""

from math import pi

import numpy as np
import pytest

from pestle import testing
from pestle.laws import (
    DMT,
    EEPA2014,
    JKR,
    Hertz,
    Nan2022,
    Pair,
    Solid,
    Storakers1997,
    ThorntonNing1998,
)
from pestle.laws._base import Geometry, parts_of
from pestle.reference import jkr, jkr_contact
from pestle.reference import nan2022 as nan
from pestle.reference import thornton_ning1998 as tn

R = testing.RADIUS
ELASTIC = Solid(youngs_modulus=1e8, poisson_ratio=0.3, yield_stress=1e12)


def pair(solid=ELASTIC, adhesion=0.0):
    return Pair(first=solid, second=solid, work_of_adhesion=adhesion)


UP_DOWN = testing.legs([0.0, 4e-6, 0.0], 400)


@pytest.mark.parametrize(
    ("law", "rtol"),
    [
        (JKR(), 1e-12),
        (DMT(), 1e-12),
        (ThorntonNing1998(), 1e-12),
        (EEPA2014(plasticity_ratio=0.0), 1e-12),
        (Storakers1997(), 1e-12),
    ],
)
def test_without_adhesion_and_yield_it_is_hertz(law, rtol):
    want = testing.follow(Hertz(), UP_DOWN, pair=pair())
    got = testing.follow(law, UP_DOWN, pair=pair())
    for name in ("force", "stored", "stiffness"):
        scale = np.abs(want[name]).max()
        np.testing.assert_allclose(got[name], want[name], atol=rtol * scale)


def test_thornton_ning_without_yield_is_jkr():
    path = testing.legs([-1e-7, 3e-6, -1e-7], 400)
    one, two = (
        testing.follow(law, path, pair=pair(adhesion=0.05))
        for law in (ThorntonNing1998(), JKR())
    )
    for name in ("force", "stored", "radius"):
        np.testing.assert_allclose(one[name], two[name], rtol=1e-12)


def test_thornton_ning_says_where_adhesion_alone_yields():
    soft = Solid(youngs_modulus=1e8, poisson_ratio=0.3, yield_stress=1e5)
    law, touch = ThorntonNing1998(), Geometry(0.0, R, 2 * R, 2 * R, 1.0, 0.0)
    with pytest.warns(UserWarning, match="adhesion alone presses"):
        parts_of(law).reach(law.constants(pair(soft, adhesion=1.0)), touch)


def test_jkr_is_that_of_the_contact_radius():
    """The branch of `reference.jkr`, over the whole range of overlaps."""
    k = {"modulus": 5e7, "work_of_adhesion": 0.05}
    part = jkr.critical_radius(R, **k, control="displacement")
    for a in part * np.geomspace(1.001, 300.0, 200):
        x = jkr.overlap(a, R, **k)
        found = jkr_contact.contact_radius(x, k["modulus"], R, k["work_of_adhesion"])
        assert found == pytest.approx(a, rel=1e-11)


def test_jkr_parts_under_force_and_under_displacement():
    law, both = JKR(), pair(adhesion=0.05)
    length = jkr_contact.separation_length(both.modulus, R, 0.05)
    path = testing.legs([0.0, 1e-6, -1.01 * length], 20_000)
    force = testing.follow(law, path, pair=both)["force"]
    full = -jkr.pull_off(R, work_of_adhesion=0.05)
    assert force.min() == pytest.approx(-full, rel=1e-6)
    # the slope is infinite there: go to the very end
    path = [0.0, -length * (1 - 1e-9), -length * (1 + 1e-9)]
    force = testing.follow(law, path, pair=both)["force"]
    assert force[1] == pytest.approx(-5 / 9 * full, rel=1e-4)
    assert force[2] == 0.0


def test_jkr_parting_takes_the_published_work():
    law, both = JKR(), pair(adhesion=0.05)
    length = jkr_contact.separation_length(both.modulus, R, 0.05)
    path = np.linspace(0.0, -1.0001 * length, 200_001)
    force = testing.follow(law, path, pair=both)["force"]
    want = nan.jkr_work(both.modulus, R, 0.05, nan.WORK_EXACT)
    assert np.trapezoid(force, path) == pytest.approx(want, rel=1e-4)


def test_dmt_pulls_off_at_2_pi_w_r():
    law, both = DMT(), pair(adhesion=0.05)
    force = testing.follow(law, [1e-15], pair=both)["force"][0]
    assert force == pytest.approx(-2 * pi * 0.05 * R, rel=1e-6)


def test_storakers_is_rigid_plastic_when_stiff():
    """F = 3 Y pi a^2 with a^2 = 2.86 R* h, and what springs back is of order Y/E."""
    solid = Solid(youngs_modulus=1e13, poisson_ratio=0.3, yield_stress=1e6)
    path = testing.legs([0.0, 4e-6], 50)
    got = testing.follow(Storakers1997(), path, pair=pair(solid))
    area = pi * 2.86 * R * path[1:]
    np.testing.assert_allclose(got["force"][1:], 3e6 * area, rtol=1e-12)
    assert got["stored"][-1] < 1e-5 * np.trapezoid(got["force"], path)


def test_storakers_shares_hardening_between_equal_bodies():
    """Two equal spheres are each a sphere on a rigid plane at half the overlap."""
    law = Storakers1997(hardening_exponent=0.5)
    solid = Solid(youngs_modulus=1e12, poisson_ratio=0.3, yield_stress=1e6)
    two = testing.follow(law, [2e-6], pair=pair(solid), radius=R)
    wall = Pair(first=solid, second=Solid(), wall=True)
    one = testing.follow(law, [1e-6], pair=wall, radius=2 * R)
    assert two["force"][0] == pytest.approx(one["force"][0], rel=1e-12)


def test_nan_keeps_the_jkr_work_and_force_below_yield():
    law, both = Nan2022(), pair(adhesion=0.05)
    reach = testing.parts_of(law).reach(law.constants(both), testing.geometry(0.0))
    path = np.linspace(0.0, -1.001 * reach, 100_001)
    force = testing.follow(law, path, pair=both)["force"]
    want = nan.jkr_work(both.modulus, R, 0.05)
    assert np.trapezoid(force, path) == pytest.approx(want, rel=1e-4)
    assert force.min() == pytest.approx(-1.5 * pi * 0.05 * R, rel=1e-4)


def test_nan_without_adhesion_never_pulls():
    both = Pair(first=testing.SOLID, second=testing.SOLID)
    path = testing.legs([-1e-7, 3e-6, -1e-7, 4e-6, 0.0])
    assert testing.follow(Nan2022(), path, pair=both)["force"].min() == 0.0


def test_nan_says_where_it_has_no_answer():
    """At a cohesion-yield number below 0.00115."""
    both = Pair(first=testing.SOLID, second=testing.SOLID, work_of_adhesion=300.0)
    law = Nan2022()
    with pytest.warns(UserWarning, match=r"below 0\.00115"):
        testing.parts_of(law).reach(law.constants(both), testing.geometry(0.0))


# Ning (1995) as digitised by Nan et al., Table 2: ammonium fluorescein at 10, 5, 2 m/s
NING = {
    10.0: (42.4e-6, 210.5e-9, 177.3e-9, 8.4e-6),
    5.0: (20.9e-6, 112.6e-9, 91.1e-9, 6.1e-6),
    2.0: (8.3e-6, 53.9e-9, 41.3e-9, 4.6e-6),
}


@pytest.mark.parametrize("speed", NING)
def test_thornton_ning_against_nings_printed_curves(speed):
    """Within 4 % of force and overlap; the pull-off force is 9 to 14 % low."""
    force, overlap, rest, pull = NING[speed]
    modulus, radius, density = 1.2e9 / (1 - 0.09), 2.45e-6, 1350.0
    s = tn.sphere(modulus, radius, 0.2, 35.3e6, "tangent")
    mass = 4 / 3 * pi * radius**3 * density
    _, peak = tn.impact(s, mass, speed)
    assert peak.force == pytest.approx(force, rel=0.04)
    assert peak.overlap == pytest.approx(overlap, rel=0.04)
    assert peak.rest == pytest.approx(rest, rel=0.06)
    assert 0.86 < peak.pull_off / pull < 0.92


def test_thornton_ning_law_is_the_impact_s():
    """The law of the engine passes through the turning point of the closed impact."""
    solid = testing.SOLID
    both = Pair(first=solid, second=solid, work_of_adhesion=0.02)
    law = ThorntonNing1998()
    k = law.constants(both)
    s = tn.sphere(both.modulus, R, 0.02, k.pressure, "tangent")
    a = 3.0 * s.yields
    peak = tn.peak(s, a)
    path = testing.legs([0.0, peak.overlap, peak.rest], 3000)
    got = testing.follow(law, path, pair=both)
    top = int(np.argmax(path))
    assert got["force"][top] == pytest.approx(peak.force, rel=1e-9)
    assert got["radius"][top] == pytest.approx(a, rel=1e-9)
    assert abs(got["force"][-1]) < 1e-9 * peak.force
    work = np.trapezoid(got["force"][: top + 1], path[: top + 1])
    assert work == pytest.approx(tn.loading_work(s, a), rel=1e-4)
