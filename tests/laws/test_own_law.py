"""A user's own law, defined here, passed as an object and through an entry point."""

import sys
from dataclasses import dataclass, field
from types import ModuleType
from typing import ClassVar, NamedTuple

import numpy as np
import pytest

from engine.setups import Setup, by_id
from pestle import laws, testing
from pestle.engine import step as st
from pestle.engine.engine import PairRule
from pestle.laws import Geometry, Pair, Response, Solid, _base


class Constants(NamedTuple):
    stiffness: float  # [N/m]


class Peak(NamedTuple):
    peak: float  # [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Spring:
    """A linear spring."""

    stiffness: float = field(metadata={"help": "k [N/m]", "unit": "N/m"})
    name: ClassVar[str] = "spring"
    summary: ClassVar[str] = "linear spring"
    linear: ClassVar[bool] = True

    def constants(self, pair: Pair) -> Constants:
        return Constants(self.stiffness)


def contact(k, g: Geometry, s):
    x = max(g.overlap, 0.0)
    on = k.stiffness if g.overlap > 0.0 else 0.0
    return Response(on * x, 0.0, on, 0.5 * on * x * x, 1.0), s


@pytest.fixture(autouse=True)
def registered():
    before = dict(_base._REGISTRY)
    laws.register(Spring, constants=Constants, state=laws.Nothing, contact=contact)
    yield
    _base._REGISTRY.clear()
    _base._REGISTRY.update(before)


def test_it_keeps_the_contract():
    testing.check_law(Spring(stiffness=1e3))


def test_a_law_that_creates_energy_is_found():
    def softer_back(k, g, s):
        r, _ = contact(k, g, s)
        force = r.force * (1.2 if g.overlap < s.peak else 1.0)
        answer = Response(force, r.radius, r.stiffness, r.stored, r.damping)
        return answer, Peak(max(s.peak, g.overlap))

    laws.register(Spring, constants=Constants, state=Peak, contact=softer_back)
    with pytest.raises(AssertionError, match="energy from nothing"):
        testing.check_law(Spring(stiffness=1e3))


def test_it_runs_in_the_engine():
    """Half a period of a linear oscillator, and the restitution of its dashpot."""
    k, m, damping = 1e3, 4 / 3 * np.pi * 1e-9 * 1500.0, 0.2
    solid = Solid(youngs_modulus=1e8, poisson_ratio=0.3, density=1500.0)
    setup = Setup(
        law=Spring(stiffness=k), solids=(solid, Solid()), radius=np.full(2, 1e-3),
        position=np.array([[0.0, 0.0, 0.0], [2e-3, 0.0, 0.0]]),
        velocity=[[0.1, 0.0, 0.0], [-0.1, 0.0, 0.0]],
        rules={(0, 0): PairRule(damping=damping)}, step=2e-7,
    )  # fmt: skip
    engine = setup.engine()
    time = np.pi * np.sqrt(m / 2 / k)
    assert engine.advance(int(1.2 * time / 2e-7)) == st.RAN
    left, right = by_id(engine, "vel")[:, 0]
    ratio = damping / 2
    want = np.exp(-np.pi * ratio / np.sqrt(1 - ratio**2))
    assert right - left == pytest.approx(0.2 * want, rel=0.01)


def test_it_is_found_by_an_entry_point(monkeypatch):
    """A package announces the module; loading it registers the law."""
    _base._REGISTRY.pop("spring")
    module = ModuleType("their_spring")
    monkeypatch.setitem(sys.modules, "their_spring", module)

    class Point:
        def load(self):
            laws.register(
                Spring, constants=Constants, state=laws.Nothing, contact=contact
            )
            return module

    for point in [Point()]:  # what pestle.laws does with each of the group
        point.load()
    assert laws.get("spring") is Spring
    assert "spring" in laws.names()
