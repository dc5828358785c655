"""Every pair law in the engine: 1,000 cohesive particles fall and settle."""

import numba
import numpy as np
import pytest

from engine.setups import RIGID, Setup, Wall, box_walls, by_id, lost, packing, total
from engine.test_energy import energy
from laws.setups import LAWS, NAMES
from pestle.engine import step as st
from pestle.engine.engine import PairRule
from pestle.laws import Solid

QUICK = ("nan2022", "jkr")  # the others take a minute together: run with -m slow
SOLID = Solid(youngs_modulus=1e8, poisson_ratio=0.3, yield_stress=1e6, density=1500.0)
SIZE = 2e-4  # radius [m]


def bed(law, count=1000):
    """A loose, thrown packing above a floor, under a hundred times gravity."""
    place, size = packing(count, seed=3, radius=SIZE, spread=0.05, spacing=2.4)
    high = place.max(0) + 1.2 * SIZE
    rule = PairRule(sliding_friction=0.4, damping=0.2, work_of_adhesion=0.02)
    walls: tuple[Wall, ...] = box_walls(0.0, high, solid=1)
    speed = np.random.default_rng(4).normal(size=(count, 3)) * 0.05
    return Setup(
        law=law, position=place, radius=size, solids=(SOLID, RIGID), walls=walls,
        rules={(0, 0): rule, (0, 1): rule}, velocity=speed,
        gravity=(0.0, 0.0, -1000.0),
    )  # fmt: skip


def settle(law, until=3.5e-3):
    engine = bed(law).engine()
    first = energy(engine)
    while engine.time < until:
        assert engine.advance(1000) == st.RAN
    return engine, first


@pytest.fixture
def threads():
    before = numba.get_num_threads()
    yield numba.set_num_threads
    numba.set_num_threads(before)


@pytest.mark.parametrize(
    "name",
    [n if n in QUICK else pytest.param(n, marks=pytest.mark.slow) for n in NAMES],
)
def test_cohesive_settling(name, threads):
    threads(1)
    engine, first = settle(LAWS[name])
    spent = lost(engine)
    residual = total(engine) + spent - first - engine.sums[st.WALL_WORK]
    assert abs(residual) < 5e-4 * spent
    assert engine.sums[st.NEGATIVE] > -5e-4 * spent
    assert engine.lost_contacts == 0
    speed = np.sqrt((engine.vel[:, :3] ** 2).sum(axis=1)).mean()
    assert speed < 0.05, "the bed has come to rest"
    assert (
        by_id(engine, "pos")[:, 2].mean() < 0.9 * bed(LAWS[name]).position[:, 2].mean()
    )
    if numba.config.NUMBA_NUM_THREADS > 1:
        threads(2)
        again, _ = settle(LAWS[name])
        for field in ("pos", "vel", "hist", "whist", "sums"):
            assert getattr(engine, field).tobytes() == getattr(again, field).tobytes()
