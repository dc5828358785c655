"""Walls of triangles: as planes and cylinders, across edges, moved, balanced, same bits."""

from dataclasses import replace

import numba
import numpy as np
import pytest

from engine.setups import GLASS, RIGID, by_id, lost, packing, run, total
from engine.test_same_bits import STATE
from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.engine.engine import Engine, PairRule
from pestle.engine.mesh import Surface
from pestle.laws import JKR, Hertz

NONE = np.zeros((2, 3))
FOREVER = np.array([0.0, 1e9])


def both(*vector):
    """The same vector at the start and at the end of a motion."""
    return np.array([vector, vector])


def plate(count, size):
    """Flat square of 2 count^2 triangles, diagonals this way and that."""
    grid = np.linspace(-size, size, count + 1)
    x, y = (g.ravel() for g in np.meshgrid(grid, grid, indexing="ij"))
    faces = []
    for i in range(count):
        for j in range(count):
            a = i * (count + 1) + j
            b, d = a + count + 1, a + 1
            two = (
                [[a, b, b + 1], [a, b + 1, d]]
                if (i + j) % 2
                else [[a, b, d], [b, b + 1, d]]
            )
            faces += two
    return Surface(np.column_stack([x, y, np.zeros_like(x)]), np.array(faces))


def box(*half):
    """Closed box around the origin with these half edges."""
    corner = np.array(np.unravel_index(np.arange(8), (2, 2, 2))).T * 2.0 - 1.0
    quads = [
        (0, 1, 3, 2),
        (4, 6, 7, 5),
        (0, 4, 5, 1),
        (2, 3, 7, 6),
        (0, 2, 6, 4),
        (1, 5, 7, 3),
    ]
    faces = [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))]
    return Surface(corner * half, np.array(faces))


def mesh_row(point=(0.0, 0.0, 0.0), material=1.0):
    return (wl.MESH, *point, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, material)


def drive(axis=(0.0, 0.0, 1.0)):
    return (*axis, *[0.0] * (wl.MOVE - 3))


def engine_of(
    place, size, rows, surfaces, *, law=None, rule=None, gravity=0.0, skin=0.05,
    density=2500.0, step=None,
):  # fmt: skip
    rule = rule or PairRule()
    engine = Engine(
        law=law or Hertz(), solids=[replace(GLASS, density=density), RIGID],
        rules={(0, 0): rule, (0, 1): rule}, gravity=np.array([0.0, 0.0, -gravity]),
        skin=skin,
    )  # fmt: skip
    engine.set_walls(rows, [drive() for _ in rows], surfaces)
    if step is not None:
        engine.clock[st.AUTO] = 0.0
        engine.clock[st.DT] = engine.clock[st.DT_MAX] = step
    place = np.atleast_2d(place).astype(float)
    count = len(place)
    engine.set_particles(
        place, np.full(count, size), np.zeros(count, int), np.full(count, density)
    )
    return engine


def throw(engine, velocity, spin):
    order = engine.ids - 1
    engine.vel[:, :3], engine.vel[:, 4:7] = velocity[order], spin[order]


@pytest.mark.parametrize(
    ("law", "adhesion", "height"), [(Hertz(), 0.0, 1.02), (JKR(), 30.0, 0.999)]
)
def test_a_plate_is_a_plane(law, adhesion, height):
    """Impact, sliding, spinning and pull-off over hundreds of edges."""
    rule = PairRule(sliding_friction=0.4, damping=0.2, work_of_adhesion=adhesion)
    random = np.random.default_rng(2)
    place = np.column_stack(
        [np.linspace(-8, 8, 5), random.uniform(-3, 3, 5), [height] * 5]
    )
    velocity = np.column_stack([3 * random.normal(size=(5, 2)), [-1.0] * 5])
    spin = 3 * random.normal(size=(5, 3))
    plane = (0.0, *mesh_row()[1:])
    engines = []
    for row, surfaces in ((plane, {}), (mesh_row(), {0: plate(23, 20.0)})):
        engine = engine_of(
            place, 1.0, [row], surfaces, law=law, rule=rule, gravity=9.81
        )
        throw(engine, velocity, spin)
        engines.append(run(engine, 2000))
    one, two = engines
    assert np.abs(one.sums[st.SLIDING]) > 0.0
    for name in ("pos", "vel"):
        np.testing.assert_allclose(by_id(one, name), by_id(two, name), rtol=1e-10)
    np.testing.assert_allclose(one.sums, two.sums, rtol=1e-10)
    np.testing.assert_allclose(one.total, two.total, rtol=1e-10, atol=1e-9)


def test_rolling_over_coplanar_edges_keeps_the_energy():
    engine = engine_of([[-8.0, 0.3, 0.9]], 1.0, [mesh_row()], {0: plate(16, 10.0)})
    weight = 4 / 3 * 1e8 / (1 - 0.25**2) * 0.1**1.5
    engine.gravity[2] = -weight / engine.vel[0, 3]  # at rest on the plate
    rule = PairRule(sliding_friction=0.5)
    engine.rules = {(0, 1): rule}
    engine.table = engine._pair_table()
    throw(engine, np.array([[9.0, 2.0, 0.0]]), np.array([[-2.0, 9.0, 0.0]]) / 0.9)
    run(engine, 10)
    before = total(engine)
    energies = []
    while engine.pos[0, 0] < 8.0:
        run(engine, 20)
        energies.append(total(engine))
    assert len(energies) > 20
    assert engine.sums[st.TOUCHING] == 1
    moving = float(engine.sums[st.KINETIC])
    assert np.abs(np.array(energies) - before).max() < 1e-9 * moving


def test_a_convex_edge_is_one_contact_and_keeps_the_energy():
    """Rolling off a box without friction; the error falls with the square of the step."""
    errors = []
    for step in (2e-3, 1e-3):
        engine = engine_of(
            [[0.8, 0.1, 1.99]], 1.0, [mesh_row()], {0: box(1.0, 2.0, 1.0)},
            gravity=2.0, step=step,
        )  # fmt: skip
        throw(engine, np.array([[1.0, 0.1, 0.0]]), np.zeros((1, 3)))
        run(engine, 2)
        before, worst, touched = total(engine), 0.0, 0
        while engine.time < 1.4:
            run(engine, 1)
            assert engine.sums[st.TOUCHING] <= 1
            touched += engine.sums[st.TOUCHING] * (engine.pos[0, 0] > 1.0)
            worst = max(worst, abs(total(engine) - before))
        assert touched > 10
        errors.append(worst / engine.sums[st.KINETIC])
    assert errors[0] < 1e-3
    assert errors[1] < 0.4 * errors[0]


@pytest.mark.parametrize("point", [(1.0, 1.0, 1.0), (1.0, 1.0, 0.2), (0.4, 0.2, 1.0)])
def test_vertex_edge_and_face_push_along_the_shortest_way(point):
    way = np.array([c if c == 1.0 else 0.0 for c in point])
    way /= np.linalg.norm(way)
    engine = engine_of(
        np.array(point) + 0.97 * way, 1.0, [mesh_row()], {0: box(1, 1, 1)}
    )
    run(engine, 1)
    force = engine.total[0, :3]
    assert engine.sums[st.TOUCHING] == 1
    weight = 4 / 3 * 1e8 / (1 - 0.25**2) * 0.03**1.5
    np.testing.assert_allclose(force, weight * way, rtol=1e-10, atol=1e-6)


def test_faces_of_a_sharp_corner_act_each():
    engine = engine_of([[0.99, 0.98, 0.97]], 1.0, [mesh_row()], {0: box(9, 9, 9)})
    engine.wall[0, 1:4] = 9.0
    engine.rebuild()
    run(engine, 1)
    modulus = 4 / 3 * 1e8 / (1 - 0.25**2)
    assert engine.sums[st.TOUCHING] == 3
    np.testing.assert_allclose(
        engine.total[0, :3], modulus * np.array([0.01, 0.02, 0.03]) ** 1.5, rtol=1e-10
    )


def test_a_particle_on_the_axis_of_a_cylinder():
    for axis in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.6, 0.8, 0.0)):
        row = (1.0, 0, 0, 0, *axis, 2.0, -1.0, 1.0, 1.0, 1.0)
        gap = wl.towards_wall(0.0, 0.0, 0.0, np.array([row]), 0)
        assert np.linalg.norm(gap) == pytest.approx(2.0)
        assert np.dot(gap, axis) == pytest.approx(0.0, abs=1e-12)
        engine = engine_of([[0.0, 0.0, 0.0]], 0.5, [row], {})
        run(engine, 10)
        assert np.isfinite(engine.pos).all()


def test_torque_on_the_particles_is_the_change_of_their_angular_momentum():
    random = np.random.default_rng(4)
    place = np.array(
        [[2.0, 2.0, 1.98], [-2.0, 1.0, 1.97], [1.0, -3.0, 1.99], [3.96, -1.0, 0.3]]
    )
    rule = PairRule(sliding_friction=0.4, damping=0.3)
    engine = engine_of(
        place, 1.0, [mesh_row()], {0: box(3.0, 4.0, 1.0)}, rule=rule, step=1e-4
    )
    velocity, spin = random.normal(size=(2, 4, 3))
    throw(engine, velocity, spin)
    engine.set_motion(0, FOREVER, both(0.3, 0.1, -0.2), both(0.2, -0.5, 0.7))
    run(engine, 20)
    assert engine.sums[st.TOUCHING] == 4
    for _ in range(5):
        x, before, centre = (
            engine.pos[:, :3].copy(),
            engine.vel.copy(),
            engine.wall[0, 1:4].copy(),
        )
        run(engine, 1)
        kick, change = 1e-4, engine.vel - before
        linear = before[:, 3:4] * change[:, :3]
        gain = np.cross(x - centre, linear) + before[:, 7:] * change[:, 4:7]
        np.testing.assert_allclose(gain.sum(0) / kick, engine.total[0, 5:8], rtol=1e-9)
        np.testing.assert_allclose(linear.sum(0) / kick, engine.total[0, :3], rtol=1e-9)


def stirred(**options):
    """A bed in a box of planes with a paddle that sinks and turns in it."""
    place, _ = packing(216, seed=5)
    place = place - [5.7, 5.7, 0.0]
    rule = PairRule(sliding_friction=0.4, damping=0.3)
    rows = [
        (0.0, 0, 0, -0.2, 0, 0, 1, 0, 0, 0, 1.0, 1),
        (1.0, 0, 0, 0, 0, 0, 1, 9.0, -1.0, 50.0, 1.0, 1),
        mesh_row((0.0, 0.0, 11.0)),
    ]
    engine = engine_of(
        place, 0.9, rows, {2: box(6.0, 0.8, 1.5)}, rule=rule, gravity=9.81, **options
    )
    times = np.array([0.0, 0.5, 1e9])
    engine.set_motion(
        2, times, np.array([[0, 0, 0], [0, 0, -6.0], [0, 0, -6.0]]),
        np.array([[0, 0, 0], [0.1, 0, 3.0], [0.1, 0, 3.0]]),
    )  # fmt: skip
    return engine


MORE = (*STATE, "body", "gap", "mlisted")


def assert_same(one, two):
    for name in MORE:
        assert getattr(one, name).tobytes() == getattr(two, name).tobytes(), name


def test_a_moving_mesh_gives_the_same_bits_on_two_threads_and_restarted():
    before = numba.get_num_threads()
    engines = []
    for number in (1, min(2, numba.config.NUMBA_NUM_THREADS)):
        numba.set_num_threads(number)
        engines.append(run(stirred(), 3000))
    numba.set_num_threads(before)
    assert engines[0].total[2, :3].any()
    assert engines[0].rebuilds > 5
    assert_same(*engines)
    third = run(stirred(), 2741)
    saved = {name: np.array(value) for name, value in third.saved().items()}
    third = stirred()
    third.restore(saved)
    assert_same(engines[0], run(third, 259))


def test_the_ledger_closes_over_a_stirred_bed():
    """What the paddle gives is found again; the rest falls with the step."""
    engine = stirred()
    engine.start()
    m, z = engine.vel[:, 3], engine.pos[:, 2]
    given = float(9.81 * np.sum(m * z)) + float(engine.sums[st.STORED])
    run(engine, 8000)
    work = float(engine.sums[st.WALL_WORK])
    assert work > 0.02 * lost(engine)
    gap = given + work - total(engine) - lost(engine)
    assert abs(gap) < 2e-3 * lost(engine)


def test_the_work_of_each_wall_adds_up():
    engine = run(stirred(), 3000)
    work = engine.total[:, wl.WORK]
    assert work[2] != 0.0
    assert work.sum() == pytest.approx(engine.sums[st.WALL_WORK], rel=1e-12)


def test_particles_taken_away_leave_the_others_as_they_were():
    engine = run(stirred(), 3000)
    wanted = engine.pos[:, 2] < 9.0
    before = {
        name: getattr(engine, name)[wanted].copy() for name in ("ids", "pos", "vel")
    }
    touching = {
        (int(engine.ids[a]), int(engine.ids[b])): engine.hist[s].copy()
        for s, (a, b) in enumerate(zip(engine.pa, engine.pb, strict=True))
        if engine.flag[s] & 1 and wanted[a] and wanted[b]
    }
    assert 0 < wanted.sum() < len(wanted)
    assert touching
    engine.keep(wanted)
    order, then = np.argsort(engine.ids), np.argsort(before["ids"])
    for name, values in before.items():
        assert (getattr(engine, name)[order] == values[then]).all()
    now = {
        (int(engine.ids[a]), int(engine.ids[b])): engine.hist[s]
        for s, (a, b) in enumerate(zip(engine.pa, engine.pb, strict=True))
        if engine.flag[s] & 1
    }
    assert now.keys() == touching.keys()
    assert all((now[pair] == touching[pair]).all() for pair in now)
    run(engine, 100)
