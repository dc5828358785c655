"""The exact single particle: limits, volume, events, path independence, errors."""

import warnings
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pestle.errors import InputError, SimulationError
from pestle.particle import (
    EnergyWarning,
    Particle,
    ParticleMaterial,
    Resolution,
    follow,
    leg,
)
from pestle.reference import ellipse, mdr, volume


def material(ratio=20.0, **other):
    """E = 1, nu = 0.3, Y = 1/ratio."""
    other = {"youngs_modulus": 1.0, "poisson_ratio": 0.3, **other}
    return ParticleMaterial(yield_stress=1.0 / ratio, **other)


def particle(ratio=20.0, counts=(2,), rule="plastic", **other):
    return Particle(material(ratio), 1.0, counts=counts, radius_rule=rule, **other)


def quiet_eq37(ratio, counts=(2,)):
    with pytest.warns(EnergyWarning, match="create energy"):
        return particle(ratio, counts, "eq37")


def same(one, two, rel=1e-11):
    """Both states are the same."""
    assert one.radius == pytest.approx(two.radius, rel=rel)
    assert one.volume_ratio == pytest.approx(two.volume_ratio, rel=rel)
    for a, b in zip(one.flats, two.flats, strict=True):
        assert a.force == pytest.approx(b.force, rel=rel, abs=1e-13)
        assert a.contact_radius == pytest.approx(b.contact_radius, rel=rel, abs=1e-12)
        assert a.yielded == b.yielded


def work(states, count):
    """Work of `count` flats each on the particle along finely spaced states [J]."""
    total = 0.0
    for group in range(len(states[0].flats)):
        force = [s.flats[group].force for s in states]
        place = [s.flats[group].displacement for s in states]
        total += count[group] * np.trapezoid(force, place)
    return total


def fine(corners, steps=200):
    """Path through corners in small pieces."""
    path = [corners[0]]
    for a, b in pairwise(corners):
        path += list(np.linspace(a, b, steps + 1)[1:])
    return path


class TestElastic:
    def test_is_the_ellipse_before_yield(self):
        p = particle(6.25)
        for d in (0.01, 0.1, 0.2, 0.05):
            flat = p.move([d]).flats[0]
            shape = ellipse.of_sphere(1.0)
            modulus = p.material.constants.modulus
            force = ellipse.force(shape, d, modulus=modulus)
            assert flat.force == pytest.approx(force, rel=1e-14)
            assert not flat.yielded
        assert p.state.growth == 0.0

    def test_a_flat_out_of_reach_does_nothing(self):
        state = particle().move([-0.3])
        assert state.flats[0].force == state.flats[0].contact_radius == 0.0
        assert state.volume_ratio == 1.0


class TestYield:
    def test_yields_at_the_root_of_the_pressures(self):
        p = particle(20.0)
        expected = mdr.yield_overlap(
            1.0, modulus=p.material.constants.modulus, yield_stress=0.05
        )
        assert not p.move([expected * (1 - 1e-9)]).flats[0].yielded
        flat = p.move([expected * (1 + 1e-9)]).flats[0]
        assert flat.yielded
        assert flat.yield_overlap == pytest.approx(expected, rel=1e-14)

    def test_pressure_of_a_yielding_contact_is_the_hardening_curve(self):
        p = particle(100.0)
        for d in (0.1, 0.3, 0.5):
            state = p.move([d])
            flat = state.flats[0]
            pressure = mdr.hardening_pressure(
                flat.largest, state.radius, yield_stress=0.01
            )
            assert flat.pressure == pytest.approx(pressure, rel=1e-13)


class TestVolume:
    @pytest.mark.parametrize("ratio", [12.5, 200.0])
    def test_all_volume_change_of_plastic_flow_is_elastic(self, ratio):
        """Geometric and elastic volume change by the same amount, Eq. (C.5)."""
        p = particle(ratio, counts=(2, 4))
        excess = []
        for d in (0.2, 0.3, 0.4):
            state = p.move([d, 0.0])
            overlaps = [f.overlap for f in state.flats for _ in range(f.count)]
            geometric = volume.geometric_volume(overlaps, state.radius)
            real = state.volume_ratio * volume.sphere_volume(1.0)
            yielded = tuple(f.yielded for f in state.flats)
            excess.append((yielded, geometric - real))
        pairs = [(a[1], b[1]) for a, b in pairwise(excess) if a[0] == b[0]]
        assert pairs
        for a, b in pairs:
            assert a == pytest.approx(b, abs=2e-14)

    def test_retracted_particle_has_its_volume_but_a_larger_radius(self):
        p = particle(200.0)
        p.move([0.4])
        state = p.move([0.0])
        assert state.volume_ratio == 1.0
        assert state.radius > 1.05

    def test_frozen_rule_never_grows(self):
        p = particle(200.0, rule="frozen")
        states = follow(p, [[0.4], [0.2], [0.5]])
        assert all(s.growth == 0.0 for s in states)

    @pytest.mark.parametrize("ratio", [50.0, 200.0])
    def test_rules_agree_on_first_loading_of_a_stiff_particle(self, ratio):
        forces = [
            particle(ratio, rule=r).move([0.4]).flats[0].force for r in ("plastic",)
        ]
        forces.append(particle(ratio, rule="loading").move([0.4]).flats[0].force)
        forces.append(quiet_eq37(ratio).move([0.4]).flats[0].force)
        assert forces == pytest.approx([forces[0]] * 3, rel=1e-10)

    def test_rules_order_the_radius_of_a_soft_particle(self):
        plastic = particle(6.25).move([0.4]).radius
        loading = particle(6.25, rule="loading").move([0.4]).radius
        assert 1.0 < plastic < loading


class TestUnloading:
    def test_follows_the_elastic_contact_and_back(self):
        p = particle(12.5)
        loaded = p.move([0.3])
        force = loaded.flats[0].force
        half = p.move([0.29]).flats[0]
        assert 0.0 < half.force < force
        assert half.contact_radius < loaded.flats[0].contact_radius
        same(p.move([0.3]), loaded)

    def test_separates_at_the_plastic_overlap_and_forgets_nothing(self):
        p = particle(12.5)
        loaded = p.move([0.3])
        flat = loaded.flats[0]
        plastic = mdr.plastic_contact(
            flat.largest,
            loaded.radius,
            area_offset=flat.area_offset,
            constants=p.material.constants,
        )
        opening = plastic.plastic_overlap - loaded.growth
        assert p.move([opening + 1e-9]).flats[0].contact_radius > 0.0
        open_flat = p.move([opening - 1e-9]).flats[0]
        assert open_flat.force == open_flat.contact_radius == open_flat.pressure == 0.0
        assert open_flat.largest == flat.largest
        p.move([-0.2])
        same(p.move([0.3]), loaded)

    def test_secondary_force_of_a_die_stays(self):
        """Resting flats keep their whole force (the radius does not shrink)."""
        p = particle(20.0, counts=(2, 4))
        peak = p.move([0.4, 0.0]).flats[1].force
        gone = p.move([0.2, 0.0])
        assert gone.flats[0].force == 0.0
        assert gone.flats[1].force == peak > 0.0

    def test_running_maximum_of_an_open_contact_does_not_grow(self):
        p = particle(20.0, counts=(2, 2))
        before = p.move([0.3, 0.0]).flats[0].largest
        p.move([0.2, 0.0])
        assert p.move([0.2, 0.1]).flats[0].largest == before


class TestPaths:
    @pytest.mark.parametrize("counts", [(2,), (2, 4)])
    def test_does_not_depend_on_the_step(self, counts):
        rest = (0.0,) * (len(counts) - 1)
        path = [(d, *rest) for d in (0.3, 0.28, 0.35)]
        coarse, normal = (
            follow(particle(12.5, counts, resolution=Resolution(step=h)), path)
            for h in (0.02, 0.004)
        )
        for a, b in zip(coarse, normal, strict=True):
            same(a, b)

    def test_does_not_depend_on_stops(self):
        corners = [(0.0, 0.0), (0.3, 0.0), (0.25, 0.0), (0.25, 0.2), (0.3, 0.2)]
        direct, stopping = (particle(20.0, (2, 2)) for _ in range(2))
        same(follow(direct, corners)[-1], follow(stopping, fine(corners, 7))[-1])

    def test_flat_by_flat_is_group_by_group(self):
        path = [(0.2, 0.0), (0.18, 0.05)]
        groups = follow(particle(20.0, (2, 4)), path)[-1]
        single = particle(20.0, (1,) * 6)
        flats = follow(single, [(a, a, b, b, b, b) for a, b in path])[-1]
        assert flats.radius == pytest.approx(groups.radius, rel=1e-12)
        assert flats.flats[0].force == pytest.approx(groups.flats[0].force, rel=1e-11)
        assert flats.flats[5].force == pytest.approx(groups.flats[1].force, rel=1e-11)

    def test_order_of_flats_does_not_matter(self):
        one = follow(particle(20.0, (2, 4)), [(0.2, 0.0), (0.1, 0.1)])[-1]
        two = follow(particle(20.0, (4, 2)), [(0.0, 0.2), (0.1, 0.1)])[-1]
        assert one.radius == pytest.approx(two.radius, rel=1e-13)
        assert one.flats[0].force == pytest.approx(two.flats[1].force, rel=1e-12)

    def test_copy_is_independent(self):
        p = particle()
        p.move([0.2])
        twin = p.copy()
        twin.move([0.3])
        assert p.state.flats[0].displacement == 0.2
        same(p.move([0.3]), twin.state, rel=1e-15)

    @pytest.mark.parametrize("w", [0.0, 1e-3])
    def test_scales_with_units(self, w):
        """Lengths by s, stresses by p, work of adhesion by s p."""
        s, p = 7.5e-5, 7e9
        path = np.array([[0.2], [0.195], [0.19], [0.25]])
        one = Particle(material(12.5, work_of_adhesion=w), 1.0)
        two = Particle(
            ParticleMaterial(
                youngs_modulus=p,
                poisson_ratio=0.3,
                yield_stress=p / 12.5,
                work_of_adhesion=s * p * w,
            ),
            s,
        )
        pairs = zip(follow(one, path), follow(two, s * path), strict=True)
        for a, b in pairs:
            assert b.radius == pytest.approx(s * a.radius, rel=1e-12)
            assert b.flats[0].force == pytest.approx(
                s * s * p * a.flats[0].force, rel=1e-9
            )
            assert b.flats[0].contact_radius == pytest.approx(
                s * a.flats[0].contact_radius, rel=1e-9
            )


class TestEnergy:
    @settings(max_examples=15, deadline=None)
    @given(
        corners=st.lists(
            st.tuples(st.floats(0.0, 0.35), st.floats(0.0, 0.15)),
            min_size=1,
            max_size=3,
        ),
        ratio=st.sampled_from([6.25, 20.0, 200.0]),
    )
    def test_no_closed_path_creates_energy(self, corners, ratio):
        path = fine([(0.0, 0.0), *corners, (0.0, 0.0)], 150)
        states = follow(particle(ratio, (2, 2)), path)
        scale = max(f.force for s in states for f in s.flats) * 0.35
        assert work(states, (2, 2)) >= -1e-4 * scale

    def test_elastic_cycle_of_the_printed_rule_creates_energy(self):
        """Why eq37 warns: 4 % of the stored energy a cycle at E/Y = 6.25."""
        path = fine([(0.0,), (0.1,), (0.0,)], 400)
        states = follow(quiet_eq37(6.25), path)
        stored = work(states[:401], (2,))
        assert work(states, (2,)) < -0.02 * stored
        assert abs(work(follow(particle(6.25), path), (2,))) < 1e-12

    def test_cycles_below_the_maximum_are_free(self):
        p = particle(20.0)
        p.move([0.3])
        states = [p.state, *follow(p, fine([(0.3,), (0.2,), (0.3,)], 300))]
        assert abs(work(states, (2,))) < 1e-12


class TestCompiled:
    @pytest.mark.parametrize(
        ("counts", "rule", "w", "path"),
        [
            ((2,), "plastic", 0.0, [[0.3], [0.297], [0.31]]),
            ((2,), "loading", 0.01, [[0.1], [-0.05], [0.12]]),
            ((2, 4), "plastic", 0.0, [[0.2, 0.0], [0.35, 0.0], [0.3, 0.0]]),
            ((1, 1, 1), "eq37", 0.0, [[0.2, 0.0, 0.0], [0.1, 0.15, 0.0]]),
        ],
    )
    @pytest.mark.filterwarnings("ignore::pestle.errors.EnergyWarning")
    def test_same_as_plain_python(self, counts, rule, w, path):
        p = Particle(
            material(12.5, work_of_adhesion=w), 1.0, counts=counts, radius_rule=rule
        )
        plain = np.empty((len(path), len(counts), leg.COLUMNS))
        trouble = np.zeros(3)
        done = leg.follow_path(
            p._setting, p._counts, p._point, np.array(path), plain, trouble
        )
        trace = p.trace(path)
        assert done == len(path)
        np.testing.assert_allclose(
            trace.force, plain[:, :, leg.FORCE], rtol=1e-11, atol=1e-15
        )
        np.testing.assert_allclose(trace.radius, 1.0 + plain[:, 0, leg.GROWTH], 1e-13)


class TestErrors:
    @pytest.mark.parametrize(
        ("ratio", "counts", "limit"),
        [
            (20.0, (2, 4), 0.489),
            (200.0, (2, 4), 0.450),
            (20.0, (6,), 0.213),
            (200.0, (6,), 0.192),
        ],
    )
    def test_singular_growth_is_an_error_where_it_should(self, ratio, counts, limit):
        rest = (0.0,) * (len(counts) - 1)
        p = particle(ratio, counts)
        p.move((limit - 0.002, *rest))
        with pytest.raises(SimulationError, match="radius-singular") as caught:
            p.move((limit + 0.002, *rest))
        assert f"{limit - 0.001:.3f}"[:4] in str(caught.value)
        assert p.state.flats[0].displacement == limit - 0.002

    @pytest.mark.parametrize(
        "bad", [[1.0], [1.5], [0.1, 0.1], [float("nan")], [-float("inf")]]
    )
    def test_impossible_displacements(self, bad):
        with pytest.raises(InputError):
            particle().move(bad)

    def test_unknown_rule_names_the_nearest(self):
        with pytest.raises(InputError, match="plastic"):
            particle(rule="plastik")

    @pytest.mark.parametrize(
        "bad",
        [
            {"youngs_modulus": -1.0},
            {"poisson_ratio": 0.5},
            {"work_of_adhesion": -1.0},
            {"youngs_modulus": float("nan")},
        ],
    )
    def test_impossible_material(self, bad):
        with pytest.raises(InputError, match=next(iter(bad))):
            material(**bad)

    @pytest.mark.parametrize(
        ("radius", "counts"), [(0.0, (2,)), (1.0, ()), (1.0, (0,))]
    )
    def test_impossible_particle(self, radius, counts):
        with pytest.raises(InputError, match="particle-out-of-range"):
            Particle(material(), radius, counts=counts)

    def test_other_rules_do_not_warn(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            particle(rule="loading")
