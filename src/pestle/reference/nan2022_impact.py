r"""Nan, Goh and Rahman (2022): an impact solved exactly, event by event.

On every straight piece of the force line m x'' + c x' + f(x) = 0 has a closed solution;
the pieces are joined where one ends: yield, turning point, alpha_max, alpha_cp,
alpha_jp.  No time step, so the restitution is that of the law alone.
"""

from math import atan2, atanh, cos, exp, inf, pi, sin, sqrt
from typing import NamedTuple

from pestle.reference.nan2022 import Contact, unloading
from pestle.reference.nan2022_energy import bisect, damping_factor, velocities


class Impact(NamedTuple):
    """Outcome of an impact."""

    restitution: float  # [-]
    stuck: bool
    peak: float  # alpha_max, alpha_y if not yielded [m]
    force: float  # largest elastic force [N]
    rest: float  # alpha_p [m]
    pull_off: float  # f_cp [N]
    time: float  # of contact, infinite if stuck [s]
    viscous: float  # energy taken by the dashpot, infinite if stuck [J]


class _Line(NamedTuple):
    """A piece f = slope (x - zero) with damping; slope < 0 on the adhesive line."""

    slope: float
    zero: float
    mass: float
    damping: float

    def at(self, x0: float, v0: float, t: float) -> tuple[float, float]:
        """Place and velocity after a time."""
        y0, b = x0 - self.zero, self.damping / (2.0 * self.mass)
        w2 = self.slope / self.mass - b * b
        fade = exp(-b * t)
        if w2 > 0.0:
            w = sqrt(w2)
            c, s = cos(w * t), sin(w * t) / w
        else:
            w = sqrt(-w2)
            grow, shrink = exp(w * t), exp(-w * t)
            c = 0.5 * (grow + shrink)
            s = 0.5 * (grow - shrink) / w if w > 0.0 else t
        slip = v0 + b * y0
        y = fade * (y0 * c + slip * s)
        v = fade * (v0 * c - (b * v0 + self.slope / self.mass * y0) * s)
        return self.zero + y, v

    def turning(self, x0: float, v0: float) -> float:
        """Time until the velocity is zero; infinite if it never is."""
        y0, b = x0 - self.zero, self.damping / (2.0 * self.mass)
        w2 = self.slope / self.mass - b * b
        pull = b * v0 + self.slope / self.mass * y0
        if w2 > 0.0:
            w = sqrt(w2)
            angle = atan2(v0 * w, pull) % pi
            return angle / w if angle > 0.0 else pi / w
        w = sqrt(-w2)
        ratio = v0 * w / pull if pull != 0.0 else inf
        if not 0.0 < ratio < 1.0:
            return inf
        return atanh(ratio) / w

    def reach(self, x0: float, v0: float, target: float) -> tuple[float, float, float]:
        """Time, place and velocity at a target or, before it, at the turning point."""
        way = 1.0 if target > x0 else -1.0
        end = self.turning(x0, v0)
        if end == inf:
            end = abs(target - x0) / abs(v0) + 1e-300
            while way * (self.at(x0, v0, end)[0] - target) < 0.0:
                end *= 2.0
        x = self.at(x0, v0, end)[0]
        if way * (x - target) < 0.0:
            return end, x, 0.0
        t = bisect(lambda t: way * (self.at(x0, v0, t)[0] - target), 0.0, end)
        return t, target, self.at(x0, v0, t)[1]


def impact(
    c: Contact,
    mass: float,
    velocity: float,
    *,
    restitution: float = 1.0,
    beta: float = 1.0,
    beta_yielded: float = 0.1,
) -> Impact:
    """Impact of a mass m* on a virgin contact.

    Parameters
    ----------
    c : Contact
        The contact.
    mass, velocity : float
        m* [kg] and velocity of approach at the first touch [m/s].
    restitution : float
        e_0 of (26) [-].
    beta, beta_yielded : float
        Damping factor before and after yield [-].

    Returns
    -------
    Impact
        Restitution and what else came of it.
    """
    soft = damping_factor(restitution, beta)
    hard = damping_factor(restitution, beta_yielded)

    def line(slope: float, zero: float, gamma: float) -> _Line:
        return _Line(slope, zero, mass, 2.0 * gamma * sqrt(mass * abs(slope)))

    x, v, time, viscous = 0.0, velocity, 0.0, 0.0

    def go(piece: _Line, target: float) -> None:
        nonlocal x, v, time, viscous
        t, x1, v1 = piece.reach(x, v, target)
        before = 0.5 * mass * v * v + 0.5 * piece.slope * (x - piece.zero) ** 2
        after = 0.5 * mass * v1 * v1 + 0.5 * piece.slope * (x1 - piece.zero) ** 2
        viscous += before - after if piece.damping > 0.0 else 0.0
        x, v, time = x1, v1, time + t

    go(line(c.elastic, c.rest, soft), c.yield_overlap)
    force, gamma = c.elastic * (x - c.rest), soft
    if v > 0.0:
        gamma = hard
        zero = c.yield_overlap - c.yield_force / c.plastic
        go(line(c.plastic, zero, gamma), inf)
        force = c.plastic * (x - zero)
    u = unloading(c, x)
    elastic = line(u.elastic, u.rest, gamma)
    go(elastic, u.turn)
    if x <= u.turn and v < 0.0:
        adhesive = line(-u.adhesive, u.turn - u.pull_off / u.adhesive, gamma)
        go(adhesive, u.leave)
    left = x <= u.leave and v < 0.0
    return Impact(
        -v / velocity if left else 0.0,
        not left,
        u.overlap,
        force,
        u.rest,
        u.pull_off,
        time if left else inf,
        viscous if left else inf,
    )


def critical_velocity(
    c: Contact,
    mass: float,
    *,
    restitution: float = 1.0,
    beta: float = 1.0,
    beta_yielded: float = 0.1,
) -> float:
    """Velocity above which a damped impact rebounds [m/s]; arguments as of `impact`."""

    def rebounds(velocity: float) -> float:
        result = impact(
            c,
            mass,
            velocity,
            restitution=restitution,
            beta=beta,
            beta_yielded=beta_yielded,
        )
        return -1.0 if result.stuck else 1.0

    v = velocities(c, mass)
    high = max(v.sticking, v.plastic_sticking)
    while rebounds(high) < 0.0:
        high *= 1.5
    return bisect(rebounds, 0.0, high)
