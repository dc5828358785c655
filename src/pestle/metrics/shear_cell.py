"""Shear cell: stresses from the head's torque, yield locus, Mohr circles."""

from dataclasses import dataclass
from math import atan, degrees, hypot, pi, sqrt
from typing import Any

import numpy as np
import numpy.typing as npt

from pestle.results.folder import RunFolder
from pestle.results.stages import Stage

Array = npt.NDArray[Any]

WINDOW = 0.2
"""Part of a step's turning over which a peak is averaged [-]."""

STEADY = 0.5
"""Last part of a pre-shear over which the steady stress is averaged [-]."""

_BLOCKS = 5  # pieces whose means give the standard error of a steady stress


@dataclass(frozen=True, slots=True)
class ShearCurve:
    """Stresses on the powder while the head turns, uniform over its disc.

    Parameters
    ----------
    stage : str
        Name of the step.
    role : str
        "pre-shear" or "yield".
    angle : ndarray
        Angle turned in this step [rad].
    normal, shear : ndarray
        Normal stress F/(pi R^2) at the vanes' edges, with the weight of the powder
        between the vanes, and shear stress 3 T/(2 pi R^3) [Pa].
    """

    stage: str
    role: str
    angle: Array
    normal: Array
    shear: Array

    def point(self) -> tuple[float, float, float]:
        """Normal and shear stress and its standard error: steady, or at the peak [Pa].

        A pre-shear gives the means over its last half, with the error from the scatter
        of five blocks.  A yield point is the largest mean over a fifth of the turning.
        Its error is that of such a mean, from the differences of successive ones, so
        that the way from the peak to steady flow does not count.
        """
        if self.role == "pre-shear":
            late = self.angle >= (1.0 - STEADY) * self.angle[-1]
            blocks = [part.mean() for part in np.array_split(self.shear[late], _BLOCKS)]
            error = float(np.std(blocks, ddof=1)) / sqrt(_BLOCKS)
            return float(self.normal[late].mean()), float(np.mean(blocks)), error
        width = max(round(WINDOW * len(self.angle)), 1)
        shear, normal = _moving(self.shear, width), _moving(self.normal, width)
        top = int(np.argmax(shear))
        steps = np.diff(shear[::width])
        return (
            float(normal[top]),
            float(shear[top]),
            float(sqrt(0.5 * (steps @ steps) / len(steps))),
        )


def _moving(values: Array, width: int) -> Array:
    total = np.concatenate([[0.0], np.cumsum(values)])
    mean: Array = (total[width:] - total[:-width]) / width
    return mean


def shear_curves(folder: RunFolder) -> list[ShearCurve]:
    """Curve of every step `shear` that has been finished."""
    if folder.history is None:
        return []
    curves = (_curve(folder, s) for s in folder.stages if s.step == "shear")
    return [curve for curve in curves if curve is not None]


def _curve(folder: RunFolder, stage: Stage) -> ShearCurve | None:
    history, info = folder.history, stage.info
    assert history is not None
    if "start_of_turning" not in info:
        return None
    wall, radius = info["wall"], info["radius"]
    time = history["time [s]"] - info["start_of_turning"]
    rows = np.array([name == stage.name for name in history.stages]) & (time > 0.0)
    if rows.sum() < 2.0 / WINDOW:
        return None
    return ShearCurve(
        stage.name,
        info["role"],
        info["angular_speed"] * time[rows],
        info["weight_above"] - history[f"{wall}.force_z [N]"][rows] / (pi * radius**2),
        1.5 * history[f"{wall}.torque_z [N m]"][rows] / (pi * radius**3),
    )


@dataclass(frozen=True, slots=True)
class YieldLocus:
    """Straight line through the yield points, and what follows from it.

    Parameters
    ----------
    cohesion, slope : float
        tau = cohesion + slope sigma [Pa], [-].
    covariance : ndarray
        Of cohesion and slope, from the errors of the points; larger by the mean square
        of the scatter over those errors, where that exceeds one.
    """

    cohesion: float
    slope: float
    covariance: Array

    @classmethod
    def through(cls, normal: Array, shear: Array, error: Array) -> "YieldLocus":
        """Least squares of the shear stress, all points with the same weight."""
        one = np.column_stack([np.ones_like(normal), normal])
        solve = np.linalg.inv(one.T @ one) @ one.T
        cohesion, slope = solve @ shear
        covariance = solve @ np.diag(error**2) @ solve.T
        if len(normal) > 2:
            left = (shear - cohesion - slope * normal) / np.maximum(error, 1e-300)
            covariance = covariance * max(float(left @ left) / (len(normal) - 2), 1.0)
        return cls(float(cohesion), float(slope), covariance)

    @property
    def cohesion_error(self) -> float:
        """Standard error of the cohesion [Pa]."""
        return float(np.sqrt(self.covariance[0, 0]))

    @property
    def friction_angle(self) -> tuple[float, float]:
        """Angle of internal friction and its standard error [deg]."""
        error = float(np.sqrt(self.covariance[1, 1])) / (1.0 + self.slope**2)
        return degrees(atan(self.slope)), degrees(error)

    @property
    def strength(self) -> tuple[float, float]:
        """Unconfined yield strength and its standard error [Pa].

        The Mohr circle through the origin that touches the line,
        sigma_c = 2 c (tan(phi) + 1/cos(phi)).
        """
        root = hypot(1.0, self.slope)
        factor = 2.0 * (self.slope + root)
        gradient = np.array([factor, 2.0 * self.cohesion * (1.0 + self.slope / root)])
        variance = float(gradient @ self.covariance @ gradient)
        return factor * self.cohesion, float(np.sqrt(variance))

    def consolidation(self, normal: float, shear: float) -> tuple[float, float]:
        """Smallest and largest stress of steady flow [Pa].

        The Mohr circle through the pre-shear point (normal, shear) that touches the
        line to the left of it; from a point above the line, the nearest that there is.
        """
        root = hypot(1.0, self.slope)
        sine, cosine = self.slope / root, 1.0 / root
        b = normal + self.cohesion * sine * cosine
        rest = b * b - cosine**2 * (
            normal**2 + shear**2 - (self.cohesion * cosine) ** 2
        )
        centre = (b - sqrt(max(rest, 0.0))) / cosine**2
        radius = self.cohesion * cosine + centre * sine
        return centre - radius, centre + radius


@dataclass(frozen=True, slots=True)
class ShearTest:
    """A whole test: steady points, yield points and, from two on, the locus."""

    steady: Array  # rows of normal stress, shear stress, error [Pa]
    peaks: Array  # rows of normal stress, shear stress, error [Pa]
    locus: YieldLocus | None


def shear_test(curves: list[ShearCurve]) -> ShearTest:
    """Points of all steps, and the line through the yield points."""
    steady = [curve.point() for curve in curves if curve.role == "pre-shear"]
    peaks = [curve.point() for curve in curves if curve.role == "yield"]
    points = np.array(peaks).reshape(-1, 3)
    apart = len(points) > 1 and np.ptp(points[:, 0]) > 1e-3 * points[:, 0].max()
    locus = YieldLocus.through(*points.T) if apart else None
    return ShearTest(np.array(steady).reshape(-1, 3), points, locus)
