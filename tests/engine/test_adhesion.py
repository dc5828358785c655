"""Elastic adhesive MDR against JKR: W R*, E* and nothing else decide.

The flat of every side is an ellipse, JKR a parabola: they differ by O(a^2/R^2), small
here because E* R* / W is large.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from engine.setups import pair, press
from pestle.laws import Solid
from pestle.reference import jkr

W = 2.0
ELASTIC = Solid(youngs_modulus=2e6 * W, poisson_ratio=0.3)
OTHER = Solid(youngs_modulus=5e6 * W, poisson_ratio=0.2)


def star(radius, solids):
    """R*, E* of a pair or of one sphere on a rigid wall."""
    compliance = sum(solids[n % len(solids)].compliance for n in range(len(radius)))
    return 1 / sum(1 / r for r in radius), 1 / compliance


def separate(radius, solids=(ELASTIC,), *, depth=2.0, steps=2000):
    """Press and pull, lengths in units of the JKR length; returns both legs."""
    r, e = star(radius, solids)
    unit = (np.pi**2 * W**2 * r / e**2) ** (1 / 3)
    engine = pair(radius, solids=solids, work_of_adhesion=W).engine()
    press(engine, depth * unit, steps)
    back = press(engine, -(depth + 1.0) * unit, 2 * steps)
    return back, r, e, unit


RADII = [(1.0,), (1.0, 1.0), (1.0, 0.5), (0.3, 1.5)]


@pytest.mark.parametrize("radius", RADII)
@pytest.mark.parametrize("solids", [(ELASTIC,), (ELASTIC, OTHER)])
def test_pull_off_force(radius, solids):
    """-1.5 pi W R*: between walls, equal and unequal spheres, equal and unequal solids."""
    back, r, _, _ = separate(radius, solids)
    assert back[:, 1].min() == pytest.approx(
        jkr.pull_off(r, work_of_adhesion=W), rel=3e-4
    )


def branch(overlaps, r, e):
    """JKR forces at given overlaps, on the branch that reaches pull-off."""
    k = {"modulus": e, "work_of_adhesion": W}
    least = jkr.critical_radius(r, **k, control="displacement")
    roots = [
        brentq(lambda a, d=d: jkr.overlap(a, r, **k) - d, least, r) for d in overlaps
    ]
    return np.array([jkr.force(a, r, **k) for a in roots])


@pytest.mark.parametrize("radius", [(1.0,), (1.0, 1.0)])
def test_force_under_slow_separation(radius):
    back, r, e, unit = separate(radius)
    # from where the rim begins to peel to where JKR ends
    peels = (back[:, 0] < 0.25 * unit) & (back[:, 0] > -0.745 * unit)
    want = branch(back[peels, 0], r, e)
    np.testing.assert_allclose(back[peels, 1], want, atol=3e-4 * np.abs(want).max())


@pytest.mark.parametrize("radius", [(1.0,), (1.0, 1.0)])
def test_separation_displacement(radius):
    """JKR under displacement control lets go at -3/4 (pi^2 W^2 R*/E*^2)^(1/3)."""
    back, _, _, unit = separate(radius)
    last = back[np.flatnonzero(back[:, 1])[-1], 0]
    assert last / unit == pytest.approx(-0.75, abs=2e-3)
    assert back[-1, 1] == 0.0


@pytest.mark.parametrize("radius", [(1.0,), (1.0, 1.0)])
def test_peeling_costs_the_work_of_adhesion(radius):
    """Approach is Hertz, so a cycle takes W for the area peeled, and the last jump."""
    back, r, e, _unit = separate(radius)
    k = {"modulus": e, "work_of_adhesion": W}
    a = jkr.critical_radius(r, **k, control="displacement")
    lift = a**2 / r - jkr.overlap(a, r, **k)
    held = 8 / 15 * e * a**5 / r**2 - 4 / 3 * e * a**3 / r * lift + e * a * lift**2
    want = W * np.pi * (r * back[0, 0] - a**2) + held
    assert back[-1, 3] == pytest.approx(want, rel=5e-4)


def test_no_pull_before_the_first_touch():
    engine = pair((1.0, 1.0), solids=(ELASTIC,), work_of_adhesion=W, gap=1e-3).engine()
    assert not press(engine, 0.9e-3, 10)[:, 1].any()
