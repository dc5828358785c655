"""The law of docs/laws/add.md does in the engine what its paper says."""

from itertools import pairwise

import numpy as np
import pytest
from walton1986 import Constants, State, Walton1986, contact

from pestle.engine import step as st
from pestle.engine.engine import Engine, PairRule
from pestle.laws import Geometry, Solid


@pytest.mark.parametrize(("rebound", "speed"), [(0.5, 0.1), (0.5, 2.0), (0.9, 2.0)])
def test_restitution_is_the_option_at_any_speed(rebound, speed):
    engine = Engine(
        law=Walton1986(pressure=1e6, rebound=rebound),
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


def test_no_closed_path_creates_energy():
    corners = np.array([0.0, 2e-6, 1.4e-6, 2.5e-6, 0.0, 2.2e-6, 0.0])
    k, state, work, last = Constants(1e8, 4.0), State(0.0), 0.0, 0.0
    for here, there in pairwise(corners):
        overlap = np.linspace(here, there, 4001)
        force = []
        for x in overlap:
            answer, state = contact(k, Geometry(x, 1e-4, 2e-4, 2e-4, 1.0, 0.0), state)
            force.append(answer.force)
        work += np.trapezoid(force, overlap)
        last = answer.stored
    assert last == 0.0
    assert work > 0.0


def test_stored_energy_is_what_unloading_gives_back():
    k = Constants(1e8, 4.0)
    pressed, state = contact(k, Geometry(2e-6, 1e-4, 2e-4, 2e-4, 1.0, 0.0), State(0.0))
    overlap = np.linspace(2e-6, 0.0, 20_001)
    force = [
        contact(k, Geometry(x, 1e-4, 2e-4, 2e-4, 1.0, 0.0), state)[0].force
        for x in overlap
    ]
    back = -np.trapezoid(force, overlap)
    assert back == pytest.approx(pressed.stored, rel=1e-6)
