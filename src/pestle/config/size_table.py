"""Sizes given by a cumulative curve, by number or by volume: moments and draws.

Between two radii of the curve the density in the radius is uniform, by what the curve
is given by.  By volume the density by number then goes as r^-3, and its cumulative
curve is linear in r^-2, so everything is exact.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from pestle.config.sizes import SizeDistribution

Array = npt.NDArray[Any]

_KNOTS = 4097  # radii at which a Rosin-Rammler curve is tabulated


def curve(sizes: "SizeDistribution") -> tuple[Array, Array, bool]:
    """Radii [m], share that is finer [-], and whether that is by volume."""
    if sizes.distribution == "table":
        assert sizes.table is not None
        radii, finer = np.array(sizes.table, float).T
        return radii, finer, sizes.by == "volume"
    assert sizes.scale is not None
    assert sizes.exponent is not None
    radii = np.geomspace(sizes.minimum, sizes.maximum, _KNOTS)
    finer = -np.expm1(-((radii / sizes.scale) ** sizes.exponent))
    return radii, (finer - finer[0]) / (finer[-1] - finer[0]), True


def by_number(radii: Array, finer: Array, is_volume: bool) -> Array:
    """Share by number that is finer than each radius of the curve [-]."""
    if not is_volume:
        return finer
    a, b = radii[:-1], radii[1:]
    share = np.diff(finer) / (b - a) * 0.5 * (a**-2.0 - b**-2.0)
    total: Array = np.concatenate([[0.0], np.cumsum(share)])
    total /= total[-1]
    return total


def draw(sizes: "SizeDistribution", count: int, random: np.random.Generator) -> Array:
    """Radii by number, from the inverse of the curve [m]."""
    radii, finer, is_volume = curve(sizes)
    number, at = by_number(radii, finer, is_volume), random.random(count)
    if not is_volume:
        return np.interp(at, number, radii)
    drawn: Array = np.interp(at, number, radii**-2.0) ** -0.5
    return drawn


def moment(sizes: "SizeDistribution", power: int) -> float:
    """Mean by number of a power 1, 2 or 3 of the radius [m^power]."""
    radii, finer, is_volume = curve(sizes)
    weight = np.diff(by_number(radii, finer, is_volume))
    a, b = radii[:-1], radii[1:]
    if not is_volume:
        inside = (b ** (power + 1) - a ** (power + 1)) / ((power + 1) * (b - a))
    else:
        raised = {1: 1.0 / a - 1.0 / b, 2: np.log(b / a), 3: b - a}[power]
        inside = raised / (0.5 * (a**-2.0 - b**-2.0))
    return float(np.sum(weight * inside))
