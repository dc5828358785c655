"""Yield, plastic contact, volumes and transforms of the MDR contact."""

from math import log, pi, sqrt

import numpy as np
import pytest
from scipy.integrate import quad

from pestle.errors import SimulationError
from pestle.reference import abel, elasticity, ellipse, hertz, mdr, volume
from pestle.reference.ellipse import Ellipse


def constants(ratio, nu=0.3):
    """Constants for E = 1, Y = 1/ratio."""
    return mdr.Constants(
        elasticity.plane_strain_modulus(1.0, nu),
        elasticity.shear_modulus(1.0, nu),
        elasticity.bulk_modulus(1.0, nu),
        nu,
        1.0 / ratio,
    )


def contact(ratio, largest, radius=1.0, nu=0.3):
    k = constants(ratio, nu)
    first = mdr.yield_overlap(radius, modulus=k.modulus, yield_stress=k.yield_stress)
    offset = mdr.area_offset(first, radius)
    plastic = mdr.plastic_contact(largest, radius, area_offset=offset, constants=k)
    return k, first, plastic


@pytest.mark.parametrize("ratio", [2.0, 6.25, 12.5, 25.0, 200.0, 1e4, 1e6])
def test_yield_is_where_the_pressures_meet(ratio):
    k = constants(ratio)
    y = mdr.yield_point(0.7, modulus=k.modulus, yield_stress=k.yield_stress)
    elastic = hertz.mean_pressure(y.overlap, 0.7, modulus=k.modulus)
    assert elastic == pytest.approx(y.pressure, rel=2e-15)


@pytest.mark.parametrize("ratio", [6.25, 25.0, 200.0])
def test_area_is_continuous_at_yield(ratio):
    _, first, _ = contact(ratio, 0.3)
    _, _, at_yield = contact(ratio, first)
    assert at_yield.radius == pytest.approx(hertz.contact_radius(first, 1.0), rel=1e-13)


@pytest.mark.parametrize("ratio", [6.25, 25.0, 200.0])
@pytest.mark.parametrize("largest", [0.3, 0.7])
def test_largest_penetration_is_half_the_height(ratio, largest):
    k, _, plastic = contact(ratio, largest, radius=1.2)
    depth = mdr.penetration(largest, largest, plastic)
    assert depth == 0.5 * plastic.shape.height
    force = ellipse.force(plastic.shape, depth, modulus=k.modulus)
    assert force == pytest.approx(plastic.largest_force, rel=1e-14)
    assert force == pytest.approx(plastic.pressure * pi * plastic.radius**2, rel=1e-14)


def test_contact_opens_at_the_plastic_overlap():
    _, _, plastic = contact(200.0, 0.3)
    assert mdr.penetration(plastic.plastic_overlap, 0.3, plastic) == pytest.approx(
        0.0, abs=1e-14
    )
    assert mdr.overlap(0.0, 0.3, plastic) == pytest.approx(
        plastic.plastic_overlap, rel=1e-14
    )


def test_elastic_recovery_is_smaller_than_in_the_half_space():
    """-A/2 < delta_R < 0: the particle's centre follows."""
    for ratio in (6.25, 12.5, 200.0):
        _, _, plastic = contact(ratio, 0.4)
        assert -0.5 * plastic.shape.height < plastic.correction < 0.0


def test_centre_displacement_is_boussinesq_under_uniform_pressure():
    z, a, nu, g = 0.8, 0.6, 0.3, 1.7

    def kernel(r):
        reach = sqrt(r * r + z * z)
        point = (2 * (1 - nu) / reach + z * z / reach**3) / (4 * pi * g)
        return 2 * pi * r * point

    under = quad(kernel, 0.0, a, epsabs=0.0, epsrel=1e-13)[0]
    found = mdr.centre_displacement(z, a, pressure=1.0, shear=g, poisson_ratio=nu)
    assert found == pytest.approx(-under, rel=1e-12)


def test_centre_at_the_surface_moves_by_half_the_height():
    k, nu = constants(20.0), 0.3
    height = 4.0 * 2.0 / k.modulus * 0.6
    found = mdr.centre_displacement(
        0.0, 0.6, pressure=2.0, shear=k.shear, poisson_ratio=nu
    )
    assert found == pytest.approx(-height / 2, rel=1e-14)


class TestVolume:
    """Volumes and the radius update."""

    def test_caps_fill_half_and_whole_sphere(self):
        assert volume.cap_volume(2.0, 1.0) == pytest.approx(volume.sphere_volume(1.0))
        assert volume.cap_volume(-0.1, 1.0) == 0.0

    def test_lost_volume_solves_its_equation(self):
        v_o, s = volume.sphere_volume(1.2), 0.05
        v = v_o - volume.lost_volume(s, 1.2, bulk=0.8)
        assert v == pytest.approx(v_o * (1 - s / (3 * 0.8 * v)), rel=1e-14)

    def test_too_large_a_virial_is_an_error(self):
        with pytest.raises(SimulationError, match="particle-crushed"):
            volume.lost_volume(100.0, 1.0, bulk=1.0)

    def test_radius_step_keeps_geometric_plus_lost_volume(self):
        """To second order in the step, which is what an explicit update promises."""
        r, r_o, d = 1.03, 1.0, 0.2
        defects = []
        for h in (1e-4, 5e-5):
            flats = [(d + h, h, 0.0)] * 2
            new = (
                r
                + volume.radius_step(
                    r,
                    volume.sphere_volume(r_o),
                    flats=flats,
                    initial_radius=r_o,
                    bulk=1.0,
                ).growth
            )
            before = volume.geometric_volume([d + r - r_o] * 2, r)
            after = volume.geometric_volume([d + h + new - r_o] * 2, new)
            defects.append(abs(after - before))
        assert log(defects[0] / defects[1], 2) == pytest.approx(2.0, abs=0.01)


class TestTransforms:
    """Section 3 both ways, on fields whose image is known."""

    def test_hertz_pressure_gives_the_parabola(self):
        r, delta, es = 1.3, 0.02, 4.0
        a = hertz.contact_radius(delta, r)
        for x in (0.0, 0.3 * a, 0.9 * a):
            load = abel.line_load(
                lambda s: hertz.pressure(s, delta, r, modulus=es), a, x
            )
            assert load == pytest.approx(es * (delta - x * x / r), rel=1e-11)

    def test_uniform_pressure_gives_the_ellipse(self):
        """Width B = 2a and height A = 4 p a/E*: which of them is the height."""
        p, a, es = 2.0, 0.6, 10.0
        shape = Ellipse(4 * p / es * a, 2 * a)
        for x in (0.0, 0.2, 0.55):
            depth = 0.5 * shape.height - ellipse.profile(shape, x)
            load = abel.line_load(lambda _: p, a, x)
            assert load / es == pytest.approx(depth, rel=1e-11)

    def test_pressure_inverts_line_load(self):
        r, delta, es = 1.3, 0.02, 4.0
        a = hertz.contact_radius(delta, r)
        for s in (0.0, 0.5 * a, 0.95 * a):
            back = abel.pressure(lambda x: -2 * es * x / r, a, s)
            direct = hertz.pressure(s, delta, r, modulus=es)
            assert back == pytest.approx(direct, rel=1e-10)

    def test_punch_edge_carries_the_pressure(self):
        found = abel.pressure(lambda _: 0.0, 1.0, 0.6, edge=2.0 * 0.1)
        assert found == pytest.approx(2.0 * 0.1 / (pi * sqrt(1 - 0.36)), rel=1e-13)

    def test_gap_and_profile_are_inverse(self):
        """g_1D = x^2/R belongs to g_3D = r^2/(2R)."""
        assert abel.gap(lambda x: x * x / 3, 0.7) == pytest.approx(0.49 / 6, rel=1e-12)
        assert abel.profile(lambda r: r / 3, 0.7) == pytest.approx(0.49 / 3, rel=1e-12)

    def test_punch_moves_the_surface_as_known(self):
        """(A.1), forward and back; the forward transform corrects (10a)."""
        delta, a = 0.3, 0.5
        for r in (0.2, 0.8, 2.0):
            known = delta if r < a else 2 / pi * delta * np.arcsin(a / r)
            assert abel.surface(lambda _: delta, a, r) == pytest.approx(
                known, rel=1e-12
            )

        def slope(r):
            return -2 / pi * delta * a / (r * sqrt(r * r - a * a)) if r > a else 0.0

        assert abel.spring(slope, delta, 0.4, breaks=(a,)) == pytest.approx(delta)
        outside = abel.spring(slope, delta, 0.9, breaks=(a,))
        assert outside == pytest.approx(0.0, abs=1e-7)
