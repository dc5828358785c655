"""The law of docs/laws/add.md does in the engine what its paper says."""

import importlib
from itertools import pairwise

import numpy as np
import pytest

from pestle import testing
from pestle.engine import step as st
from pestle.engine.engine import Engine, PairRule
from pestle.laws import Geometry, Solid


@pytest.fixture
def law():
    """The module, registered for this test only."""
    return importlib.reload(importlib.import_module("walton1986"))


@pytest.fixture
def at(law):
    """Answer and new state at an overlap."""
    k = law.Constants(1e8, 4.0)
    return lambda x, s: law.contact(k, Geometry(x, 1e-4, 2e-4, 2e-4, 1.0, 0.0), s)


@pytest.mark.parametrize(("rebound", "speed"), [(0.5, 0.1), (0.5, 2.0), (0.9, 2.0)])
def test_restitution_is_the_option_at_any_speed(law, rebound, speed):
    engine = Engine(
        law=law.Walton1986(pressure=1e6, rebound=rebound),
        solids=[Solid(youngs_modulus=1e8, poisson_ratio=0.3, density=1500.0)],
        rules={(0, 0): PairRule()},
        safety=0.05,
    )
    place = np.array([[0.0, 0.0, 0.0], [2e-3, 0.0, 0.0]])
    engine.set_particles(place, np.full(2, 1e-3), np.zeros(2, int), np.full(2, 1500.0))
    engine.vel[:, 0] = np.where(engine.ids == 1, speed, -speed)
    engine.start()
    assert engine.advance(2000 if speed > 1 else 10_000) == st.RAN
    left, right = (engine.vel[engine.ids == number, 0][0] for number in (1, 2))
    assert right - left == pytest.approx(2 * speed * rebound, rel=5e-3)


def test_it_keeps_the_contract(law):
    testing.check_law(law.Walton1986(pressure=1e6), scales=False)


def test_it_is_shown_in_forty_lines(docs):
    text = (docs / "laws" / "walton1986.py").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 40


def test_no_closed_path_creates_energy(law, at):
    corners = np.array([0.0, 2e-6, 1.4e-6, 2.5e-6, 0.0, 2.2e-6, 0.0])
    state, work = law.State(0.0), 0.0
    for here, there in pairwise(corners):
        overlap = np.linspace(here, there, 4001)
        force = []
        for x in overlap:
            answer, state = at(x, state)
            force.append(answer.force)
        work += np.trapezoid(force, overlap)
    assert answer.stored == 0.0
    assert work > 0.0


def test_stored_energy_is_what_unloading_gives_back(law, at):
    pressed, state = at(2e-6, law.State(0.0))
    overlap = np.linspace(2e-6, 0.0, 20_001)
    force = [at(x, state)[0].force for x in overlap]
    assert -np.trapezoid(force, overlap) == pytest.approx(pressed.stored, rel=1e-6)
