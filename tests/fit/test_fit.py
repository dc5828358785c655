"""Fits find what a curve was drawn from, and know how well they know it."""

import tomllib
import warnings

import numpy as np
import pytest
from scipy.stats import binom

from pestle.errors import InputError
from pestle.fit import Curve, draw_fit, fit, material_set, save
from pestle.particle import RangeWarning, build

RADIUS = 5e-5
SOLID = {"youngs_modulus": 5e9, "poisson_ratio": 0.3, "yield_stress": 2e7}
HARDENING = {"strength": 6.0272e6, "hardening_exponent": 0.6585}
NOISE = 0.01
"""Standard deviation of the noise over the largest force."""

LAWS = {
    "shahin2021": (SOLID, ("yield_stress", "youngs_modulus"), 0.4),
    "shahin2021_hardening": (HARDENING, ("strength", "hardening_exponent"), 0.45),
    "biwa1995": (HARDENING, ("strength", "hardening_exponent"), 0.03),
    "cylinders2020": (
        {"youngs_modulus": 5e8, "yield_stress": 2e7},
        ("yield_stress", "youngs_modulus"),
        0.3,
    ),
    "shahin2021+edmans2020": (
        {**SOLID, "yield_stress": 3e7, "exponent": 1.3},
        ("yield_stress", "exponent"),
        0.3,
    ),
    "shahin2021+etsion2005": (
        {**SOLID, "yield_stress": 1.5e7},
        ("yield_stress",),
        0.05,
    ),
    "shahin2021+mesarovic2000": (SOLID, ("yield_stress", "youngs_modulus"), 0.3),
    "shahin2021+luding2008": (
        {**SOLID, "stiffness_ratio": 12.0, "transition": 0.5},
        ("yield_stress", "stiffness_ratio"),
        0.3,
    ),
    "shahin2021+walton1986": (
        {**SOLID, "stiffening": 3e6},
        ("yield_stress", "stiffening"),
        0.3,
    ),
    "shahin2021+cylinders2020": (
        {**SOLID, "yield_stress": 3e7},
        ("yield_stress", "youngs_modulus"),
        0.3,
    ),
    "zunker2024": (SOLID, ("yield_stress", "youngs_modulus"), 0.2),
}


def clean(name, points=120):
    """Approach and force of a law, with unloading where it has any."""
    values, vary, top = LAWS[name]
    if name == "zunker2024":
        points = 40
    d = np.linspace(0.0, top, points + 1)[1:] * RADIUS
    if "+" in name or name == "zunker2024":
        back = d[-1] * np.linspace(1.0, 0.85, points // 2)[1:]
        d = np.concatenate([d, back])
    force = build(name, values).follow(d, radius=RADIUS).force
    return values, vary, 2.0 * d, force


def curve_of(approach, force):
    return Curve(approach=approach, force=force, diameter=2.0 * RADIUS)


def without(values, vary):
    return {key: value for key, value in values.items() if key not in vary}


@pytest.mark.filterwarnings("ignore::pestle.particle.RangeWarning")
@pytest.mark.parametrize("name", LAWS)
def test_finds_what_a_clean_curve_was_drawn_from(name):
    values, vary, approach, force = clean(name)
    found = fit(name, curve_of(approach, force), vary, fixed=without(values, vary))
    want = [values[key] for key in vary]
    np.testing.assert_allclose(found.values, want, rtol=1e-4)
    assert not found.at_bound


def coverage(name, trials):
    """How many 95 % intervals of each parameter hold the truth."""
    values, vary, approach, force = clean(name)
    truth = np.array([values[key] for key in vary])
    hits = np.zeros(len(vary), dtype=int)
    for seed in range(trials):
        noise = np.random.default_rng(seed).normal(size=len(force))
        measured = force + NOISE * np.max(force) * noise
        start = dict(zip(vary, truth * 1.2, strict=True))
        found = fit(
            name,
            curve_of(approach, measured),
            vary,
            fixed=without(values, vary),
            start=start,
        )
        low, high = found.interval().T
        hits += (low <= truth) & (truth <= high)
    return hits


@pytest.mark.parametrize("name", LAWS)
def test_intervals_hold_the_truth_as_often_as_they_say(name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        hits = coverage(name, 300)
    low, high = binom.interval(0.99, 300, 0.95)
    assert np.all((hits >= low) & (hits <= high)), f"{hits} of 300, {low} to {high}"


class TestMicrocrystallineCellulose:
    """Section 3.6 of the thesis: kappa = 6.0272 MPa, 1/m = 0.6585."""

    def test_is_found_again_within_a_percent(self):
        _, vary, approach, force = clean("shahin2021_hardening")
        noise = np.random.default_rng(1).normal(size=len(force))
        measured = force + 0.002 * np.max(force) * noise
        found = fit("shahin2021_hardening", curve_of(approach, measured), vary)
        assert found.values == pytest.approx([6.0272e6, 0.6585], rel=0.01)
        assert found.noise == pytest.approx(0.002 * np.max(force), rel=0.2)
        assert abs(found.correlation[0, 1]) < 1.0

    def test_pascals_or_megapascals(self):
        """The same with forces a million times smaller: nothing is scaled by hand."""
        _, vary, approach, force = clean("shahin2021_hardening")
        found = fit("shahin2021_hardening", curve_of(approach, 1e-6 * force), vary)
        assert found.values == pytest.approx([6.0272, 0.6585], rel=1e-4)


class TestOptions:
    def one(self, **options):
        _, vary, approach, force = clean("shahin2021_hardening")
        return fit("shahin2021_hardening", curve_of(approach, force), vary, **options)

    def test_bounds_hold_and_are_reported(self):
        found = self.one(bounds={"hardening_exponent": (0.0, 0.5)})
        assert found.values[1] == pytest.approx(0.5, rel=1e-4)
        assert found.at_bound == ("hardening_exponent",)

    def test_bounds_that_are_empty(self):
        with pytest.raises(InputError, match="no value between"):
            self.one(bounds={"hardening_exponent": (1.5, 2.0)})

    def test_unknown_parameter(self):
        with pytest.raises(InputError, match='did you mean "strength"'):
            self.one(start={}, fixed={"strenght": 1.0})

    def test_words_cannot_be_fitted(self):
        _, _, approach, force = clean("shahin2021_hardening")
        with pytest.raises(InputError, match="no number 'reading'"):
            fit("shahin2021_hardening", curve_of(approach, force), ["reading"])

    def test_parameters_that_do_the_same(self):
        """In the elastic regime no curve tells about the yield stress."""
        stiff = {"youngs_modulus": 5e8, "yield_stress": 1e9}
        d = np.linspace(0.001, 0.02, 30) * RADIUS
        force = build("cylinders2020", stiff).follow(d, radius=RADIUS).force
        with pytest.raises(InputError, match="does not fix"):
            fit(
                "cylinders2020",
                curve_of(2.0 * d, force),
                ["youngs_modulus", "yield_stress"],
                start=stiff,
            )

    def test_diameter_must_fit(self):
        with pytest.raises(InputError, match="do not fit a particle"):
            Curve(approach=np.ones(5), force=np.ones(5), diameter=0.5)

    def test_curve_must_be_one(self):
        with pytest.raises(InputError, match="not a curve"):
            Curve(approach=np.ones(5), force=np.ones(4), diameter=3.0)


class TestOutput:
    @pytest.fixture
    def found(self):
        values, _, approach, force = clean("shahin2021+edmans2020")
        noise = np.random.default_rng(3).normal(size=len(force))
        measured = force + NOISE * np.max(force) * noise
        vary = ("yield_stress", "exponent")
        return fit(
            "shahin2021+edmans2020",
            curve_of(approach, measured),
            vary,
            fixed=without(values, vary),
        )

    def test_material_set_has_the_form_of_the_packaged_ones(self, found):
        from pestle.materials import Value

        data = tomllib.loads(material_set(found, source="mcc.csv"))
        assert data["citation"].count("@") == 2
        values = {k: Value(**entry) for k, entry in data["material"].items()}
        assert set(values) == {"youngs_modulus", "poisson_ratio", "yield_stress"}
        stress = values["yield_stress"]
        assert stress.low < stress.value < stress.high
        assert values["youngs_modulus"].low is None
        assert set(data["suggested"]) == {"exponent"}

    def test_files(self, found, tmp_path):
        paths = save(found, tmp_path / "new", source="mcc.csv")
        names = {path.name for path in paths}
        assert names == {"material.toml", "fit.json", "residuals.csv", "fit.svg"}
        assert all(path.stat().st_size > 100 for path in paths)

    def test_figure(self, found):
        top, bottom = draw_fit(found).axes
        assert top.get_ylabel() == "force [mN]"
        assert bottom.get_ylabel() == "residual [mN]"
