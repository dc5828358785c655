"""Every loading law with every unloading law, along any path."""

import dataclasses
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pestle.errors import InputError
from pestle.particle import (
    Cycle,
    Particle,
    ParticleMaterial,
    RangeWarning,
    Shahin2021,
    Zunker2024,
    build,
    fields,
    find,
    names,
    unloading_names,
)
from pestle.particle.law import LOADING, UNLOADING

RADIUS = 1e-4
VALUES = {
    "youngs_modulus": 5e9,
    "poisson_ratio": 0.3,
    "yield_stress": 2e7,
    "strength": 3e7,
    "hardening_exponent": 0.4,
    "stiffness_ratio": 20.0,
    "transition": 0.1,
    "stiffening": 5e5,
    "work_of_adhesion": 0.0,
}
LARGEST = {"simple": 0.4, "die": 0.46, "hydrostatic": 0.185}
MATRIX = [
    (f"{loading}+{unloading}", configuration)
    for loading in names()
    if loading != "zunker2024"
    for unloading in unloading_names()
    for configuration in LOADING[loading].configurations
]


def law(name, **changes):
    known = fields(name)
    values = {k: v for k, v in VALUES.items() if k in known}
    return build(name, {**values, **changes})


def quiet(law, path, configuration="simple"):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        return law.follow(path, radius=RADIUS, configuration=configuration)


def path_through(corners, number=2001):
    t = np.linspace(0.0, len(corners) - 1.0, number * (len(corners) - 1))
    return np.interp(t, np.arange(len(corners)), corners) * RADIUS


@pytest.mark.parametrize(("name", "configuration"), MATRIX)
class TestMatrix:
    def test_whole_cycle(self, name, configuration):
        one, top = law(name), LARGEST[configuration]
        corners = np.array([0.0, 0.3, 0.0, 0.3, 1.0, 0.8, 1.0, -0.1]) * top
        path = path_through(corners)
        curve = quiet(one, path, configuration)
        assert np.all(np.isfinite(curve.force))
        assert np.all(curve.force >= 0.0)
        assert curve.force[-1] == 0.0
        work = np.concatenate(
            [
                [0.0],
                np.cumsum(np.diff(path) * 0.5 * (curve.force[1:] + curve.force[:-1])),
            ]
        )
        scale = np.max(curve.force) * RADIUS * top
        assert work[-1] > 0.0
        # from and to x = 0.3: nothing is gained by having been at zero in between
        legs = 2001 * np.array([1, 3])
        assert work[legs[1]] - work[legs[0]] == pytest.approx(0.0, abs=2e-4 * scale)

    def test_unloading_starts_from_the_loading_curve(self, name, configuration):
        one, top = law(name), LARGEST[configuration] * RADIUS
        curve = quiet(one, np.array([0.0, top, top * (1.0 - 1e-9)]), configuration)
        virgin = quiet(one, np.array([top]), configuration)
        assert curve.force[1] == virgin.force[0]
        assert curve.force[2] == pytest.approx(virgin.force[0], rel=1e-4)

    def test_never_above_the_loading_curve(self, name, configuration):
        one, top = law(name), LARGEST[configuration] * RADIUS
        d = np.linspace(0.0, top, 501)
        up = quiet(one, d, configuration).force
        for part in (0.002, 0.1, 0.5, 1.0):
            path = np.concatenate([[part * top], part * d[::-1]])
            down = quiet(one, path, configuration).force[1:][::-1]
            virgin = quiet(one, part * d, configuration).force
            assert np.all(down <= virgin * (1.0 + 1e-12) + 1e-12 * up[-1])


@settings(deadline=None, max_examples=40)
@given(
    corners=st.lists(st.just(0.0) | st.floats(1e-12, 0.45), min_size=1, max_size=7),
    unloading=st.sampled_from(sorted(UNLOADING)),
    loading=st.sampled_from(["shahin2021", "shahin2021_hardening", "cylinders2020"]),
)
def test_no_closed_path_gives_energy(corners, unloading, loading):
    path = path_through([0.0, *corners, 0.0], 501)
    force = quiet(law(f"{loading}+{unloading}"), path).force
    work = np.trapezoid(force, path)
    assert work >= -1e-3 * np.max(force, initial=1e-300) * RADIUS


class TestSoftUnloading:
    def test_it_follows_the_loading_curve_and_says_so(self):
        """A linear spring that gives all back would be above a curve that stiffens."""
        soft = law("cylinders2020+luding2008", stiffness_ratio=1.0 + 1e-9)
        path = np.array([0.0, 0.003, 0.002]) * RADIUS  # elastic: F = E d^2
        with pytest.warns(RangeWarning, match="softer than loading"):
            curve = soft.follow(path, radius=RADIUS)
        virgin = soft.follow(path[[2]], radius=RADIUS)
        assert curve.force[2] == virgin.force[0]
        assert curve.contact_radius[2] == virgin.contact_radius[0]


class TestLibrary:
    def test_parameters_are_shared(self):
        one = law("shahin2021+edmans2020")
        assert one.loading.youngs_modulus == one.unloading.youngs_modulus == 5e9
        assert one.name == "shahin2021+edmans2020"

    def test_loading_alone_does_not_unload(self):
        with pytest.raises(InputError, match="how to load only"):
            law("shahin2021").follow([1e-5, 0.5e-5], radius=RADIUS)

    @pytest.mark.parametrize(
        ("name", "words"),
        [
            ("shahin2012", 'did you mean "shahin2021"'),
            ("shahin2021+edman2020", 'did you mean "edmans2020"'),
            ("zunker2024+edmans2020", "unloads by itself"),
        ],
    )
    def test_unknown_names(self, name, words):
        with pytest.raises(InputError, match=words):
            find(name)

    def test_unknown_and_missing_parameters(self):
        with pytest.raises(InputError, match='did you mean "yield_stress"'):
            law("shahin2021", yield_stres=1.0)
        with pytest.raises(InputError, match="needs youngs_modulus, poisson_ratio"):
            build("shahin2021", {"yield_stress": 1.0})

    @pytest.mark.parametrize("kind", [*LOADING.values(), *UNLOADING.values()])
    def test_every_law_says_what_it_is(self, kind):
        assert kind.citation.startswith("@")
        assert kind.name[-4:].isdigit() or "2021" in kind.name
        assert len(kind.summary) < 70
        assert kind.validity
        for entry in dataclasses.fields(kind):
            assert entry.metadata["help"]

    def test_unknown_option(self):
        with pytest.raises(InputError, match='did you mean "published"'):
            law("cylinders2020+cylinders2020", variant="publishd")


MATERIAL = {"youngs_modulus": 5e9, "poisson_ratio": 0.3, "yield_stress": 2e7}


class TestZunker:
    @pytest.mark.parametrize(
        ("configuration", "counts"),
        [("simple", (2,)), ("die", (2, 4)), ("hydrostatic", (6,))],
    )
    def test_is_the_exact_solver(self, configuration, counts):
        path = np.array([0.05, 0.1, 0.09, 0.099, 0.15]) * RADIUS
        mdr = Zunker2024(**MATERIAL, work_of_adhesion=0.1)
        got = mdr.follow(path, radius=RADIUS, configuration=configuration)
        material = ParticleMaterial(**MATERIAL, work_of_adhesion=0.1)
        particle = Particle(material, RADIUS, counts=counts)
        still = (0.0,) * (len(counts) - 1)
        want = [particle.move((d, *still)).flats[0] for d in path]
        np.testing.assert_array_equal(got.force, [flat.force for flat in want])
        radii = [flat.contact_radius for flat in want]
        np.testing.assert_array_equal(got.contact_radius, radii)

    def test_curve_is_that_of_pressing_in_any_order(self):
        mdr = Zunker2024(**MATERIAL)
        d = np.array([[0.2, 0.05], [0.1, 0.15]]) * RADIUS
        curve = mdr.curve(d, radius=RADIUS)
        want = mdr.follow(np.sort(d.ravel()), radius=RADIUS).force
        np.testing.assert_allclose(np.sort(curve.force.ravel()), want, rtol=1e-12)
        assert curve.force.shape == (2, 2)

    def test_one_path_at_a_time(self):
        with pytest.raises(InputError, match="one path at a time"):
            Zunker2024(**MATERIAL).follow(np.ones((2, 2)) * 1e-6, radius=RADIUS)


def test_a_law_of_ones_own_needs_no_registration():
    from pestle.particle import Curve, Loading

    @dataclasses.dataclass(frozen=True, kw_only=True)
    class Spring(Loading):
        name = "spring"

        def _curve(self, x, radius, configuration):
            return Curve(1e-3 * x, radius * np.sqrt(x))

    own = Cycle(loading=Spring(), unloading=law("shahin2021+edmans2020").unloading)
    force = quiet(own, np.array([0.0, 2e-5, 1.999e-5, 0.0])).force
    assert force[1] == pytest.approx(2e-4)
    assert 0.0 < force[2] < force[1]
    assert isinstance(law("shahin2021").loading, Shahin2021)
