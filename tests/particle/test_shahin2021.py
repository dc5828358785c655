"""Shahin (2021), chapter 2: borders, limits, and the numbers that the thesis prints."""

import csv
import warnings
from importlib.resources import files
from math import pi

import numpy as np
import pytest

from pestle.errors import InputError
from pestle.particle import RangeWarning, Shahin2021, shahin2021_secondary
from pestle.particle import shahin2021_hardness as law
from pestle.particle.configuration import CONFIGURATIONS, cell
from pestle.particle.shahin2021_plastic import GAMMA, density_product
from pestle.particle.shahin2021_radius import coefficients, relative_radius

TABLE = files("pestle.reproduce") / "shahin2021_table_a1.csv"
ROWS = [
    (configuration, *map(float, numbers))
    for configuration, *numbers in list(csv.reader(TABLE.read_text().splitlines()))[1:]
]


def parameters(row):
    configuration, *material, _ = row
    return law.parameters(*law.material_numbers(*material), configuration)


def borders(k):
    ends = [k.onset.at_yield, k.onset.at_max]
    if k.compaction is not None:
        ends += [k.plastic.lowest, k.compaction.zero_porosity]
    return [float(end) for end in ends]


def one_sided(k, border, branch):
    """H and slope of the branch with this number exactly at a border."""
    if branch < 2:
        return (law.elastic, law.elastic_plastic)[branch](border, k.onset)
    if branch == 2:
        return law.softened(border, k.plastic)
    return law.confined(border, k.compaction, k.configuration)[branch - 3]


def test_the_table_is_whole():
    assert len(ROWS) == 51
    assert [sum(row[0] == c for row in ROWS) for c in CONFIGURATIONS] == [17, 17, 17]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]}-{row[-1]}")
class TestEveryMaterialOfTheTable:
    def test_printed_lambda(self, row):
        _, *material, printed = row
        assert law.material_numbers(*material)[0] == pytest.approx(printed, rel=2.8e-4)

    def test_hardness_is_c0_and_c1_at_every_border(self, row):
        k = parameters(row)
        for number, border in enumerate(borders(k)):
            left, right = (one_sided(k, border, number + n) for n in (0, 1))
            scale = left[0] / border  # a slope to compare with
            assert right[0] == pytest.approx(left[0], rel=1e-12)
            assert right[1] == pytest.approx(left[1], rel=1e-11, abs=1e-10 * scale)

    def test_slope_is_the_derivative(self, row):
        k = parameters(row)
        x = np.linspace(0.02, 0.98, 41) * 0.9
        h = 1e-6 * x
        step = law.hardness(x + h, k).value - law.hardness(x - h, k).value
        slope = law.hardness(x, k).slope
        np.testing.assert_allclose(
            step / (2.0 * h), slope, rtol=1e-5, atol=1e-5 * np.max(np.abs(slope))
        )

    def test_force_and_radius_rise(self, row):
        k = parameters(row)
        end = 0.5 if k.compaction is None else 1.02 * float(k.compaction.zero_porosity)
        x = np.linspace(1e-6, end, 4001)
        a = relative_radius(x, k.radius)
        assert np.all(np.diff(a) > 0.0)
        assert np.all(np.diff(law.hardness(x, k).value * a**2) > 0.0)

    def test_minimum_is_where_the_densities_say(self, row):
        k = parameters(row)
        if k.compaction is None:
            assert k.plastic.hardness_min == 1.0
            return
        a = relative_radius(k.plastic.lowest, k.radius)
        product = density_product(k.plastic.lowest, a, k.configuration)
        assert product == pytest.approx(GAMMA, rel=1e-13)
        quintic = np.array([k.radius.d5, -k.radius.d3, k.radius.d1])
        square = np.polymul(np.polymul(quintic, quintic), [1.0, 0.0])
        n = 1 if k.configuration == "die" else 5
        right = 144.0 * GAMMA / pi**2 * np.poly1d([-1.0, 1.0]) ** n
        roots = np.roots(np.polysub(square, right.coefficients))
        real = roots[np.abs(roots.imag) < 1e-9].real
        assert real == pytest.approx([k.plastic.lowest], rel=1e-9)  # one root only


class TestPrintedNumbers:
    def test_table_3_1(self):
        got = [coefficients(1e60, c) for c in CONFIGURATIONS]
        printed = [(1.7527, 2.3702, 3.3715), (1.7943, 3.0451, 5.7169)]
        printed.append((1.8959, 8.8138, 49.8660))  # 39.8654 in print
        np.testing.assert_allclose(got, printed, rtol=3e-5)

    def test_table_c_1(self):
        for c, first, second in (
            ("die", -31.76, -121.70),
            ("hydrostatic", -300.49, -1191.71),
        ):
            d1, d3, d5 = coefficients(1e60, c)
            assert d3**2 - 4.0 * d1 * d5 == pytest.approx(first, abs=0.01)
            assert 9.0 * d3**2 - 20.0 * d1 * d5 == pytest.approx(second, abs=0.01)

    def test_contacts_fill_their_faces_at_zero_porosity(self):
        """pi a^2 over the face of the cell; with b^(1/2) it would be 0.75 and 0.46."""
        d = coefficients(1e60, "die")
        a = relative_radius(1.0 - pi / 6.0, d)
        assert pi * a**2 / 4.0 == pytest.approx(1.0, abs=0.01)
        x = 1.0 - (pi / 6.0) ** (1.0 / 3.0)
        a = relative_radius(x, coefficients(1e60, "hydrostatic"))
        assert pi * a**2 / (4.0 * (1.0 - x) ** 2) == pytest.approx(1.0, abs=0.01)

    def test_ratio_of_the_text(self):
        lam, _ = law.material_numbers(114577.91, 0.3579, 76.34)
        assert lam == pytest.approx(1721.55, rel=1e-4)

    @pytest.mark.parametrize(
        ("onset", "radius"),
        [(0.4159, 0.5433), (0.4115, 0.5474), (0.4102, 0.5486), (0.4098, 0.5490)],
    )
    def test_table_2_4_implies_plausible_radii(self, onset, radius):
        got = shahin2021_secondary.radius_at_onset(onset)
        assert got == pytest.approx(radius, abs=1e-4)


class TestElastic:
    def test_pressure_is_that_of_hertz(self):
        """Mean pressure 4 E* sqrt(x)/(3 pi) of a sphere on a flat."""
        x = 1e-6
        h, _ = law.elastic(x, law.onset(1000.0))
        assert h == pytest.approx(1000.0 * 4.0 / (3.0 * pi) * np.sqrt(x), rel=1e-13)

    @pytest.mark.parametrize(
        ("lam", "ratio"), [(117.0, 2.20), (1000.0, 2.92), (5933.0, 3.06)]
    )
    def test_force_is_not_that_of_hertz(self, lam, ratio):
        d = coefficients(lam, "simple")
        assert d.d1**2 == pytest.approx(ratio, abs=0.005)


MATERIAL = {"youngs_modulus": 1e10, "poisson_ratio": 0.3, "yield_stress": 1e7}


class TestLaw:
    def test_force_is_hardness_times_area(self):
        shahin = Shahin2021(**MATERIAL)
        radius = 50e-6
        curve = shahin.curve([0.1 * radius], radius=radius)
        h = law.hardness(0.1, shahin.parameters()).value
        assert curve.force == pytest.approx(h * 1e7 * pi * curve.contact_radius**2)

    def test_scales_with_the_square_of_the_radius(self):
        shahin = Shahin2021(**MATERIAL)
        small, large = (shahin.curve(0.2 * r, radius=r).force for r in (1e-5, 1e-3))
        assert large == pytest.approx(1e4 * small, rel=1e-12)

    def test_nothing_without_contact(self):
        curve = Shahin2021(**MATERIAL).curve([-1e-6, 0.0], radius=1e-4)
        assert np.all(curve.force == 0.0)
        assert np.all(curve.contact_radius == 0.0)

    def test_parameters_may_be_arrays(self):
        moduli = np.array([[2e9], [1e10]])
        many = Shahin2021(**{**MATERIAL, "youngs_modulus": moduli})
        d = np.linspace(1e-6, 4e-5, 7)
        got = many.curve(d, radius=1e-4, configuration="die").force
        for row, e in zip(got, moduli[:, 0], strict=True):
            one = Shahin2021(**{**MATERIAL, "youngs_modulus": e})
            want = one.curve(d, radius=1e-4, configuration="die").force
            np.testing.assert_allclose(row, want, rtol=1e-13)

    def test_warns_once_outside_its_range(self):
        soft = Shahin2021(**{**MATERIAL, "yield_stress": 2e8})
        with pytest.warns(RangeWarning, match=r"117\.24 to 5933\.4.*Table A\.1"):
            soft.curve(1e-5, radius=1e-4)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            soft.curve(2e-5, radius=1e-4)

    def test_needs_a_plastic_regime(self):
        with pytest.raises(InputError, match="no plastic regime"):
            Shahin2021(**{**MATERIAL, "yield_stress": 5e9}).curve(1e-5, radius=1e-4)

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({"youngs_modulus": -1.0}, "not possible"),
            ({"poisson_ratio": 0.5}, r"lies in \(-1, 0.5\)"),
            ({"yield_stress": np.nan}, "not possible"),
        ],
    )
    def test_impossible_materials(self, changes, words):
        with pytest.raises(InputError, match=words):
            Shahin2021(**{**MATERIAL, **changes})

    def test_impossible_paths(self):
        shahin = Shahin2021(**MATERIAL)
        with pytest.raises(InputError, match="below the radius"):
            shahin.curve(2e-4, radius=1e-4)
        with pytest.raises(InputError, match='did you mean "die"'):
            shahin.curve(1e-5, radius=1e-4, configuration="dye")


class TestStandingContacts:
    K = law.parameters(*law.material_numbers(49200.85, 0.2251, 317.80), "die")

    def test_they_stay_elastic_plastic_up_to_a_tenth(self):
        for configuration, *material, _ in ROWS:
            if configuration == "die":
                k = law.onset(law.material_numbers(*material)[0])
                contact = shahin2021_secondary.small(0.1, k, self.K.radius)
                assert 0.0018 < contact.overlap < 0.0039
                assert contact.overlap < k.at_max

    def test_no_law_between_the_two(self):
        with pytest.raises(InputError, match="have no law"):
            shahin2021_secondary.small(0.2, self.K.onset, self.K.radius)
        with pytest.raises(InputError, match="have no law"):
            shahin2021_secondary.large(0.3, self.K, onset=0.4159)

    def test_beyond_the_onset_all_contacts_have_one_pressure(self):
        x = np.array([0.43, 0.49, 0.5])
        got = shahin2021_secondary.large(x, self.K, onset=0.4159)
        np.testing.assert_array_equal(got.value, law.hardness(x, self.K).value)


def test_volumetric_regime_is_the_bulk_modulus():
    k = law.parameters(1045.749, 985.042, "die")
    x = np.linspace(0.49, 0.5, 5)
    np.testing.assert_allclose(
        law.hardness(x, k).value, 985.042 * (1.0 - cell(x, "die")), rtol=1e-13
    )
