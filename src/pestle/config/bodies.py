"""Walls that are bodies of triangles: their surfaces, from a file or from measures."""

import hashlib
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.config.geometry import BladeWall, MeshWall, ShearHead
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.config.case import Case

# size of a body over the largest radius [-]; 10^8 particles side by side are 930 wide
_SMALLEST, _LARGEST = 1.0, 5e3


def surface_of(case: "Case", name: str) -> tuple[Any, Any]:
    """Vertices from the body's point [m] and triangles of a wall."""
    wall = case.walls[name]
    if isinstance(wall, BladeWall):
        from pestle.config.blade import blade_mesh

        return blade_mesh(wall)
    if isinstance(wall, ShearHead):
        from pestle.config.shear_head import head_mesh

        return head_mesh(wall)
    assert isinstance(wall, MeshWall)
    from pestle.config.mesh_file import read_mesh

    vertices, faces = read_mesh(case.resolve(wall.file), wall.unit, is_open=wall.open)
    size = float(np.ptp(vertices, axis=0).max())
    largest = max((g.radius.maximum for g in case.particles if g.radius), default=0.0)
    if largest and not _SMALLEST * largest <= size <= _LARGEST * largest:
        raise InputError(
            "mesh-size",
            f'the mesh of the wall "{name}" is {size:.3g} m large, the radius of the '
            f"largest particle {largest:.3g} m",
            f"walls.{name}.unit",
            "unit is the length of one unit of the file, often 1 mm",
        )
    return vertices, faces


def mesh_hash(case: "Case") -> dict[str, str]:
    """SHA-256 of each mesh file, by the name of its wall."""
    found = {}
    for name, wall in case.walls.items():
        if isinstance(wall, MeshWall):
            path = case.resolve(wall.file)
            try:
                with path.open("rb") as file:
                    found[name] = hashlib.file_digest(file, "sha256").hexdigest()
            except OSError as error:
                what = f"{path} cannot be read: {error.strerror}"
                raise InputError("unreadable", what, f"walls.{name}.file") from None
    return found
