"""Shahin (2021), chapter 3: limit of chapter 2, borders, readings."""

from math import pi

import numpy as np
import pytest

from pestle.errors import InputError
from pestle.particle import Biwa1995, RangeWarning, Shahin2021Hardening, biwa1995
from pestle.particle import shahin2021_hardening as law
from pestle.particle import shahin2021_hardness as chapter2
from pestle.particle.configuration import CONFIGURATIONS, cell
from pestle.particle.hardening import (
    Ludwik,
    hollomon_from_ludwik,
    ludwik_from_hollomon,
    strains,
)
from pestle.particle.shahin2021_radius import relative_radius

EXPONENTS = (0.0, 0.1, 0.3268, 0.6585, 1.0)


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
class TestRigidPlasticLimit:
    def test_chapter_2_tends_to_chapter_3_without_hardening(self, configuration):
        k = law.parameters(0.0, configuration)
        end = min(k.zero_porosity, 0.6)
        x = np.linspace(0.01, 0.999, 200) * end
        limit = chapter2.parameters(1e60, 1e60, configuration)
        want = chapter2.hardness(x, limit)
        got = law.hardness(x, k)
        np.testing.assert_array_equal(got.regime, want.regime)
        np.testing.assert_allclose(got.value, want.value, rtol=1e-11)
        np.testing.assert_allclose(got.slope, want.slope, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(
            relative_radius(x, k.radius), relative_radius(x, limit.radius), rtol=1e-13
        )

    def test_it_is_approached_like_one_over_lambda_powers(self, configuration):
        x = 0.13
        want = law.hardness(x, law.parameters(0.0, configuration)).value
        gaps = [
            abs(
                chapter2.hardness(x, chapter2.parameters(lam, lam, configuration)).value
                - want
            )
            for lam in (1e4, 1e6, 1e8, 1e12)
        ]
        assert np.all(np.diff(gaps) < 0.0)

    def test_printed_limit_formulas(self, configuration):
        """(3.24)-(3.30), (3.40) as printed, with the one cosine corrected."""
        k = law.parameters(0.0, configuration)
        q, top, low = 14.1819, 3.101, float(k.rigid.lowest)
        s = low - np.arctan(2.0 * q / np.sinh(2.0 * q * low))
        bottom = k.hardness_min
        p = (top - bottom) / (np.tanh(q * low) * np.cos(low - s))
        x = np.linspace(1e-3, low, 50)
        want = top - p * np.tanh(q * x) * np.cos(x - s)
        np.testing.assert_allclose(law.hardness(x, k).value, want, rtol=1e-12)
        if configuration == "simple":
            assert p == pytest.approx(top - 1.0, abs=1e-11)  # (3.30)
            return
        chi, chi_min = (cell(z, configuration) for z in (0.5 * low + 0.09, low))
        x = 0.5 * low + 0.09
        if x > low:
            w = (chi - chi_min) / (1.0 - chi_min)
            want = bottom + (1.0 - chi_min) / 0.467 * np.log(1.0 - w**2)
            assert law.hardness(x, k).value == pytest.approx(want, rel=1e-12)


@pytest.mark.parametrize("configuration", ["die", "hydrostatic"])
@pytest.mark.parametrize("h", EXPONENTS)
class TestBorders:
    def test_c0_and_c1_at_the_minimum(self, configuration, h):
        k = law.parameters(h, configuration)
        x, step = float(k.rigid.lowest), 1e-7
        left, right = (law.hardness(x + s, k) for s in (-step, step))
        assert right.value == pytest.approx(left.value, rel=1e-5)
        slopes = left.slope, right.slope
        assert slopes[1] == pytest.approx(slopes[0], abs=1e-4 * left.value / x)

    def test_the_printed_reading_jumps(self, configuration, h):
        if h == 0.0:
            pytest.skip("all readings are one without hardening")
        k = law.parameters(h, configuration, reading="literal")
        x = float(k.rigid.lowest)
        left, right = (law.hardness(x + s, k).value for s in (-1e-9, 1e-9))
        jump = 3.101 * (1.0 - np.exp(-1.748 * h)) * x ** (0.5 * h)
        assert right - left == pytest.approx(jump, rel=1e-6)

    def test_low_compressibility_is_the_limit_of_its_own_parameter_l(
        self, configuration, h
    ):
        """(3.58) follows from (2.45), (2.46) with l of (3.57), zeta to infinity."""
        k = law.parameters(h, configuration)
        zeta = 1e14
        rest = 1.0 / (1.0 + 0.2335 * np.exp(-0.5883 * h) * zeta)
        part, log = 1.0 - rest, np.log(rest)
        loss = (2.0 * part * k.hardness_min + zeta * (1.0 - k.chi_min) * rest * log) / (
            zeta * (2.0 * part + rest * log)
        )
        u = (k.hardness_min - zeta * loss) / log
        assert u == pytest.approx(k.u, rel=0.1)  # as slow as 1/ln(zeta)


class TestReadings:
    @pytest.mark.parametrize("configuration", CONFIGURATIONS)
    def test_all_agree_without_hardening(self, configuration):
        x = np.linspace(0.01, 0.19, 20)
        want = law.hardness(x, law.parameters(0.0, configuration)).value
        for reading in ("literal", "frozen_min", "scaled"):
            k = law.parameters(0.0, configuration, reading=reading)
            np.testing.assert_allclose(law.hardness(x, k).value, want, rtol=1e-13)

    def test_printed_becomes_negative(self):
        k = law.parameters(1.0, "simple", reading="literal")
        assert law.hardness(0.1, k).value < 0.0
        assert law.hardness(0.1, law.parameters(1.0, "simple")).value > 0.0

    @pytest.mark.parametrize(
        ("configuration", "k"),
        [("simple", 1.0), ("die", 0.670144), ("hydrostatic", 0.551554)],
    )
    def test_depth_of_the_minimum_does_not_depend_on_hardening(self, configuration, k):
        for h in EXPONENTS:
            got = law.parameters(h, configuration)
            assert got.k == pytest.approx(k, abs=1e-6)
            top = got.hardness_max
            assert got.hardness_min == pytest.approx(top - k * (top - 1.0), abs=3e-6)

    def test_sign_of_3_59(self):
        plus, minus = (law.parameters(0.5, "die", lc_sign=s) for s in (1, -1))
        assert minus.u / plus.u == pytest.approx(np.exp(0.5883), rel=1e-12)

    def test_unknown_reading(self):
        with pytest.raises(InputError, match='did you mean "consistent"'):
            law.parameters(0.5, "die", reading="consistant")


class TestAgainstTheSimilarityLaw:
    @pytest.mark.parametrize("h", EXPONENTS)
    def test_small_deformation_tends_to_it(self, h):
        x = 1e-9
        ours = law.hardness(x, law.parameters(h, "simple")).value
        assert -0.084 < ours / biwa1995.hardness(x, h) - 1.0 < 0.038

    def test_series_of_the_radius_follows_the_closed_form(self):
        pair = biwa1995.two(1.0, 1.7)
        for gamma, tolerance in ((1e-3, 1e-8), (1e-2, 1e-5)):
            at = gamma, pair, 0.3
            closed = biwa1995.contact_radius_closed(*at)
            assert biwa1995.contact_radius_series(*at) == pytest.approx(
                closed, rel=tolerance
            )

    def test_closed_radius_solves_its_equation(self):
        pair, h, gamma = biwa1995.two(0.6, 2.5), 0.77, 0.11
        a = biwa1995.contact_radius_closed(gamma, pair, h)
        right = (a**2 * pair.a / 2.0 + a**4 * pair.b / 8.0) / biwa1995.area_ratio(h)
        assert right == pytest.approx(gamma, rel=1e-14)

    def test_particle_on_a_flat_is_half_of_two_equal_spheres(self):
        radius, h, kappa = 3e-5, 0.4, 7e6
        flat = Biwa1995(strength=kappa, hardening_exponent=h)
        curve = flat.curve(0.02 * radius, radius=radius)
        pair = biwa1995.two(radius, radius)
        a = biwa1995.contact_radius(2.0 * 0.02 * radius, pair, h)
        eta = biwa1995.force_factor(h, kappa, kappa, pair.a)
        assert curve.contact_radius == pytest.approx(a, rel=1e-14)
        assert curve.force == pytest.approx(eta * a ** (2.0 + h), rel=1e-13)
        mean = curve.force / (pi * curve.contact_radius**2)
        assert mean == pytest.approx(kappa * biwa1995.hardness(0.02, h), rel=1e-13)

    def test_joint_strength_has_no_overflow(self):
        assert biwa1995.joint_strength(3e7, 2e7, 1e-4) == pytest.approx(2e7)
        assert biwa1995.joint_strength(2e7, 2e7, 0.5) == pytest.approx(
            2e7 / 2.0**0.5, rel=1e-14
        )


class TestLaw:
    def test_infinite_force_is_refused(self):
        die = Shahin2021Hardening(strength=6e6, hardening_exponent=0.66)
        with pytest.raises(InputError, match="fills its cell"):
            die.curve(4.8e-5, radius=1e-4, configuration="die")

    def test_large_simple_compression_warns(self):
        one = Shahin2021Hardening(strength=6e6, hardening_exponent=0.66)
        with pytest.warns(RangeWarning, match=r"0 to 0\.5"):
            one.curve(6e-5, radius=1e-4)

    def test_force_rises_with_strength_alone_in_proportion(self):
        one, two = (
            Shahin2021Hardening(strength=k, hardening_exponent=0.5) for k in (1.0, 2.0)
        )
        d = np.linspace(0.0, 0.45, 9)
        np.testing.assert_allclose(
            two.curve(d, radius=1.0).force, 2.0 * one.curve(d, radius=1.0).force
        )


class TestLudwik:
    def test_back_and_forth_on_a_power_law(self):
        """Without yield stress and with a rigid solid the two laws are one."""
        given = Ludwik(1e-9, 50.0, 0.4, 1e15)
        fit = hollomon_from_ludwik(given, strains())
        assert fit == pytest.approx((50.0, 0.4), rel=1e-8)
        back = ludwik_from_hollomon(
            fit, strains(), yield_stress=1e-9, youngs_modulus=1e15
        )
        assert back == pytest.approx(given, rel=1e-7)
