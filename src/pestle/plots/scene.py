"""Pictures of the powder: every particle a sphere cut flat by its contacts."""

import io
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pestle.metrics.packing import Facets, facets
from pestle.plots.raycast import CUT, FACET, Bodies, Camera, Window, cast
from pestle.plots.shading import shade
from pestle.plots.triangles import draw_triangles
from pestle.results import Frame

Array = NDArray[np.float64]

POWDER = (0.965, 0.935, 0.885)
"""Colour of a particle that nothing is known about: cellulose."""

STEEL = (0.60, 0.63, 0.67)
"""Colour of a wall of triangles."""

SCALE = ("#f3ecdf", "#f2cf94", "#e69150", "#c4523f", "#7d2748", "#3b1238")
"""Colours from nothing to the largest value."""

_LARGEST = 200_000
"""Particles beyond this number are not drawn [-]."""

_ABOVE = 0.35
"""Part of a wall that is shown above the powder, over the height of the powder [-]."""


@dataclass(frozen=True, slots=True)
class View:
    """How a picture is taken; pictures of one view have one scale.

    Parameters
    ----------
    camera : Camera
        From where.
    across : float
        Width of the picture [m].
    height : float
        Height of the picture [m].
    pixels : int
        Width of the picture in pixels [-].
    samples : int
        Rays per pixel along each direction [-].
    """

    camera: Camera
    across: float
    height: float
    pixels: int = 720
    samples: int = 2

    @property
    def pixel(self) -> float:
        """Size of a pixel [m]."""
        return self.across / self.pixels

    @property
    def lines(self) -> int:
        """Height of the picture in pixels [-]."""
        return max(round(self.height / self.pixel), 1)


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture and what is needed to draw into it.

    Parameters
    ----------
    png : bytes
        The file.
    width, height : int
        Size in pixels [-].
    pixel : float
        Size of a pixel [m].
    left, bottom : float
        Lower left corner in camera coordinates [m].
    camera : Camera
        From where it was taken.
    """

    png: bytes
    width: int
    height: int
    pixel: float
    left: float
    bottom: float
    camera: Camera

    def place(self, point: Array) -> tuple[float, float]:
        """Pixel (from left, from top) of a point of the world [m]."""
        x, y, _ = (self.camera.axes @ np.asarray(point)).tolist()
        up = (y - self.bottom) / self.pixel
        return (x - self.left) / self.pixel, self.height - up


def common_view(
    frames: list[Frame], camera: Camera | None = None, *, pixels: int = 720
) -> View:
    """View that shows every one of the frames at one scale."""
    camera = camera or Camera()
    spans = [_extent(frame, camera) for frame in frames]
    across = 1.06 * max(high[0] - low[0] for low, high in spans)
    height = 1.0 * max(high[1] - low[1] for low, high in spans) + 0.06 * across
    pixels = int(min(pixels, 1.6e6 / max(height / across, 0.2) / pixels))
    return View(camera, across, height, pixels)


def _extent(frame: Frame, camera: Camera) -> tuple[Array, Array]:
    seen = frame.particles["position"] @ camera.axes.T
    radius = frame.particles["radius"][:, None]
    low, high = (seen - radius).min(axis=0), (seen + radius).max(axis=0)
    if len(frame.meshes["corner"]):
        top = float((frame.meshes["corner"] @ camera.axes[1]).max())
        room = high[1] + _ABOVE * (high[1] - low[1])
        high[1] = max(high[1], min(top, room))
    return low, high


def picture(
    frame: Frame,
    view: View,
    *,
    values: Array | None = None,
    top: float | None = None,
    cut: bool = False,
    kept: Facets | None = None,
) -> Picture:
    """Take a picture of a frame.

    Parameters
    ----------
    frame : Frame
        The powder.
    view : View
        From where, at what scale.
    values : ndarray, optional
        A number per particle that sets its colour.
    top : float, optional
        Value of the darkest colour; the largest if not given.
    cut : bool
        Take away the half that is nearer to the viewer.
    kept : Facets, optional
        Faces to draw besides those of the contacts of this frame.
    """
    low, high = _extent(frame, view.camera)
    middle = 0.5 * (low[0] + high[0])
    margin = 0.03 * view.across
    left, bottom = float(middle - 0.5 * view.across), float(low[1] - margin)
    n = view.samples
    window = Window(left, bottom, view.pixels * n, view.lines * n, view.pixel / n)
    plane = np.inf
    if cut:
        plane = float(np.mean(frame.particles["position"] @ view.camera.toward_viewer))
    bodies, rows = _bodies(frame, view.camera, plane=plane, kept=kept)
    seen = cast(bodies, view.camera, window)
    draw_triangles(seen, frame.meshes, len(rows), view.camera, window, plane)
    reach = float(np.median(frame.particles["radius"]))
    colours = np.concatenate([_colours(frame, values, top)[rows], [STEEL]])
    shaded = shade(seen, colours, reach=reach, samples=n)
    return Picture(
        _png(shaded),
        view.pixels,
        view.lines,
        view.pixel,
        left,
        bottom,
        view.camera,
    )


def _bodies(
    frame: Frame, camera: Camera, *, plane: float, kept: Facets | None
) -> tuple[Bodies, NDArray[np.int64]]:
    """Shapes to draw, and which rows of the frame they are."""
    position, radius = frame.particles["position"], frame.particles["radius"]
    faces = [facets(frame)] + ([kept] if kept else [])
    owner = np.concatenate([face.particle for face in faces])
    normal = np.concatenate([face.normal for face in faces])
    distance = np.concatenate([face.distance for face in faces])
    kind = np.full(len(owner), FACET, dtype=np.int8)
    visible = np.ones(len(radius), dtype=np.bool_)
    if np.isfinite(plane):
        toward = camera.toward_viewer
        room = plane - position @ toward
        visible = room > -radius
        crossed = np.flatnonzero(visible & (room < radius))
        owner = np.concatenate([owner, crossed])
        normal = np.concatenate([normal, np.tile(toward, (len(crossed), 1))])
        distance = np.concatenate([distance, room[crossed]])
        kind = np.concatenate([kind, np.full(len(crossed), CUT, dtype=np.int8)])
    rows = np.flatnonzero(visible)[:_LARGEST]
    place = np.full(len(radius), -1, dtype=np.int64)
    place[rows] = np.arange(len(rows))
    used = (place[owner] >= 0) & (distance < radius[owner])
    order = np.argsort(place[owner[used]], kind="stable")
    sorted_owner = place[owner[used]][order]
    start = np.searchsorted(sorted_owner, np.arange(len(rows) + 1))
    bodies = Bodies(
        position[rows],
        radius[rows],
        start,
        normal[used][order],
        distance[used][order],
        kind[used][order],
    )
    return bodies, rows


def kept_wall_facets(pressed: Frame, later: Frame, rotation: Array) -> Facets:
    """Faces that walls have pressed flat and that the particles keep.

    A frame knows contacts, not what former contacts have left behind. The yielded
    wall contacts of the pressed frame are carried over to the same particles, turned
    with the tablet; the little that they spring back is left out.
    """
    contacts = pressed.contacts
    first, second = pressed.contact_indices()
    used = second < 0
    if "yielded" in contacts:
        used &= contacts["yielded"].astype(bool)
    ids = pressed.particles["id"][first[used]]
    new_ids = later.particles["id"]
    order = np.argsort(new_ids)
    place = np.searchsorted(new_ids, ids, sorter=order)
    rows = order[np.minimum(place, len(order) - 1)]
    found = new_ids[rows] == ids
    growth = later.particles["radius"][rows] / pressed.particles["radius"][first[used]]
    return Facets(
        particle=rows[found],
        other=second[used][found],
        contact=np.flatnonzero(used)[found],
        normal=(-contacts["normal"][used] @ rotation.T)[found],
        distance=(contacts["flat"][used] * growth)[found],
    )


def _colours(frame: Frame, values: Array | None, top: float | None) -> Array:
    count = len(frame.particles["radius"])
    if values is None:
        tone = 1.0 - 0.05 * np.modf(frame.particles["id"] * 0.6180339887)[0]
        return np.asarray(np.outer(tone, POWDER)).reshape(count, 3)
    from matplotlib.colors import LinearSegmentedColormap

    scale = LinearSegmentedColormap.from_list("pestle", SCALE)
    largest = float(np.max(values)) if top is None else top
    part = np.clip(values / largest, 0.0, 1.0) if largest > 0.0 else 0.0 * values
    return np.asarray(scale(part))[:, :3]


def _png(picture: Array) -> bytes:
    from matplotlib.image import imsave

    file = io.BytesIO()
    imsave(file, np.round(picture * 255).astype(np.uint8), format="png")
    return file.getvalue()
