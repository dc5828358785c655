"""The powder as a packing: contacts, shapes, sizes.

A particle is a sphere of its apparent radius cut by the planes of its contacts: that
is the shape the contact law assumes, and volumes and surfaces here are those of it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pestle.results import Frame

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Facets:
    """Flat faces of the particles, one row per side of a contact.

    Parameters
    ----------
    particle : ndarray
        Row of the particle in the frame.
    other : ndarray
        Row of the particle behind the facet, -1 - w for wall number w.
    contact : ndarray
        Row of the contact in the frame.
    normal : ndarray
        Outward unit normal (M, 3) [-].
    distance : ndarray
        Distance of the plane from the centre [m].
    """

    particle: NDArray[np.int64]
    other: NDArray[np.int64]
    contact: NDArray[np.int64]
    normal: Array
    distance: Array


def facets(frame: Frame) -> Facets:
    """Find the facets of every particle of a frame."""
    first, second = frame.contact_indices()
    normal, flat = frame.contacts["normal"], frame.contacts["flat"]
    is_pair = second >= 0
    rows = np.arange(len(first))
    span = centre_distance(frame, first, second, is_pair)
    return Facets(
        particle=np.concatenate([first, second[is_pair]]),
        other=np.concatenate([second, first[is_pair]]),
        contact=np.concatenate([rows, rows[is_pair]]),
        normal=np.concatenate([-normal, normal[is_pair]]),
        distance=np.concatenate([flat, span - flat[is_pair]]),
    )


def centre_distance(
    frame: Frame,
    first: NDArray[np.int64],
    second: NDArray[np.int64],
    is_pair: NDArray[np.bool_],
) -> Array:
    """Distance of the centres of each pair [m], also across a periodic boundary."""
    position, radius = frame.particles["position"], frame.particles["radius"]
    i, j = first[is_pair], second[is_pair]
    distance = np.linalg.norm(position[i] - position[j], axis=1)
    touching = radius[i] + radius[j] - frame.contacts["overlap"][is_pair]
    return np.where(distance > 2.0 * (radius[i] + radius[j]), touching, distance)


def true_volume(frame: Frame) -> Array:
    r"""Volume of the truncated spheres: overlaps taken away, growth counted.

    .. math:: V = \tfrac43 \pi R^3 - \sum \tfrac\pi3 c^2 (3 R - c), \quad c = R - d

    Parameters
    ----------
    frame : Frame
        The powder at one moment.

    Returns
    -------
    ndarray
        Volume of every particle [m^3].

    Notes
    -----
    Caps that run into each other are taken away twice, as in the contact law; the
    error grows where facets meet in edges (dense packings).
    """
    radius = frame.particles["radius"]
    faces = facets(frame)
    big = radius[faces.particle]
    cap = np.clip(big - faces.distance, 0.0, 2.0 * big)
    taken = np.pi / 3.0 * cap**2 * (3.0 * big - cap)
    volume = 4.0 / 3.0 * np.pi * radius**3
    return np.asarray(volume - np.bincount(faces.particle, taken, len(radius)))


def solid_volume(frame: Frame) -> float:
    """Volume of the undeformed particles [m^3]: mass over true density."""
    return float(np.sum(4.0 / 3.0 * np.pi * frame.particles["radius_initial"] ** 3))


def coordination(frame: Frame) -> float:
    """Mean number of contacts per particle [-], walls included.

    A pair counts for both of its particles, a wall for its one.
    """
    count = len(frame.particles["id"])
    touching = frame.contacts["overlap"] > 0.0
    ends = np.where(frame.contacts["second"] < 0, 1, 2)
    return float(np.sum(ends[touching]) / count) if count else 0.0


def contact_area_fraction(frame: Frame) -> float:
    r"""Part of the particles' surface that lies in contacts.

    .. math::
        \phi_c = \frac{\sum A}{\sum (4 \pi R^2 - 2 \pi R \sum c) + \sum A}

    with the contact area :math:`A` on each side and the height :math:`c` of the cap
    that a contact cuts off.

    Returns
    -------
    float
        Fraction [-].
    """
    radius = frame.particles["radius"]
    faces = facets(frame)
    big = radius[faces.particle]
    cap = np.clip(big - faces.distance, 0.0, 2.0 * big)
    area = frame.contacts["area"][faces.contact]
    free = 4.0 * np.pi * radius**2 - np.bincount(
        faces.particle, 2.0 * np.pi * big * cap, len(radius)
    )
    total = float(np.sum(np.maximum(free, 0.0)) + np.sum(area))
    return float(np.sum(area)) / total if total > 0.0 else 0.0


@dataclass(frozen=True, slots=True)
class SizeDistribution:
    """Cumulative distribution of diameters.

    Parameters
    ----------
    diameter : ndarray
        Sorted diameters [m].
    by_number, by_volume : ndarray
        Part of the number, of the volume, that is not larger [-].
    """

    diameter: Array
    by_number: Array
    by_volume: Array

    def percentile(self, percent: float, *, by: str = "volume") -> float:
        """Diameter [m] below which `percent` [%] of the volume or number lies."""
        share = self.by_volume if by == "volume" else self.by_number
        return float(np.interp(percent / 100.0, share, self.diameter))

    @property
    def span(self) -> float:
        """Width (d90 - d10) / d50 by volume [-]."""
        d10, d50, d90 = (self.percentile(p) for p in (10.0, 50.0, 90.0))
        return (d90 - d10) / d50


def size_distribution(radius: Array) -> SizeDistribution:
    """Distribution of the diameters of spheres of these radii [m].

    Examples
    --------
    >>> sizes = size_distribution(np.array([1.0, 1.0, 2.0]))
    >>> sizes.percentile(50.0, by="number"), round(float(sizes.by_volume[1]), 3)
    (2.0, 0.2)
    """
    diameter = np.sort(2.0 * np.asarray(radius, dtype=np.float64))
    volume = np.cumsum(diameter**3)
    count = np.arange(1, len(diameter) + 1)
    return SizeDistribution(diameter, count / len(diameter), volume / volume[-1])


def largest_cluster(frame: Frame) -> NDArray[np.bool_]:
    """Whether each particle belongs to the largest body held by contacts."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    count = len(frame.particles["id"])
    first, second = frame.contact_indices()
    pair = second >= 0
    links = coo_array(
        (np.ones(int(pair.sum())), (first[pair], second[pair])), shape=(count, count)
    )
    _, label = connected_components(links, directed=False)
    return np.asarray(label == np.argmax(np.bincount(label)))
