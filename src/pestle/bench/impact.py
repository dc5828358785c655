r"""Impact on a wall or head-on: restitution from the law's own work, or in time.

Without damping an impact is loading until the kinetic energy is spent and unloading
until the contact parts, whatever the mass does in between:

.. math::
    \tfrac12 m v^2 = \int_0^{\delta_{max}} F\, d\delta, \qquad
    e^2 = \frac{\int_{\delta_{sep}}^{\delta_{max}} F\, d\delta}{\tfrac12 m v^2}

with e = 0 (the particle sticks) where the second integral is not positive.  `collide`
integrates in time instead, with friction and damping, for any angle.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pestle.bench.subject import Array, PairContact, SingleParticle, Subject
from pestle.errors import InputError
from pestle.particle.law import no_range_warnings

LOADING_POINTS = 20_001
UNLOADING_POINTS = 2_001


class Impact(NamedTuple):
    """Impacts at velocities."""

    velocity: Array  # relative, along the normal [m/s]
    restitution: Array  # [-]
    largest: Array  # displacement at the turn [m]
    force: Array  # at the turn [N]

    def columns(self) -> dict[str, Array]:
        """Columns of the table, named with their units."""
        return {
            "velocity [m/s]": self.velocity,
            "restitution": self.restitution,
            "largest_displacement [m]": self.largest,
            "largest_force [N]": self.force,
        }


def restitution(subject: Subject, velocity: ArrayLike) -> Impact:
    """Restitution at normal velocities, exact but for quadrature.

    Parameters
    ----------
    subject : SingleParticle or PairContact
        Particle against a wall, or a pair; its density gives the mass.
    velocity : array
        Relative velocities along the normal [m/s].
    """
    speed = np.atleast_1d(np.asarray(velocity, dtype=float))
    if not np.all(speed > 0.0) or not subject.mass > 0.0:
        raise InputError(
            "no-impact",
            f"an impact of {subject.mass:.4g} kg at {np.min(speed):.4g} m/s is none",
            hint="velocity and density must be positive",
        )
    energy = 0.5 * subject.mass * speed**2
    with no_range_warnings():  # the search goes further than the impact
        largest = turning_point(subject, energy)
    back, force = given_back(subject, largest)
    e = np.sqrt(np.maximum(back, 0.0) / energy)
    return Impact(speed, e, largest, force)


def turning_point(subject: Subject, energy: Array) -> Array:
    """Displacement at which loading has taken up energies [m].

    Read off one loading curve, then corrected by Newton steps on a curve of its own.
    """
    top = subject.largest * 1e-9
    while _loading_work(subject, top)[1][-1] < np.max(energy):
        if top >= 0.98 * subject.largest:
            raise InputError(
                "impact-too-fast",
                f"{subject.name} takes up {_loading_work(subject, top)[1][-1]:.4g} J "
                f"at most, the impact brings {np.max(energy):.4g} J",
                hint="lower the velocity",
            )
        top = min(2.0 * top, 0.98 * subject.largest)
    d, work = _loading_work(subject, top)
    rising = int(np.argmin(work))  # adhesion pulls first
    largest = np.interp(energy, work[rising:], d[rising:])
    for _ in range(3):
        own = largest[:, None] * np.linspace(0.0, 1.0, UNLOADING_POINTS) ** 2
        force = subject.follow(own).force
        steps = 0.5 * (force[:, 1:] + force[:, :-1]) * np.diff(own, axis=1)
        largest = largest - (np.sum(steps, axis=1) - energy) / force[:, -1]
    return largest


def _loading_work(subject: Subject, top: float) -> tuple[Array, Array]:
    d = top * np.linspace(0.0, 1.0, LOADING_POINTS) ** 2
    force = subject.follow(d).force
    steps = 0.5 * (force[1:] + force[:-1]) * np.diff(d)
    return d, np.concatenate([[0.0], np.cumsum(steps)])


def given_back(subject: Subject, largest: Array) -> tuple[Array, Array]:
    """Work given back from peaks until separation [J], and the force there [N]."""
    with no_range_warnings():
        end = separation(subject, largest)
    t = np.linspace(0.0, 1.0, UNLOADING_POINTS)
    path = largest[:, None] - (largest - end)[:, None] * t
    path[:, -1] = end  # not a rounding beyond, where there is no force
    force = subject.follow(path).force
    widths = (largest - end) / (UNLOADING_POINTS - 1)
    inner = np.sum(force[:, 1:-1], axis=1)
    return widths * (inner + 0.5 * (force[:, 0] + force[:, -1])), force[:, 0]


def separation(subject: Subject, largest: Array) -> Array:
    """Displacement at which a contact that was loaded to a peak parts [m]."""
    low = np.full_like(largest, -subject.reach * (1.0 + 1e-9) - 1e-300)
    high = largest.copy()
    for _ in range(60):
        middle = 0.5 * (low + high)
        parted = subject.follow(np.stack([largest, middle], axis=1)).force[:, 1] == 0.0
        low, high = np.where(parted, middle, low), np.where(parted, high, middle)
    return high


def sticking_velocity(subject: Subject, low: float = 1e-6, high: float = 1e3) -> float:
    """Largest velocity at which the particle stays [m/s]; 0 if it never does.

    `low` and `high` bound the search [m/s]; inf if it stays at `high` too.
    """
    if isinstance(subject, SingleParticle) and subject.reach == 0.0:
        return 0.0  # nothing pulls
    high = _fastest(subject, low, high)
    rebound = [restitution(subject, v).restitution[0] for v in (low, high)]
    if rebound[1] == 0.0:
        return np.inf
    if rebound[0] > 0.0:
        return 0.0
    for _ in range(60):
        middle = np.sqrt(low * high)
        sticks = restitution(subject, middle).restitution[0] == 0.0
        low, high = (middle, high) if sticks else (low, middle)
        if high - low < 1e-9 * high:
            break
    return float(high)


def _fastest(subject: Subject, low: float, high: float) -> float:
    """Fastest velocity up to `high` that the law can take up [m/s]."""
    energy = _loading_work(subject, 0.98 * subject.largest)[1][-1]
    return max(min(high, 0.99 * float(np.sqrt(2.0 * energy / subject.mass))), 2.0 * low)


class Collision(NamedTuple):
    """Impacts that were integrated in time; velocities are relative [m/s]."""

    velocity: Array
    angle: Array  # from the normal [rad]
    restitution: Array  # of the normal velocity, 0 where the particle stays [-]
    tangential: Array  # surface velocity after over before; nan at normal impact [-]
    rebound_angle: Array  # of the centre, from the normal [rad]
    left: NDArray[np.bool_]  # whether it has left

    def columns(self) -> dict[str, Array]:
        """Columns of the table, named with their units."""
        return {
            "velocity [m/s]": self.velocity,
            "angle [rad]": self.angle,
            "restitution": self.restitution,
            "tangential_restitution": self.tangential,
            "rebound_angle [rad]": self.rebound_angle,
            "left": self.left.astype(float),
        }


def collide(
    subject: PairContact,
    velocity: ArrayLike,
    angle: ArrayLike = 0.0,
    *,
    friction: float = 0.0,
    damping_ratio: float = 0.0,
    steps: int = 20_000,
) -> Collision:
    """Integrate impacts of a pair in time, with the engine's rules.

    Parameters
    ----------
    subject : PairContact
        The pair; a second radius of 0 makes it a wall.
    velocity, angle : array
        Relative velocity [m/s] and its angle from the normal [rad], broadcast.
    friction : float
        Coulomb's coefficient [-].
    damping_ratio : float
        Factor of sqrt(m* k) in the dashpots, the engine's [-].
    steps : int
        Steps until the turn.
    """
    from pestle.bench.kernel import impactor

    speed, lean = np.broadcast_arrays(np.asarray(velocity, float), angle)
    speed, lean = speed.ravel().astype(float), lean.ravel().astype(float)
    normal = speed * np.cos(lean)
    exact = restitution(subject, normal)
    dt = exact.largest / normal / steps
    runs = np.column_stack([speed, lean, dt, np.full_like(dt, 20.0 * steps)])
    out = np.zeros((len(speed), 4))
    body = (subject.mass, 8.0 * subject.pair.shear_modulus, friction, damping_ratio)
    impactor(subject.parts)(
        subject.constants, subject.geometry, subject.virgin, body, runs, out
    )
    left = out[:, 3] > 0.0
    surface = np.where(lean > 0.0, speed * np.sin(lean), np.nan)
    return Collision(
        speed,
        lean,
        np.where(left, np.maximum(out[:, 0], 0.0) / normal, 0.0),
        (out[:, 1] + out[:, 2]) / surface,
        np.arctan2(out[:, 1], out[:, 0]),
        left,
    )
