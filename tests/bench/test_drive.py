"""Paths of displacement and force through contacts and particles."""

import numpy as np
import pytest

from pestle.bench import (
    Displacement,
    Force,
    PairContact,
    SingleParticle,
    cyclic,
    drive,
)
from pestle.errors import InputError
from pestle.laws import Hertz, Pair, Solid, get
from pestle.particle import build

SOLID = Solid(youngs_modulus=5e9, poisson_ratio=0.3, yield_stress=2e7, density=1500.0)
RADIUS = 5e-5
PARTICLE = build(
    "shahin2021+edmans2020",
    {"youngs_modulus": 5e9, "poisson_ratio": 0.3, "yield_stress": 2e7},
)


def contact(name="hertz", work_of_adhesion=0.0, other_radius=0.0, **options):
    second = Solid() if other_radius == 0.0 else SOLID
    pair = Pair(first=SOLID, second=second, work_of_adhesion=work_of_adhesion)
    law = get(name)(**options)
    return PairContact(law=law, pair=pair, radius=RADIUS, other_radius=other_radius)


def particle(configuration="simple"):
    return SingleParticle(law=PARTICLE, radius=RADIUS, configuration=configuration)


class TestPairs:
    def test_hertz_is_hertz(self):
        run = drive(contact(), [Displacement(1e-6)])
        d = run.trace.displacement
        want = 4.0 / 3.0 * 5e9 / 0.91 * np.sqrt(RADIUS) * d**1.5
        np.testing.assert_allclose(run.trace.force, want, rtol=1e-12)
        np.testing.assert_allclose(run.trace.contact_radius, np.sqrt(RADIUS * d))

    def test_work_is_what_hertz_stores(self):
        run = drive(contact(), [Displacement(1e-6)], points=4000)
        assert run.work[-1] == pytest.approx(run.trace.stored[-1], rel=1e-6)

    def test_reduced_radius_of_two_particles(self):
        one, two = contact(), contact(other_radius=RADIUS)
        assert two.sizes[0] == pytest.approx(0.5 * RADIUS)
        assert two.mass == pytest.approx(0.5 * one.mass)

    def test_a_parted_contact_is_forgotten(self):
        """A second path through touch starts as the first did."""
        jkr = contact("jkr", 0.1)
        far = -2.0 * jkr.reach
        path = np.array([1e-8, 0.5 * -jkr.reach, far, 0.5 * -jkr.reach, 1e-8])
        force = jkr.follow(path).force
        assert force[1] < 0.0
        assert force[2] == force[3] == 0.0
        assert force[4] == force[0]

    def test_rows_are_independent(self):
        luding = contact("luding2008", loading_stiffness=1e3, unloading_stiffness=5e3)
        rows = np.array([[1e-6, 5e-7], [2e-7, 1e-7], [1e-6, 5e-7]])
        force = luding.follow(rows).force
        np.testing.assert_array_equal(force[0], force[2])
        np.testing.assert_array_equal(force[1], luding.follow(rows[1]).force)

    def test_a_law_with_neighbours_is_refused(self):
        with pytest.raises(InputError, match="no single pair"):
            contact("zunker2024").follow([0.0, 1e-7])


class TestForce:
    @pytest.mark.parametrize("subject", [contact(), particle()])
    def test_reaches_a_force(self, subject):
        run = drive(subject, [Force(0.01), Force(0.002), Force(0.02)], points=10)
        ends = run.trace.force[[10, 20, 30]]
        np.testing.assert_allclose(ends, [0.01, 0.002, 0.02], rtol=1e-9)

    def test_unloads_to_the_last_contact(self):
        run = drive(particle(), [Force(0.05), Force(0.0)], points=10)
        assert run.trace.force[-1] == 0.0
        assert run.trace.displacement[-1] > 0.5 * run.trace.displacement[10]

    def test_pulls_an_adhesive_contact(self):
        jkr = contact("jkr", 0.1)
        pull = 1.5 * np.pi * 0.1 * RADIUS
        run = drive(jkr, [Displacement(1e-7), Force(-0.99 * pull)])
        assert run.trace.force[-1] == pytest.approx(-0.99 * pull, rel=1e-9)

    def test_says_where_a_force_cannot_be_reached(self):
        with pytest.raises(InputError, match=r"does not reach a force of -0\.1 N"):
            drive(contact(), [Displacement(1e-6), Force(-0.1)])


class TestWaypoints:
    def test_cycles(self):
        tops = [Displacement(1e-6), Displacement(2e-6)]
        path = cyclic(tops, lowest=Force(0.0), cycles=2)
        assert path == [tops[0], Force(0.0)] * 2 + [tops[1], Force(0.0)] * 2

    def test_columns_leave_out_what_a_law_does_not_say(self):
        columns = drive(particle(), [Displacement(1e-6)]).columns()
        assert "stored [J]" not in columns
        assert len({len(values) for values in columns.values()}) == 1
        assert columns["leg"][0] == 0
        assert columns["leg"][-1] == 1

    def test_nothing_to_follow(self):
        with pytest.raises(InputError, match="no curve"):
            drive(contact(), [])


class TestFigures:
    def test_a_law_draws_itself(self):
        figure = PARTICLE.plot(peaks=(0.1, 0.2))
        labels = [axes.get_ylabel() for axes in figure.axes]
        assert labels == ["force [mN]", "contact radius [µm]"]
        assert PARTICLE.loading.plot(configuration="die").axes

    def test_curves_are_told_apart_without_colour(self):
        from pestle.bench.figure import draw_runs

        runs = {
            name: drive(subject, [Displacement(1e-6)])
            for name, subject in (("a", contact()), ("b", particle()))
        }
        lines = draw_runs(runs).axes[0].lines[:2]
        assert lines[0].get_linestyle() != lines[1].get_linestyle()
        assert "[µm]" in draw_runs(runs).axes[0].get_xlabel()


def test_hertz_needs_no_name():
    pair = Pair(first=SOLID, second=SOLID)
    both = PairContact(law=Hertz(), pair=pair, radius=RADIUS, other_radius=RADIUS)
    assert both.name == "hertz"


class TestFlats:
    """Any set of flats for the exact solver."""

    def mdr(self, **options):
        law = build(
            "zunker2024",
            {"youngs_modulus": 5e9, "poisson_ratio": 0.3, "yield_stress": 2e7},
        )
        return SingleParticle(law=law, radius=RADIUS, **options)

    def test_a_configuration_is_a_set_of_flats(self):
        path = RADIUS * np.array([0.1, 0.2, 0.19])
        die = self.mdr(configuration="die").follow(path).force
        flats = self.mdr(flats=(1.0, 0.0, 0.0, 1.0, 0.0, 0.0)).follow(path).force
        np.testing.assert_array_equal(die, flats)

    def test_more_flats_confine_more(self):
        path = RADIUS * np.array([0.2])
        forces = [
            self.mdr(flats=flats).follow(path).force[0]
            for flats in [(1.0, 0.0), (1.0, 0.5), (1.0, 1.0, 1.0)]
        ]
        assert forces == sorted(forces)
        assert forces[0] < forces[1]

    def test_the_table_has_every_flat(self):
        """Flats that move alike carry alike, those that stand carry less."""
        particle = self.mdr(flats=(1.0, 0.0, 0.5, 1.0, 0.0))
        columns = drive(particle, [Displacement(0.2 * RADIUS)], points=20).columns()
        force = [columns[f"force{n} [N]"][-1] for n in ("", "_2", "_3", "_4", "_5")]
        assert force[0] == force[3] > force[2] > force[1] == force[4] > 0.0
        assert columns["contact_radius_3 [m]"][-1] > columns["contact_radius_2 [m]"][-1]

    @pytest.mark.parametrize("bad", [(0.0, 1.0), (2.0,), (1.0, float("nan"))])
    def test_the_first_is_the_one_of_the_path(self, bad):
        with pytest.raises(InputError, match="flats-without-path"):
            self.mdr(flats=bad)

    def test_other_laws_know_no_flats(self):
        with pytest.raises(InputError, match="configuration-without-law"):
            SingleParticle(law=PARTICLE, radius=RADIUS, flats=(1.0, 0.0))
