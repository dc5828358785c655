"""Start positions: radii drawn from a distribution, spheres placed without overlap."""

from typing import Any

import numpy as np
import numpy.typing as npt

from pestle import _jit
from pestle.config import size_table
from pestle.errors import InputError

Array = npt.NDArray[np.float64]


def draw_radii(sizes: Any, count: int, random: np.random.Generator) -> Array:
    """Draw radii by number from a size distribution with its tails cut off [m]."""
    kind = sizes.distribution
    if kind == "single":
        return np.full(count, sizes.mean)
    if kind in ("rosin-rammler", "table"):
        return size_table.draw(sizes, count, random)
    radii = np.empty(0)
    while len(radii) < count:
        if kind == "uniform":
            drawn = random.uniform(sizes.minimum, sizes.maximum, count)
        elif kind == "normal":
            drawn = random.normal(sizes.mean, sizes.deviation, 2 * count)
        else:
            spread = np.log(1.0 + (sizes.deviation / sizes.mean) ** 2)
            drawn = random.lognormal(
                np.log(sizes.mean) - spread / 2, np.sqrt(spread), 2 * count
            )
        inside = drawn[(drawn >= sizes.minimum) & (drawn <= sizes.maximum)]
        radii = np.concatenate([radii, inside])
    return radii[:count]


def draw_mass(sizes: Any, volume: float, random: np.random.Generator) -> Array:
    """Draw radii until the spheres have a volume [m^3], to half of one sphere [m]."""
    radii = np.empty(0)
    filled = np.zeros(1)
    while filled[-1] < volume:
        each = 4.0 / 3.0 * np.pi * sizes.mean_cube
        missing = int(1.05 * (volume - filled[-1]) / each) + 10
        radii = np.concatenate([radii, draw_radii(sizes, missing, random)])
        filled = np.cumsum(4.0 / 3.0 * np.pi * radii**3)
    return radii[: max(int(np.argmin(np.abs(filled - volume))) + 1, 1)]


@_jit.njit
def _drop(
    radii: Any, tries: Any, box: Any, round_: bool, cell: float, head: Any, link: Any
) -> Any:
    """Place spheres one after the other where they fit; return places and number."""
    n = radii.shape[0]
    place = np.empty((n, 3))
    nx, ny, nz = head.shape
    t = 0
    for i in range(n):
        r = radii[i]
        fits = False
        while not fits:
            if t >= tries.shape[0]:
                return place, i
            u = tries[t]
            t += 1
            if round_:
                s = (box[0] - r) * np.sqrt(u[0])
                x, y = s * np.cos(2 * np.pi * u[1]), s * np.sin(2 * np.pi * u[1])
            else:
                x = -box[0] + r + u[0] * 2 * (box[0] - r)
                y = -box[1] + r + u[1] * 2 * (box[1] - r)
            z = r + u[2] * (box[2] - 2 * r)
            a = min(int((x + box[0]) / cell), nx - 1)
            b = min(int((y + box[1]) / cell), ny - 1)
            c = min(int(z / cell), nz - 1)
            fits = True
            for p in range(max(a - 1, 0), min(a + 2, nx)):
                for q in range(max(b - 1, 0), min(b + 2, ny)):
                    for s_ in range(max(c - 1, 0), min(c + 2, nz)):
                        j = head[p, q, s_]
                        while j >= 0:
                            dx, dy, dz = (
                                x - place[j, 0],
                                y - place[j, 1],
                                z - place[j, 2],
                            )
                            if dx * dx + dy * dy + dz * dz < (r + radii[j]) ** 2:
                                fits = False
                                break
                            j = link[j]
            if fits:
                place[i, 0], place[i, 1], place[i, 2] = x, y, z
                link[i] = head[a, b, c]
                head[a, b, c] = i
    return place, n


def place_in_die(
    radii: Array, die_radius: float, random: np.random.Generator
) -> tuple[Array, float]:
    """Place spheres at random in a cylinder on z = 0, as high as it takes.

    Parameters
    ----------
    radii : ndarray
        Radii [m]; the largest is placed first.
    die_radius : float
        Inner radius of the die [m].
    random : Generator
        Source of randomness.

    Returns
    -------
    ndarray, float
        Centres (N, 3) in the order of `radii` [m] and the height of the column [m].
    """
    biggest = float(radii.max())
    if biggest >= die_radius:
        raise InputError(
            "particles-larger-than-die",
            f"a particle of radius {biggest:.4g} m does not fit into the die of radius "
            f"{die_radius:.4g} m",
            "die.radius",
        )
    order = np.argsort(-radii, kind="stable")
    fraction = 0.30 * (1.0 - biggest / die_radius) ** 2
    volume = float(np.sum(4.0 / 3.0 * np.pi * radii**3))
    height = max(volume / (np.pi * die_radius**2 * fraction), 4.0 * biggest)
    while True:
        cell = 2.0 * biggest
        box = np.array([die_radius, die_radius, height])
        shape = tuple(
            int(np.ceil(s / cell)) for s in (2 * die_radius, 2 * die_radius, height)
        )
        head, link = np.full(shape, -1, np.int64), np.full(len(radii), -1, np.int64)
        tries = random.random((60 * len(radii) + 1000, 3))
        place, placed = _drop(radii[order], tries, box, True, cell, head, link)
        if placed == len(radii):
            result = np.empty_like(place)
            result[order] = place
            return result, height
        height *= 1.1
