"""Unloading laws by themselves: closed forms, limits, a brute-force twin."""

import numpy as np
import pytest

from pestle.particle import (
    Edmans2020,
    Peak,
    RangeWarning,
    cylinders2020,
    edmans2020,
    etsion2005,
    linear_unloading,
    mesarovic2000,
)

RATIOS = (20.0, 100.0, 1000.0)


class TestEdmans:
    @pytest.mark.parametrize("nu", [0.0, 0.15, 0.3, 0.45])
    @pytest.mark.parametrize("e", RATIOS)
    def test_everything_comes_back_up_to_first_yield(self, e, nu):
        d_c = edmans2020.first_yield(e, nu)
        for largest in (0.1 * d_c, 0.99 * d_c, d_c):
            rho = edmans2020.secant_stiffness(largest, e, nu)
            assert rho == pytest.approx(1.0 / largest, rel=1e-12)
            assert edmans2020.exponent(largest, e, nu) == 1.5

    def test_stiffness_is_continuous_at_first_yield_with_a_kink(self):
        e, nu = 100.0, 0.3
        d_c = edmans2020.first_yield(e, nu)
        h = 1e-6 * d_c
        low, mid, high = (
            edmans2020.secant_stiffness(d_c + s, e, nu) for s in (-h, 0.0, h)
        )
        assert high == pytest.approx(mid, rel=1e-4)
        g1, g2, g3, g4, g5 = edmans2020.GAMMAS
        jump = g5 * e * (g1 * d_c + g2 * d_c**-g3 + g4 * nu) / d_c
        assert ((high - mid) - (mid - low)) / h == pytest.approx(jump, rel=1e-3)

    @pytest.mark.parametrize(("nu", "percent"), [(0.0, 6.1), (0.15, 3.0), (0.3, 0.6)])
    def test_first_yield_is_near_that_of_etsion(self, nu, percent):
        other = (np.pi * (1.234 + 1.256 * nu) * (1.0 - nu**2) / (2.0 * 50.0)) ** 2
        ratio = edmans2020.first_yield(50.0, nu) / other
        assert 100.0 * (ratio - 1.0) == pytest.approx(percent, abs=0.06)

    def test_work_is_the_area_below_the_curve(self):
        largest, law = 0.2, edmans2020.Unloading(60.0, 1.23)
        d = np.linspace(largest - 1.0 / law.rho, largest, 40_001)
        force = edmans2020.force(d, largest, 0.7, law)
        area = np.trapezoid(force, d)
        assert area == pytest.approx(edmans2020.work(0.7, law), rel=1e-8)
        slope = edmans2020.stiffness(d, largest, 0.7, law)
        chord, mean = np.diff(force) / np.diff(d), 0.5 * (slope[1:] + slope[:-1])
        np.testing.assert_allclose(chord[100:], mean[100:], rtol=1e-3)

    def test_range(self):
        soft = Edmans2020(youngs_modulus=5e9, poisson_ratio=0.3, yield_stress=1e6)
        peak = Peak(*np.array([[0.2], [1.0], [0.5]]), 1.0)
        with pytest.warns(RangeWarning, match=r"E/sigma_y = 5000 is outside 1 to 1000"):
            soft.curve(np.array([0.1]), peak)


class TestEtsion:
    def test_continuous_at_first_yield(self):
        for largest in (0.5, 1.0, 1.0 + 1e-9):
            got = etsion2005.secant_stiffness(largest * 1e-3, 1e-3)
            assert got == pytest.approx(1.0 / (largest * 1e-3), rel=1e-9)

    def test_less_comes_back_the_deeper(self):
        d = np.geomspace(1.0, 170.0, 50) * 1e-4
        part = 1.0 / (etsion2005.secant_stiffness(d, 1e-4) * d)
        assert np.all(np.diff(part) < 0.0)


class TestLinear:
    def test_luding_is_continuous_and_capped(self):
        d = np.array([0.0, 0.1, 0.2, 0.2 + 1e-12, 0.9])
        k2 = linear_unloading.luding_stiffness(2.0, 10.0, d, 0.2)
        np.testing.assert_allclose(k2, [2.0, 6.0, 10.0, 10.0, 10.0])

    def test_walton(self):
        assert linear_unloading.walton_stiffness(2.0, 0.5, 6.0) == 5.0


class TestMesarovic:
    def test_each_ring_is_a_flat_punch(self):
        """dF/d(delta) = 2 E* a all along."""
        modulus, radius, force = 3.0, 0.2, 0.7
        back = mesarovic2000.recovered(force, radius, modulus)
        left = np.linspace(0.01, 0.99, 200)
        h = 1e-6
        ratios = [
            mesarovic2000.force_ratio(mesarovic2000.radius_ratio(left + s))
            for s in (-h, h)
        ]
        slope = force * (ratios[1] - ratios[0]) / (2.0 * h * back)
        a = radius * mesarovic2000.radius_ratio(left)
        np.testing.assert_allclose(slope, 2.0 * modulus * a, rtol=1e-6)


def brute_force(d, largest, e, *, tension, number=200_000):
    """Sum of elastic-perfectly plastic bars, each with its own memory."""
    r = (np.arange(number) + 0.5) / number
    top, height = (1.0 - np.sqrt(1.0 - r**2)), np.sqrt(1.0 - r**2)
    strain_max = np.maximum(largest - top, 0.0) / height
    plastic = np.maximum(strain_max - 1.0 / e, 0.0)
    stress = e * ((d - top) / height - plastic)
    if tension:
        stress = np.where(plastic > 0.0, stress, np.maximum(stress, 0.0))
    else:
        stress = np.maximum(stress, 0.0)
    return np.sum(2.0 * r * np.where(strain_max > 0.0, stress, 0.0)) / number


class TestCylinders:
    @pytest.mark.parametrize("e", [5.0, 20.0, 200.0])
    @pytest.mark.parametrize("d", [0.002, 0.04, 0.3, 0.45])
    def test_loading_is_the_sum_of_the_bars(self, e, d):
        want = brute_force(d, d, e, tension=False)
        assert cylinders2020.loading_force(d, e) == pytest.approx(want, rel=2e-4)

    @pytest.mark.parametrize("e", [5.0, 20.0, 200.0])
    @pytest.mark.parametrize("largest", [0.1, 0.3, 0.45])
    def test_no_tension_is_the_sum_of_bars_that_only_push(self, e, largest):
        for part in np.linspace(0.02, 0.98, 9):
            d = largest - part * min(1.0 / e, largest)
            got = cylinders2020.unloading_force(d, largest, e, "no_tension")
            want = brute_force(d, largest, e, tension=False)
            assert got == pytest.approx(want, abs=2e-4)

    @pytest.mark.parametrize("e", [20.0, 200.0])
    def test_consistent_is_the_sum_of_bars_with_a_glued_core(self, e):
        largest = 0.3
        for part in np.linspace(0.02, 0.9, 9):
            d = largest - part / cylinders2020.secant_stiffness(largest, e)
            got = cylinders2020.unloading_force(d, largest, e)
            if d > cylinders2020.annulus_leaves(largest, e):
                want = brute_force(d, largest, e, tension=True)
                assert got == pytest.approx(want, abs=2e-4)

    @pytest.mark.parametrize("variant", ["consistent", "published", "no_tension"])
    @pytest.mark.parametrize("e", RATIOS)
    def test_all_variants_meet_at_first_yield(self, e, variant):
        at = 1.0 / e
        for largest in (0.5 * at, at, at * (1.0 + 1e-12)):
            rho = cylinders2020.secant_stiffness(largest, e, variant)
            assert rho == pytest.approx(1.0 / largest, rel=1e-5)

    @pytest.mark.parametrize(
        ("e", "largest", "published", "consistent", "eq3"),
        [
            (100.0, 0.1, 23.45, 104.7, 83.4),
            (100.0, 0.3, 14.07, 117.1, 121.9),
            (1000.0, 0.5, 36.5, 1332.8, 1744.0),
        ],
    )
    def test_consistent_comes_near_the_fit_and_published_does_not(
        self, e, largest, published, consistent, eq3
    ):
        for variant, want in (("published", published), ("consistent", consistent)):
            rho = cylinders2020.secant_stiffness(largest, e, variant)
            assert rho == pytest.approx(want, rel=2e-3)
        fit = edmans2020.secant_stiffness(largest, e, 0.3)
        assert fit == pytest.approx(eq3, rel=1e-3)

    def test_printed_unloading_does_not_retrace_elastic_loading(self):
        e, largest, d = 100.0, 0.005, 0.003
        assert cylinders2020.unloading_force(d, largest, e) == pytest.approx(e * d**2)
        printed = cylinders2020.unloading_force(d, largest, e, "published")
        assert printed > 1.5 * e * d**2

    def test_no_tension_is_c1_where_the_annulus_leaves(self):
        e, largest = 20.0, 0.3
        at, h = cylinders2020.annulus_leaves(largest, e), 1e-7
        f = [
            cylinders2020.unloading_force(at + s, largest, e, "no_tension")
            for s in (-2 * h, -h, h, 2 * h)
        ]
        assert f[2] == pytest.approx(f[1], abs=1e-5)
        assert (f[3] - f[2]) == pytest.approx(f[1] - f[0], rel=1e-4)

    def test_a_bar_of_modulus_one_never_yields(self):
        assert cylinders2020.plastic_radius(0.5, 1.0) == 0.0
        assert cylinders2020.loading_force(0.5, 1.0) == pytest.approx(0.25)
