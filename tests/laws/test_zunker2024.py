"""The engine's form of MDR, a step at a time, converges to the exact solution."""

from math import log2

import numpy as np
import pytest

from pestle.errors import EnergyWarning
from pestle.laws import Geometry, Pair, Solid, Zunker2024, parts_of
from pestle.particle import Particle, ParticleMaterial, follow

SOFTER = {"hardening_rise": 1.2, "hardening_decay": 3.0}
LOADED = [0.3, 0.2985]
PULLED = [0.2, 0.1984, 0.1962, 0.1946]


def forces(corners, step, adhesion, hardening):
    """Force of the law at the corners of a path between two flats; E = R = 1."""
    law = Zunker2024(psi_b=0.0, **hardening)
    solid = Solid(youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=1 / 200)
    pair = Pair(first=solid, second=Solid(), work_of_adhesion=adhesion, wall=True)
    parts, k, c = parts_of(law), law.constants(pair), law.particle_constants(solid)
    state = parts.state(*(0.0 for _ in parts.state._fields))
    radius, particle, here, found = 1.0, law.particle(1.0), 0.0, []
    for corner in corners:
        steps = np.linspace(here, corner, int(abs(corner - here) / step) + 2)[1:]
        for x in steps:
            g = Geometry(radius - 1.0 + x, radius, radius, 0.0, 1.0, 0.0)
            answer, state, added = parts.wall(k, g, state, particle)
            both = parts.sums(*(2.0 * value for value in added))
            radius, particle = parts.update(c, radius, particle, both)
        found.append(answer.force)
        here = corner
    return np.array(found)


def exact(corners, adhesion, hardening):
    """The same of the exact solver."""
    material = ParticleMaterial(
        youngs_modulus=1.0,
        poisson_ratio=0.3,
        yield_stress=1 / 200,
        work_of_adhesion=adhesion,
        **hardening,
    )
    states = follow(Particle(material, 1.0, counts=(2,)), [[x] for x in corners])
    return np.array([state.flats[0].force for state in states])


@pytest.mark.parametrize("hardening", [{}, SOFTER], ids=["published", "own"])
@pytest.mark.parametrize(
    ("corners", "adhesion"), [(LOADED, 0.0), (PULLED, 1 / 91000)], ids=["dry", "sticky"]
)
def test_is_of_first_order(corners, adhesion, hardening):
    want = exact(corners, adhesion, hardening)
    coarse, fine = (
        np.max(np.abs(forces(corners, step, adhesion, hardening) - want))
        for step in (4e-4, 1e-4)
    )
    assert fine < 12 * 1e-4 * np.max(want)
    assert log2(coarse / fine) / 2 == pytest.approx(1.0, abs=0.15)


def test_the_printed_rule_warns():
    with pytest.warns(EnergyWarning, match="eq37"):
        Zunker2024(radius_rule="eq37")
