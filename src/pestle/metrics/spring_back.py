"""Elastic recovery of a tablet, measured on the centres of its particles.

A caliper on a tablet of a thousand particles measures its highest bump. The centres
tell the same with all particles: the affine map that best carries the tablet in the
die to the tablet outside is split into a rotation (a tablet may tip over) and a
stretch, whose components along and across the die are the spring-back.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pestle.metrics.packing import largest_cluster
from pestle.results import Frame

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SpringBack:
    """How much a tablet grows when it is released.

    Parameters
    ----------
    axial, radial : float
        (h_out - h_in) / h_in and the same for the diameter [-].
    rotation : ndarray
        Rotation (3, 3) of the tablet between the two moments [-].
    particles : int
        Number of particles that both moments share [-].
    """

    axial: float
    radial: float
    rotation: Array
    particles: int


def spring_back(before: Frame, after: Frame, axis: Array | None = None) -> SpringBack:
    """Compare a tablet in the die with itself after release.

    Parameters
    ----------
    before : Frame
        Under load.
    after : Frame
        Released; particles that have come off the tablet are left out.
    axis : ndarray, optional
        Axis of the die [-]; z if not given.
    """
    direction = np.array([0.0, 0.0, 1.0]) if axis is None else np.asarray(axis, float)
    whole = largest_cluster(after)
    kept = after.particles["id"][whole]
    shared, old, new = np.intersect1d(before.particles["id"], kept, return_indices=True)
    start = before.particles["position"][old]
    end = after.particles["position"][whole][new]
    stretch, rotation = _stretch(start, end)
    axial = float(direction @ stretch @ direction)
    radial = 0.5 * (float(np.trace(stretch)) - axial)
    return SpringBack(axial - 1.0, radial - 1.0, rotation, len(shared))


def _stretch(start: Array, end: Array) -> tuple[Array, Array]:
    """Right stretch tensor and rotation of the best affine map."""
    if len(start) < 5:
        return np.full((3, 3), np.nan), np.eye(3)
    x, y = start - start.mean(axis=0), end - end.mean(axis=0)
    gradient = np.linalg.lstsq(x, y, rcond=None)[0].T
    left, singular, right = np.linalg.svd(gradient)
    if np.linalg.det(left @ right) < 0.0:
        left[:, -1] *= -1.0
        singular[-1] *= -1.0
    return right.T @ np.diag(singular) @ right, left @ right
