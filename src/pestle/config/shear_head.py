"""Head or base of a shear cell as a closed triangle mesh, made from its measures."""

from math import cos, pi
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pestle.config.blade import cylinder

if TYPE_CHECKING:
    from pestle.config.geometry import ShearHead

Array = npt.NDArray[Any]

_ROUND = 96  # sides of the disc
_BOX = np.array(
    [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ]
)


def head_mesh(head: "ShearHead") -> tuple[Array, Array]:
    """Vertices from the middle of the disc's face [m] and triangles: disc and vanes.

    All are closed; the root of a vane is in the disc.
    """
    vertices, faces = cylinder(head.radius, head.thickness, _ROUND)
    parts, triangles = [vertices], [faces]
    inner, outer = 0.5 * head.hub, head.radius * cos(pi / _ROUND)
    for number in range(head.vanes):
        box, sides = _vane(head, inner, outer, 2.0 * pi * number / head.vanes)
        triangles.append(sides + sum(len(part) for part in parts))
        parts.append(box)
    vertices, faces = np.concatenate(parts), np.concatenate(triangles)
    if head.facing == "up":  # mirrored, so that the winding turns round
        return vertices * [1.0, 1.0, -1.0], faces[:, ::-1]
    return vertices, faces


def _vane(
    head: "ShearHead", inner: float, outer: float, angle: float
) -> tuple[Array, Array]:
    """One box from the hub to the rim, half a disc's thickness into it."""
    half = 0.5 * head.vane_thickness
    far = np.sqrt(outer**2 - half**2)
    ends = ((inner, far), (-half, half), (-head.vane_depth, 0.5 * head.thickness))
    corner = np.array([[x, y, z] for x in ends[0] for y in ends[1] for z in ends[2]])
    c, s = np.cos(angle), np.sin(angle)
    turned = corner @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return turned, np.concatenate([_BOX[:, [0, 1, 2]], _BOX[:, [0, 2, 3]]])
