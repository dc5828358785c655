"""Angle of repose of a heap: lines through its surface, sector by sector."""

from dataclasses import dataclass
from math import nan, sqrt
from typing import Any

import numpy as np
import numpy.typing as npt

from pestle.metrics.metric import Group, Metric
from pestle.results.folder import RunFolder

Array = npt.NDArray[Any]
_HEAP = Group("Heap")

SECTORS = 8
"""Equal sectors around the axis of the heap [-]."""

FROM, TO = 0.2, 0.8
"""Part of the heap's height between which the flank is fitted [-]."""

_FEWEST = 3  # points of a line


@dataclass(frozen=True, slots=True)
class Heap:
    """Surface of a heap and the lines through its flank.

    Parameters
    ----------
    radius : ndarray
        Middles of rings that are a mean diameter wide [m].
    height : ndarray
        Top of the highest particle in each sector and ring (sectors, rings), nan for
        none [m].
    fitted : ndarray
        Rings that belong to the flank.
    slope, base : ndarray
        Line of each sector, height = base - slope radius [-], [m].
    """

    radius: Array
    height: Array
    fitted: Array
    slope: Array
    base: Array

    @property
    def profile(self) -> Array:
        """Mean height of each ring over its sectors, zero where none is [m]."""
        mean: Array = np.nan_to_num(self.height).mean(axis=0)
        return mean

    @property
    def angle(self) -> tuple[float, float]:
        """Mean angle of repose over the sectors and its standard error [deg]."""
        angles = np.degrees(np.arctan(self.slope[np.isfinite(self.slope)]))
        if len(angles) < 2:
            return nan, nan
        return float(angles.mean()), float(angles.std(ddof=1)) / sqrt(len(angles))


def heap_of(position: Array, radius: Array, floor: float = 0.0) -> Heap:
    """Measure a heap on a floor, from the places (N, 3) and radii of its particles [m].

    The axis goes through the mean of the places.  The flank is where the mean height
    lies between a fifth and four fifths of its largest value, with a ring more on
    either side where it is too steep for three rings.
    """
    width = 2.0 * float(radius.mean())
    away = position[:, :2] - position[:, :2].mean(axis=0)
    far = np.hypot(away[:, 0], away[:, 1])
    ring = (far / width).astype(int)
    turn = np.arctan2(away[:, 1], away[:, 0]) / (2.0 * np.pi) % 1.0
    sector = np.minimum((SECTORS * turn).astype(int), SECTORS - 1)
    height = np.full((SECTORS, ring.max() + 1), -np.inf)
    np.maximum.at(height, (sector, ring), position[:, 2] + radius - floor)
    height[np.isinf(height)] = nan
    middles = (np.arange(height.shape[1]) + 0.5) * width
    profile = np.nan_to_num(height).mean(axis=0)
    top = float(profile.max())
    crest = int(np.argmax(profile))  # the middle ring has few particles and may be low
    below = [
        crest + np.flatnonzero(profile[crest:] < part * top) for part in (TO, FROM)
    ]
    begin, end = (int(rings[0]) if len(rings) else len(profile) for rings in below)
    if begin > 0 and end - begin < _FEWEST:  # a column that stands
        begin, end = begin - 1, max(end + 1, begin - 1 + _FEWEST)
    fitted = np.zeros(len(middles), bool)
    fitted[begin:end] = True
    slope, base = np.full(SECTORS, nan), np.full(SECTORS, nan)
    for s in range(SECTORS):
        here = np.nan_to_num(height[s])  # beyond the foot there is the floor
        if fitted.sum() >= _FEWEST:
            down, base[s] = np.polyfit(middles[fitted], here[fitted], 1)
            slope[s] = -down
    return Heap(middles, height, fitted, slope, base)


def heap(folder: RunFolder) -> Heap | None:
    """Heap at the end of the last step `lift`; None without one."""
    results = folder.results
    if results is None:
        return None
    ended = {stage.name for stage in folder.stages if stage.end_reason}
    frames = [
        number
        for number, stage in enumerate(results.stages)
        if folder.kind_of(stage) == "lift" and stage in ended
    ]
    if not frames:
        return None
    particles = results[frames[-1]].particles
    return heap_of(particles["position"], particles["radius"])


def heap_metrics(folder: RunFolder) -> list[Metric]:
    """Angle of repose, its error and the height of the heap."""
    found = heap(folder)
    if found is None:
        return []
    angle, error = found.angle
    return [
        _HEAP.metric(
            "angle_of_repose",
            "Angle of repose",
            angle,
            unit="deg",
            definition="Inclination of the straight line through the highest particles "
            "of rings a mean diameter wide, between a fifth and four fifths of the "
            "heap's height, mean over eight sectors.",
        ),
        _HEAP.metric(
            "angle_of_repose_error",
            "Error of the angle of repose",
            error,
            unit="deg",
            definition="Standard error of that mean, from the scatter of the sectors.",
        ),
        _HEAP.metric(
            "heap_height",
            "Height of the heap",
            float(found.profile.max()),
            unit="m",
            definition="Largest height of a ring, mean over the sectors.",
        ),
    ]
