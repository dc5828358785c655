r"""Pasha et al. (2014): linear elastic-plastic adhesive contact, full and simplified.

Both unload along k_e down to the pull-off force f_cp, from there along -k_e, and part
at 5/9 f_cp.  Tension is negative.  Formulas from a digest of the paper, re-derived, not
checked against print.

Full version, from (8/9) f_ce at touch:

.. math::
    f_{cp} = -\sqrt{\tfrac{162}{137}\pi\Gamma R^* k_e\,d\,(2-d/R^*)}, \quad
    d = \alpha_p-\alpha_y

Simplified version, plastic from the start: f = k_p alpha + f_0, and the pull-off points
lie on a line:

.. math::
    f_{cp} = f_{0p} - k_{cp}\alpha_{cp}, \quad
    \alpha_{cp} = \frac{k_e\alpha_p+f_{0p}}{k_e+k_{cp}}

Reference: M. Pasha et al., Granul. Matter 16 (2014) 151-162.
"""

from math import pi, sqrt
from typing import NamedTuple

PARTING = 137.0 / 162.0  # work from alpha_p to parting over f_cp^2/k_e [-]


class Line(NamedTuple):
    """Unloading line of a contact. SI units."""

    peak: float  # alpha_max [m]
    stiffness: float  # k_e [N/m]
    force: float  # at alpha_max [N]
    rest: float  # alpha_p, where it meets zero [m]
    pull_off: float  # f_cp, negative [N]
    turn: float  # alpha_cp [m]
    leave: float  # where the contact parts [m]


def line(peak: float, stiffness: float, force: float, pull_off: float) -> Line:
    """Unloading line through (peak, force) down to the pull-off force."""
    rest = peak - force / stiffness
    turn = rest + pull_off / stiffness
    leave = turn + 4.0 / 9.0 * pull_off / stiffness
    return Line(peak, stiffness, force, rest, pull_off, turn, leave)


class Full(NamedTuple):
    """Constants of the full version for one contact. SI units."""

    stiffness: float  # k_e [N/m]
    plastic: float  # k_p [N/m]
    adhesion: float  # Gamma [J/m^2]
    radius: float  # R* [m]
    yield_force: float  # f_y [N]


def full_pull_off(k: Full) -> float:
    """Pull-off force of an unyielded contact, f_ce = -3/2 pi Gamma R* [N]."""
    return -1.5 * pi * k.adhesion * k.radius


def full_yield_overlap(k: Full) -> float:
    """Overlap alpha_y at first yield [m]."""
    return (k.yield_force - 8.0 / 9.0 * full_pull_off(k)) / k.stiffness


def full_line(k: Full, peak: float, hold: bool = False) -> Line:
    """Unloading line of the full version after a largest overlap.

    Parameters
    ----------
    k : Full
        Constants.
    peak : float
        Largest overlap [m].
    hold : bool
        Keep at least f_ce.  As published the pull-off force falls to nearly zero just
        after yield, which would create energy; a law that runs has to hold it.

    Returns
    -------
    Line
        The line; alpha_max is not below alpha_y.
    """
    yields = full_yield_overlap(k)
    top = max(peak, yields)
    force = k.yield_force + k.plastic * (top - yields)
    d = max(top - force / k.stiffness - yields, 0.0)
    wide = pi * k.adhesion * k.radius * k.stiffness * d * max(2.0 - d / k.radius, 0.0)
    new = -sqrt(162.0 / 137.0 * wide)
    first = full_pull_off(k)
    pull = new if d > 0.0 else first
    return line(top, k.stiffness, force, min(pull, first) if hold else pull)


def full_restitution(k: Full, mass: float, velocity: float) -> float:
    """Restitution of an impact of the full version, 0 if it sticks [-]."""
    energy = 0.5 * mass * velocity**2
    won = 0.5 * (8.0 / 9.0 * full_pull_off(k)) ** 2 / k.stiffness
    more = energy + won - 0.5 * k.yield_force**2 / k.stiffness
    if more <= 0.0:
        peak, force = 0.0, sqrt(2.0 * k.stiffness * (energy + won))
    else:
        force = sqrt(k.yield_force**2 + 2.0 * k.plastic * more)
        peak = full_yield_overlap(k) + (force - k.yield_force) / k.plastic
    pull = full_line(k, peak).pull_off
    back = 0.5 * force**2 / k.stiffness - PARTING * pull**2 / k.stiffness
    return sqrt(max(back, 0.0) / energy)


class Simple(NamedTuple):
    """Constants of the simplified version for one contact. SI units."""

    plastic: float  # k_p [N/m]
    cohesive: float  # k_cp [N/m]
    first: float  # f_0 at touch, negative [N]
    pull: float  # f_0p, negative [N]
    elastic: float  # k_e; 0: from `stiffest` [N/m]
    stiffest: float  # k_e at alpha_max = R* [N/m]
    radius: float  # R* [m]


def simple_line(k: Simple, peak: float) -> Line:
    """Unloading line of the simplified version after a largest overlap [m]."""
    part = peak * (2.0 * k.radius - peak) / (k.radius * k.radius)
    rising = k.plastic + min(part, 1.0) * (k.stiffest - k.plastic)
    elastic = k.elastic if k.elastic > 0.0 else rising
    force = k.plastic * peak + k.first
    rest = peak - force / elastic
    turn = (elastic * rest + k.pull) / (elastic + k.cohesive)
    return line(peak, elastic, force, k.pull - k.cohesive * turn)


def simple_bond(k: Simple, u: Line) -> float:
    """Adhesive part of the stored energy, negative of what is stored at alpha_p [J].

    At least W5, so that no contact wins by attaching again; and so much that the way
    in, which is drawn by f_0 along the softer k_p, takes nothing from nowhere.
    """
    fresh = simple_line(k, 0.0)
    first = 32.0 / 81.0 * fresh.pull_off * fresh.pull_off / fresh.stiffness
    way = (0.5 * k.plastic * u.peak + k.first) * u.peak
    lost = way + 0.5 * k.first * k.first / fresh.stiffness
    lost -= 0.5 * u.force * u.force / u.stiffness
    again = 32.0 / 81.0 * u.pull_off * u.pull_off / u.stiffness
    return max(again, first - lost)


def simple_gains(k: Simple) -> bool:
    """Whether the way in, drawn by f_0, gives more than parting from f = 0 takes.

    For a constant k_e; without one, never.
    """
    if k.first == 0.0 or k.elastic == 0.0:
        return False
    u = simple_line(k, -k.first / k.plastic)
    return simple_bond(k, u) > PARTING * u.pull_off**2 / k.elastic


def simple_peak(k: Simple, mass: float, velocity: float) -> float:
    """Largest overlap of an impact of the simplified version [m]."""
    energy = 0.5 * mass * velocity**2
    return (sqrt(k.first**2 + 2.0 * k.plastic * energy) - k.first) / k.plastic


def simple_restitution(k: Simple, mass: float, velocity: float) -> float:
    """Restitution of an impact of the simplified version, 0 if it sticks [-]."""
    u = simple_line(k, simple_peak(k, mass, velocity))
    back = 0.5 * u.force**2 / u.stiffness - PARTING * u.pull_off**2 / u.stiffness
    return sqrt(2.0 * max(back, 0.0) / mass) / velocity
