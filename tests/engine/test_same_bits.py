"""Same bits: any number of threads, any cut into calls, a restart in the middle."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import pytest

from engine.setups import (
    GLASS,
    HARD,
    MDR,
    RIGID,
    SOFT,
    Setup,
    box_walls,
    by_id,
    packing,
    run,
)  # fmt: skip
from pestle.engine.engine import PairRule
from pestle.laws import Hertz

STATE = (
    "pos",
    "vel",
    "field",
    "ids",
    "pa",
    "pb",
    "hist",
    "whist",
    "total",
    "sums",
    "clock",
)


def bed(law, *, count=300, rolling=False, lengths=(0.0, 0.0, 0.0)):
    """Hundreds of moving particles in a box of walls, or periodic."""
    place, size = packing(count, seed=11)
    v, w = np.random.default_rng(6).normal(size=(2, count, 3))
    rule = PairRule(
        sliding_friction=0.4, damping=0.2, rolling_friction=0.02,
        work_of_adhesion=0.0 if isinstance(law, Hertz) else 1e4,
    )  # fmt: skip
    walls = (
        () if any(lengths) else box_walls(-0.1, place.max(0) + 1.0, speed=3.0, solid=2)
    )
    return Setup(
        law=law, solids=(SOFT, HARD, RIGID), particle_solids=2, position=place,
        radius=size, material=np.arange(count) % 2, velocity=6 * v, spin=5 * w,
        rules={(a, b): rule for a in (0, 1) for b in (0, 1, 2)}, walls=walls,
        skin=0.08, rolling=rolling, gravity=(0, 0, -9.81), lengths=lengths,
    )  # fmt: skip


BEDS = {
    "hertz": bed(Hertz()),
    "hertz rolling": bed(Hertz(), rolling=True),
    "mdr": bed(MDR),
}


def assert_same(one, two):
    for name in STATE:
        a, b = getattr(one, name), getattr(two, name)
        assert a.tobytes() == b.tobytes(), name


@pytest.fixture
def threads():
    before = numba.get_num_threads()
    yield numba.set_num_threads
    numba.set_num_threads(before)


@pytest.mark.parametrize("setup", BEDS.values(), ids=BEDS)
def test_threads(setup, threads):
    if numba.config.NUMBA_NUM_THREADS < 2:
        pytest.skip("one core")
    engines = []
    for number in (1, 2):
        threads(number)
        engines.append(run(setup.engine(), 500))
    assert engines[0].rebuilds > 5
    assert_same(*engines)


@pytest.mark.parametrize("setup", BEDS.values(), ids=BEDS)
def test_calls_of_any_length(setup):
    """One call, or calls of 1, 2, 3, ... steps."""
    one, two = setup.engine(), setup.engine()
    run(one, 300)
    for steps in range(1, 25):
        run(two, steps)
    assert one.steps == two.steps == 300
    assert_same(one, two)


@pytest.mark.parametrize("setup", BEDS.values(), ids=BEDS)
@pytest.mark.parametrize("when", [1, 137, 250])
def test_checkpoint(setup, when):
    """A fresh engine that takes over a saved state goes on as if nothing had happened."""
    one = run(setup.engine(), when)
    saved = {name: np.array(value) for name, value in one.saved().items()}
    run(one, 300)
    two = setup.engine()
    two.restore(saved)
    run(two, 300)
    assert_same(one, two)
    assert (one.rebuilds, one.since_rebuild) == (two.rebuilds, two.since_rebuild)


def test_checkpoint_is_a_copy_once_restored():
    """Running on does not change the state that was restored from."""
    one = run(BEDS["mdr"].engine(), 50)
    saved = {name: np.array(value) for name, value in one.saved().items()}
    first = {name: value.copy() for name, value in saved.items()}
    one.restore(saved)
    run(one, 100)
    for name, value in first.items():
        assert saved[name].tobytes() == value.tobytes(), name


SMALL = {"hertz": (Hertz(), 8), "mdr": (MDR, 6)}


def small(name):
    """State after a few dozen steps, as lists."""
    law, count = SMALL[name]
    setup = bed(law, count=count).but(step=2e-4)
    engine = run(setup.engine(), 40)
    return {
        name: by_id(engine, name).tolist() for name in ("pos", "vel")
    } | {"sums": engine.sums[:8].tolist()}  # fmt: skip


@pytest.mark.parametrize("name", SMALL)
def test_compiled_is_plain_python(name):
    """NUMBA_DISABLE_JIT=1 gives the same up to the fusing of products and sums."""
    code = f"import json; from engine.test_same_bits import small; print(json.dumps(small({name!r})))"
    tests = str(Path(__file__).parents[1])
    path = os.pathsep.join([tests, *filter(None, [os.environ.get("PYTHONPATH")])])
    plain = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True,
        env=os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": path}, timeout=120,
    )  # fmt: skip
    for key, value in json.loads(plain.stdout).items():
        ours = np.array(small(name)[key])
        np.testing.assert_allclose(
            value, ours, rtol=1e-9, atol=1e-11 * np.abs(ours).max()
        )


def test_periodic_bed_on_two_threads(threads):
    setup = bed(Hertz(), count=216, lengths=(11.4, 11.4, 11.4))
    setup = setup.but(
        gravity=(0.0, 0.0, 0.0), rate=(-0.2, 0.1, 0.0), solids=(GLASS, HARD, RIGID)
    )
    engines = []
    for number in (1, min(2, numba.config.NUMBA_NUM_THREADS)):
        threads(number)
        engines.append(run(setup.engine(), 300))
    assert engines[0].rebuilds > 2
    assert_same(*engines)
