"""A body that comes in must not lie in the powder: who overlaps it, and how deep."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pestle import _jit
from pestle.engine import walls as wl
from pestle.engine.wall_lists import closest, to_body
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.simulation.runner import Runner

Array = npt.NDArray[Any]

TOUCH = 0.01
"""Overlap with a body that comes in, over the radius, that passes as a touch [-]."""


def come_in(run: "Runner", w: int) -> None:
    """Bring a body in, if it is absent so far; it may touch particles, no more."""
    engine = run.engine
    if engine.wall[w, wl.ACTIVE] > 0.0:
        return
    engine.wall[w, wl.ACTIVE] = 1.0
    engine.rebuild()
    name = run.walls[w]
    depth = overlaps(engine, w)
    depth[enclosed(engine, w, *run.case.surface(name))] = 1.0
    bad = np.flatnonzero(depth > TOUCH)
    if len(bad):
        worst = int(bad[np.argmax(depth[bad])])
        raise InputError(
            "body-in-powder",
            f'the body "{name}" comes in where particles are: {len(bad)} overlap it, '
            f"particle {engine.ids[worst]} by {100 * min(depth[worst], 1.0):.3g} % of "
            "its radius",
            f"process.{run.case.process[run.stage].place(run.stage)}.wall",
            f"let walls.{name}.point lie clear of the powder, or give the body from "
            "the start with absent = false",
        )


def overlaps(engine: Any, w: int) -> Array:
    """Overlap of each particle with the surface of a mesh over its radius [-]."""
    nearest = np.full(len(engine.pos), np.inf)
    _nearest(
        engine.pos, engine.wall, engine.body, engine.mesh, engine.wp, engine.ww,
        engine.slot, engine.mfirst, engine.mlisted, w, nearest,
    )  # fmt: skip
    depth: Array = 1.0 - nearest / engine.pos[:, 3]
    return depth


@_jit.njit
def _nearest(
    pos: Any, wall: Any, body: Any, mesh: Any, wp: Any, ww: Any, slot: Any, first: Any,
    listed: Any, w: int, nearest: Any,
) -> None:  # fmt: skip
    """Distance of each centre to the listed triangles of a mesh [m]."""
    for k in range(slot.shape[0]):
        i = wp[slot[k]]
        if ww[slot[k]] != w:
            continue
        x, y, z = to_body(pos, i, wall, body, w)
        for e in range(first[k], first[k + 1]):
            a, b, c, _ = closest(x, y, z, mesh.face, listed[e])
            nearest[i] = min(nearest[i], np.sqrt(a * a + b * b + c * c))


def enclosed(engine: Any, w: int, vertices: Array, faces: Array) -> Array:
    """Whether each centre lies in a closed mesh: its triangles fill the sphere of view.

    The solid angles add up to a multiple of 4 pi inside and to zero outside, to
    something between for a sheet with a rim, which encloses nothing.
    """
    turn = engine.body[w, wl.TURN : wl.TURN + 9].reshape(3, 3)
    place = (engine.pos[:, :3] - engine.wall[w, wl.POINT : wl.POINT + 3]) @ turn
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    inside = np.zeros(len(place), bool)
    for i in np.flatnonzero(np.all((place > low) & (place < high), axis=1)):
        a, b, c = (vertices[faces[:, k]] - place[i] for k in range(3))
        p, q, r = (np.linalg.norm(v, axis=1) for v in (a, b, c))
        across = np.sum(a * np.cross(b, c), axis=1)
        along = p * q * r + np.sum(a * b, axis=1) * r
        along += np.sum(b * c, axis=1) * p + np.sum(c * a, axis=1) * q
        turns = np.sum(np.arctan2(across, along)) / (2.0 * np.pi)
        inside[i] = abs(turns) > 0.5 and abs(turns - round(turns)) < 1e-6
    return inside
