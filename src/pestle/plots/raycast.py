"""Cast one ray per pixel at truncated spheres.

A particle is a sphere cut by half-spaces: convex, so a ray enters it at the last of
its entries and leaves at the first of its exits. Camera coordinates: x right, y up,
z away from the viewer; rays are parallel.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SPHERE, FACET, CUT = 0, 1, 2
"""What a pixel shows: the round surface, a flat face, the inside of a cut particle."""


@dataclass(frozen=True, slots=True)
class Camera:
    """A parallel view from a direction.

    Parameters
    ----------
    azimuth, elevation : float
        Where the viewer stands, around z and above the horizon [rad].
    """

    azimuth: float = -0.6
    elevation: float = 0.38

    @property
    def axes(self) -> Array:
        """Rows: right, up and away in world coordinates [-]."""
        ca, sa = np.cos(self.azimuth), np.sin(self.azimuth)
        ce, se = np.cos(self.elevation), np.sin(self.elevation)
        right = [-sa, ca, 0.0]
        up = [-se * ca, -se * sa, ce]
        away = [-ce * ca, -ce * sa, -se]
        return np.array([right, up, away])

    @property
    def toward_viewer(self) -> Array:
        """Horizontal unit vector to the viewer [-]: normal of a cut."""
        return np.array([np.cos(self.azimuth), np.sin(self.azimuth), 0.0])


@dataclass(frozen=True, slots=True)
class Bodies:
    """Truncated spheres in world coordinates; facets are sorted by particle.

    Parameters
    ----------
    centre : ndarray
        Centres (N, 3) [m].
    radius : ndarray
        Radii [m].
    start : ndarray
        First facet of each particle; N + 1 numbers.
    normal : ndarray
        Outward normals of the facets (M, 3) [-].
    distance : ndarray
        Distance of each facet from its centre [m].
    kind : ndarray
        FACET or CUT.
    """

    centre: Array
    radius: Array
    start: NDArray[np.int64]
    normal: Array
    distance: Array
    kind: NDArray[np.int8]


@dataclass(frozen=True, slots=True)
class Window:
    """Part of the picture plane that is drawn.

    Parameters
    ----------
    left, bottom : float
        Corner in camera coordinates [m].
    width, height : int
        Number of pixels [-].
    pixel : float
        Size of a pixel [m].
    """

    left: float
    bottom: float
    width: int
    height: int
    pixel: float


@dataclass(frozen=True, slots=True)
class Buffers:
    """What every pixel sees; rows from the bottom up.

    Parameters
    ----------
    depth : ndarray
        Distance along the view [m], infinite where there is nothing.
    normal : ndarray
        Outward normal (H, W, 3) in camera coordinates [-].
    particle : ndarray
        Row of the particle, -1 where there is nothing.
    kind : ndarray
        SPHERE, FACET or CUT.
    """

    depth: Array
    normal: Array
    particle: NDArray[np.int32]
    kind: NDArray[np.int8]


def cast(bodies: Bodies, camera: Camera, window: Window) -> Buffers:
    """See the bodies through the window."""
    shape = (window.height, window.width)
    seen = Buffers(
        depth=np.full(shape, np.inf),
        normal=np.zeros((*shape, 3)),
        particle=np.full(shape, -1, dtype=np.int32),
        kind=np.zeros(shape, dtype=np.int8),
    )
    centre = bodies.centre @ camera.axes.T
    normal = bodies.normal @ camera.axes.T
    order = np.argsort(centre[:, 2] - bodies.radius, kind="stable")
    for row in order:
        _draw(seen, int(row), bodies, centre[row], normal, window)
    return seen


def _draw(
    seen: Buffers,
    row: int,
    bodies: Bodies,
    centre: Array,
    normals: Array,
    window: Window,
) -> None:
    """Draw one particle where it is nearer than what was drawn before."""
    radius = float(bodies.radius[row])
    columns = _span(centre[0], radius, window.left, window.pixel, window.width)
    lines = _span(centre[1], radius, window.bottom, window.pixel, window.height)
    if columns is None or lines is None:
        return
    part = (slice(*lines), slice(*columns))
    if np.all(seen.depth[part] <= centre[2] - radius):
        return  # hidden
    x = window.left + (np.arange(*columns) + 0.5) * window.pixel - centre[0]
    y = window.bottom + (np.arange(*lines) + 0.5) * window.pixel - centre[1]
    square = radius**2 - x[None, :] ** 2 - y[:, None] ** 2
    half = np.sqrt(np.maximum(square, 0.0))
    facets = slice(bodies.start[row], bodies.start[row + 1])
    normal = normals[facets]
    enter, leave, face = _clip(x, y, half, normal, bodies.distance[facets])
    depth = centre[2] + enter
    hit = (square > 0.0) & (enter < leave) & (depth < seen.depth[part])
    if not hit.any():
        return
    surface = np.empty((*hit.shape, 3))
    surface[..., 0], surface[..., 1] = x[None, :] / radius, y[:, None] / radius
    surface[..., 2] = enter / radius
    flat = face >= 0
    kinds = np.zeros(hit.shape, dtype=np.int8)
    if flat.any():
        surface[flat] = normal[face[flat]]
        kinds[flat] = bodies.kind[facets][face[flat]]
    seen.depth[part][hit] = depth[hit]
    seen.normal[part][hit] = surface[hit]
    seen.particle[part][hit] = row
    seen.kind[part][hit] = kinds[hit]


def _span(
    centre: float, radius: float, start: float, pixel: float, count: int
) -> tuple[int, int] | None:
    """Range of pixels that a disc may cover along one direction."""
    low = max(int((centre - radius - start) / pixel - 0.5), 0)
    high = min(int((centre + radius - start) / pixel + 1.5), count)
    return (low, high) if low < high else None


def _clip(
    x: Array, y: Array, half: Array, normal: Array, distance: Array
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Entry and exit [m] of every ray, and the facet of its entry (-1: sphere)."""
    enter, leave = -half, half
    face = np.full(half.shape, -1, dtype=np.int64)
    if not len(normal):
        return enter, leave, face
    slope = normal[:, 2]
    slope = np.where(np.abs(slope) < 1e-9, 1e-9, slope)
    crossing = (
        distance[:, None, None]
        - normal[:, 0, None, None] * x[None, None, :]
        - normal[:, 1, None, None] * y[None, :, None]
    ) / slope[:, None, None]
    front = np.flatnonzero(slope < 0.0)
    if len(front):
        nearest = np.argmax(crossing[front], axis=0)
        at = np.take_along_axis(crossing[front], nearest[None], axis=0)[0]
        face = np.where(at > enter, front[nearest], -1)
        enter = np.maximum(enter, at)
    if len(front) < len(slope):
        leave = np.minimum(leave, crossing[slope > 0.0].min(axis=0))
    return enter, leave, face
