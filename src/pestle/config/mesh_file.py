"""Read a triangle mesh: STL, PLY or OBJ as data, bounded, checked, repaired as stated.

Repaired in silence, for it changes no shape: vertices that coincide become one, and
triangles that are there twice or whose corners coincide are left out.  The winding of
the triangles is not used.  Anything else that is broken is an error.
"""

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from pestle.errors import InputError

Array = npt.NDArray[Any]

LARGEST_MESH = 200_000_000
"""Largest mesh file [bytes]."""

MOST_TRIANGLES = 2_000_000
"""Largest number of triangles in a mesh [-]."""

KINDS = (".stl", ".ply", ".obj")

_EQUAL = 1e-9  # distance of vertices that are one, over the size of the mesh [-]
_FLAT = 1e-9  # height of a triangle without area, over its longest edge [-]


def read_mesh(path: Path, unit: float, *, is_open: bool) -> tuple[Array, Array]:
    """Read vertices [m] and triangles of a mesh.

    Parameters
    ----------
    path : Path
        STL, PLY or OBJ file.
    unit : float
        Length of one unit of the file [m].
    is_open : bool
        Whether the surface may have a rim, an edge of one triangle only.
    """
    vertices, faces = _load(path)
    if len(faces) > MOST_TRIANGLES:
        what = f"{path} has {len(faces)} triangles, more than {MOST_TRIANGLES}"
        raise InputError("mesh-too-large", what, str(path), "make the mesh coarser")
    return checked(vertices * unit, faces, str(path), is_open=is_open)


def _load(path: Path) -> tuple[Array, Array]:
    kind = path.suffix.lower()
    if kind not in KINDS:
        raise InputError(
            "mesh-format",
            f"{path} is not a mesh of a known format",
            str(path),
            f"use {', '.join(KINDS)}",
        )
    try:
        size = path.stat().st_size
        if size > LARGEST_MESH:
            what = f"{path} has {size / 1e6:.0f} MB, more than {LARGEST_MESH / 1e6:.0f}"
            raise InputError("file-too-large", what, str(path))
        data = path.read_bytes()
    except OSError as error:
        what = f"{path} cannot be read: {error.strerror}"
        raise InputError("unreadable", what, str(path)) from None
    import trimesh

    try:
        loaded: Any = trimesh.load(
            BytesIO(data),
            file_type=kind[1:],
            force="mesh",
            process=False,
            resolver=None,
            skip_materials=True,
        )
        vertices = np.array(loaded.vertices, float)
        faces = np.array(loaded.faces, np.int64)
    except Exception as error:  # whatever a parser makes of damaged bytes
        raise InputError(
            "mesh-unreadable",
            f"{path} is damaged or is not {kind[1:].upper()}: {error}",
            str(path),
            "export it again from the program that made it",
        ) from None
    if vertices.ndim != 2 or faces.ndim != 2 or len(faces) == 0:
        what = f"{path} has no triangles"
        raise InputError("mesh-unreadable", what, str(path))
    return vertices, faces


def checked(
    vertices: Array, faces: Array, where: str, *, is_open: bool
) -> tuple[Array, Array]:
    """Merge what coincides; refuse a mesh that is not one sound surface."""
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise InputError("mesh-unreadable", "a triangle lacks a corner", where)
    if not np.isfinite(vertices).all():
        raise InputError("mesh-unreadable", "a vertex is not finite", where)
    size = float(np.ptp(vertices, axis=0).max())
    if not 0.0 < size < 1e5:
        what = f"the mesh is {size:g} m large"
        raise InputError("mesh-size", what, where, "check unit")
    rough = np.round((vertices - vertices.min(axis=0)) / (size * _EQUAL))
    _, kept, number = np.unique(rough, axis=0, return_index=True, return_inverse=True)
    vertices, faces = vertices[kept], number.reshape(-1)[faces]
    ends = np.sort(faces, axis=1)
    whole = (ends[:, 0] != ends[:, 1]) & (ends[:, 1] != ends[:, 2])
    faces = faces[whole]
    _, once = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    faces = faces[np.sort(once)]
    if len(faces) == 0:
        what = "all triangles are without area"
        raise InputError("mesh-zero-area", what, where)
    used, number = np.unique(faces, return_inverse=True)
    vertices, faces = vertices[used], number.reshape(faces.shape)
    _check_areas(vertices, faces, where)
    _check_edges(vertices, faces, where, is_open=is_open)
    return vertices, faces


def _check_areas(vertices: Array, faces: Array, where: str) -> None:
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    double = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    sides = [np.sum((p - q) ** 2, axis=1) for p, q in ((a, b), (b, c), (c, a))]
    flat = double <= _FLAT * np.max(sides, axis=0)
    if flat.any():
        raise InputError(
            "mesh-zero-area",
            f"{np.count_nonzero(flat)} triangles have no area although their corners "
            f"differ, the first at {_point(a[np.argmax(flat)])}",
            where,
            "mesh it again; leaving them out would tear the surface",
        )


def _check_edges(vertices: Array, faces: Array, where: str, *, is_open: bool) -> None:
    ends = np.sort(
        np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    )
    edges, count = np.unique(ends, axis=0, return_counts=True)
    if (count > 2).any():
        first = edges[np.argmax(count > 2)]
        raise InputError(
            "mesh-not-manifold",
            f"{np.count_nonzero(count > 2)} edges belong to three triangles or more, "
            f"the first at {_point(vertices[first].mean(axis=0))}",
            where,
            "give bodies that touch as meshes of their own, and remove inner faces",
        )
    if (count == 1).any() and not is_open:
        first = edges[np.argmax(count == 1)]
        raise InputError(
            "mesh-holes",
            f"{np.count_nonzero(count == 1)} edges belong to one triangle only, the "
            f"first at {_point(vertices[first].mean(axis=0))}: the surface has holes",
            where,
            "close it, or write open = true if it is a sheet with a rim",
        )


def _point(place: Array) -> str:
    return "(" + ", ".join(f"{c:.4g}" for c in place) + ") m"
