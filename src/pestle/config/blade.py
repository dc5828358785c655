"""The blade of a powder rheometer as a closed triangle mesh, made from its measures."""

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from pestle.config.geometry import BladeWall

Array = npt.NDArray[Any]

_ACROSS = 6  # pieces of the chord
_ROUND = 32  # sides of the shaft


def blade_mesh(blade: "BladeWall") -> tuple[Array, Array]:
    """Vertices from the middle of the blade [m] and triangles: the wings and the shaft.

    Both are closed; the foot of the shaft is in the wings.
    """
    wings, faces = _wings(blade)
    shaft, round_ = cylinder(0.5 * blade.shaft_diameter, blade.shaft_height)
    return np.concatenate([wings, shaft]), np.concatenate([faces, round_ + len(wings)])


def _wings(blade: "BladeWall") -> tuple[Array, Array]:
    """One strip from tip to tip; its ends lie on the cylinder of the tips' path."""
    tip, hub = 0.5 * blade.diameter, 0.5 * blade.shaft_diameter
    share = np.linspace(-1.0, 1.0, 2 * blade.segments + 1)[:, None]
    turned = np.maximum(np.abs(share) * tip - hub, 0.0) / (tip - hub)
    lean = 0.5 * pi - (0.5 * pi - blade.tip_angle) * turned
    chord = np.linspace(-0.5, 0.5, _ACROSS + 1) * blade.chord
    along = np.concatenate([chord, chord[::-1]])[None, :]  # round the section
    across = np.repeat([-0.5, 0.5], _ACROSS + 1)[None, :] * blade.thickness
    forward = along * np.cos(lean) - across * np.sin(lean)
    up = along * np.sin(lean) + across * np.cos(lean)
    side = np.where(share < 0.0, -1.0, 1.0)
    x = share * np.sqrt(tip**2 - forward**2)
    vertices = np.stack([x, side * forward, up + 0.0 * x], axis=2)
    # the far half is the near one turned half round: its faces change places
    vertices[share[:, 0] < 0.0] = vertices[share[:, 0] < 0.0][:, ::-1]
    around = 2 * (_ACROSS + 1)
    number = np.arange(len(share) * around).reshape(len(share), around)
    a, b = number[:-1], number[1:]
    c, d = np.roll(b, -1, axis=1), np.roll(a, -1, axis=1)
    faces = [
        np.stack([a, c, b], 2).reshape(-1, 3),
        np.stack([a, d, c], 2).reshape(-1, 3),
    ]
    for ring in (number[0][::-1], number[-1]):
        front, back = ring[: _ACROSS + 1], ring[_ACROSS + 1 :][::-1]
        faces.append(np.column_stack([front[:-1], front[1:], back[1:]]))
        faces.append(np.column_stack([front[:-1], back[1:], back[:-1]]))
    return vertices.reshape(-1, 3), np.concatenate(faces)


def cylinder(radius: float, height: float, sides: int = _ROUND) -> tuple[Array, Array]:
    """Vertices from the middle of the lower end [m] and triangles of a closed prism."""
    angle = 2.0 * pi * np.arange(sides) / sides
    ring = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    low, high = (np.column_stack([ring, np.full(sides, z)]) for z in (0.0, height))
    ends = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, height]])
    a = np.arange(sides)
    b = np.roll(a, -1)
    n = 2 * sides
    faces = (
        (a, b, b + sides),
        (a, b + sides, a + sides),
        (b, a, np.full(sides, n)),
        (a + sides, b + sides, np.full(sides, n + 1)),
    )
    return (
        np.concatenate([low, high, ends]),
        np.concatenate([np.column_stack(f) for f in faces]),
    )
