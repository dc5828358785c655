"""Meshes against closed forms: cylinders of facets, convex edges, a turntable."""

import numpy as np
import pytest

from engine.setups import GLASS, by_id, run, total
from engine.test_mesh import FOREVER, NONE, both, box, engine_of, mesh_row, plate, throw
from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.engine.engine import PairRule
from pestle.engine.mesh import Surface

MODULUS = 4 / 3 * 1e8 / (1 - 0.25**2)  # 4/3 E* of glass on a rigid wall [Pa]


def tube(count, radius, height):
    """Hollow prism of `count` flat sides that touch the cylinder from outside."""
    t = 2.0 * np.pi * np.arange(count) / count
    far = radius / np.cos(np.pi / count)
    ring = np.column_stack([far * np.cos(t), far * np.sin(t)])
    low, high = (np.column_stack([ring, np.full(count, z)]) for z in (0.0, height))
    a, b = np.arange(count), (np.arange(count) + 1) % count
    faces = np.concatenate(
        [
            np.column_stack([a, b, b + count]),
            np.column_stack([a, b + count, a + count]),
        ]
    )
    return Surface(np.concatenate([low, high]), faces)


INSIDE = (1.0, 0, 0, 0, 0, 0, 1, 2.0, 0.0, 20.0, 1.0, 1.0)
ANGLE = np.linspace(0.1, 6.0, 12)
FAR = 1.51  # from the axis; the spheres of radius 0.5 overlap by 0.01


def forces_in(count):
    """Forces on spheres in a tube of so many facets; 0 for the analytic cylinder [N]."""
    above = 1.0 + 1.5 * np.arange(len(ANGLE))  # they must not touch each other
    place = np.column_stack([FAR * np.cos(ANGLE), FAR * np.sin(ANGLE), above])
    rows, surfaces = [INSIDE], {}
    if count:
        rows, surfaces = [mesh_row()], {0: tube(count, 2.0, 20.0)}
    engine = engine_of(place, 0.5, rows, surfaces)
    run(engine, 1)
    assert np.count_nonzero(engine.whist[:, 4]) == len(ANGLE)
    kick = by_id(engine, "vel")[:, :3] * by_id(engine, "vel")[:, 3:4]
    return kick / engine.clock[st.DT_LAST] * 2.0


def off_middle(count):
    """Angle of each sphere from the middle of the facet that it touches [rad]."""
    step = 2.0 * np.pi / count
    return (ANGLE / step - 0.5 - np.round(ANGLE / step - 0.5)) * step


@pytest.mark.parametrize("count", [60, 120, 240])
def test_a_tube_of_facets_is_a_cylinder_but_for_the_chord(count):
    """A facet at an angle t from the sphere is FAR (1 - cos t) farther than the arc.

    With that accounted for the force is exact; t is at most pi/count, so the error of
    the overlap falls with the square of the number of facets, that of the direction
    with the number.
    """
    t = off_middle(count)
    middle = ANGLE - t
    overlap = 0.5 - (2.0 - FAR * np.cos(t))
    assert (overlap > 0.0).all()
    size = MODULUS * np.sqrt(0.5) * overlap**1.5
    got, analytic = forces_in(count), forces_in(0)
    want = -size[:, None] * np.column_stack([np.cos(middle), np.sin(middle), 0 * t])
    np.testing.assert_allclose(got, want, atol=1e-9 * np.abs(want).max())
    chord = FAR * (1.0 - np.cos(np.pi / count))
    share = 1.0 - (1.0 - chord / 0.01) ** 1.5
    error = np.linalg.norm(got - analytic, axis=1) / np.linalg.norm(analytic, axis=1)
    assert error.max() <= share + np.pi / count


def test_the_analytic_cylinder():
    want = MODULUS * np.sqrt(0.5) * 0.01**1.5
    np.testing.assert_allclose(np.linalg.norm(forces_in(0), axis=1), want, rtol=1e-9)


@pytest.mark.parametrize("friction", [0.0, 50.0])
def test_over_a_convex_edge_with_the_energy_of_the_integrator(friction):
    """Off a box, sliding or rolling: what is lost falls with the step."""
    errors = []
    for step in (2e-3, 1e-3, 5e-4):
        rule = PairRule(sliding_friction=friction)
        engine = engine_of(
            [[0.8, 0.1, 1.99]], 1.0, [mesh_row()], {0: box(1.0, 2.0, 1.0)},
            gravity=2.0, step=step, rule=rule,
        )  # fmt: skip
        throw(engine, np.array([[1.0, 0.1, 0.0]]), np.array([[-0.1, 1.0, 0.0]]))
        run(engine, 2)
        before, worst, touched = total(engine), 0.0, 0
        while engine.time < 1.4:
            run(engine, 1)
            assert engine.sums[st.TOUCHING] <= 1
            touched += engine.sums[st.TOUCHING] * (engine.pos[0, 0] > 1.0)
            held = total(engine) + engine.sums[st.SLIDING]
            worst = max(worst, abs(held - before))
        assert touched > 10
        errors.append(worst / engine.sums[st.KINETIC])
    assert errors[0] < 1e-4
    assert errors[2] < 0.4 * errors[1] < 0.16 * errors[0]


@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_a_ball_rolls_in_circles_on_a_turntable(damping):
    """Without sliding its velocity turns at w = I/(I + m d^2), about 2/7, of the disc's.

    It may be off by: the tangential spring, which has to be stretched first and then
    beats with W^2 = k_t/m (1 + m d^2/I), so by w/W, or w^2/W^2 once the beat is damped;
    and by a force that lags by a step at most, w dt in direction, so by w^2 dt t in speed.
    """
    step, rate, d, speed = 1e-3, 2.0, 0.99, 0.5
    engine = engine_of(
        [[2.0, 0.0, 0.99]], 1.0, [mesh_row()], {0: plate(5, 6.0)}, step=step,
        rule=PairRule(sliding_friction=50.0, damping=damping),
    )  # fmt: skip
    mass = float(engine.vel[0, 3])
    engine.gravity[2] = -MODULUS * 0.01**1.5 / mass
    throw(
        engine,
        np.array([[speed, 0.0, 0.0]]),
        np.array([[2.0 * rate / d, speed / d, 0.0]]),
    )
    engine.set_motion(0, FOREVER, NONE, both(0.0, 0.0, rate))
    engine.body[0, wl.SPIN + 2] = rate  # the disc has turned before
    slow = 0.4 / (0.4 + d * d) * rate
    shear = 8.0 / ((2.0 - GLASS.poisson_ratio) / GLASS.shear_modulus)
    beat = np.sqrt(shear * 0.1 / mass * (1.0 + d * d / 0.4))
    while engine.time < 3.0:
        run(engine, 10)
        time = engine.time - 0.5 * step
        way = speed * np.array([np.cos(slow * time), np.sin(slow * time)])
        off = np.linalg.norm(engine.vel[0, :2] - way) / speed
        spring = slow / beat / np.sqrt(1.0 - (0.5 * beat * step) ** 2)
        if damping and time > 1.0:
            spring = (slow / beat) ** 2
        assert off < spring + slow**2 * step * time + slow * step
    assert engine.body[0, 0] == pytest.approx(
        np.cos(0.5 * rate * engine.time), abs=1e-9
    )
