r"""Nan, Goh and Rahman (2022): works, characteristic velocities, numbers, time steps.

Equation numbers are those of the paper, tags our reading notes (docs/papers/nan2022).
"""

from collections.abc import Callable
from math import exp, log, pi, sqrt
from typing import NamedTuple

from pestle.reference.nan2022 import (
    Contact,
    jkr_work,
    unloading,
    yield_work,
)


class Works(NamedTuple):
    """Areas under the force line, (A1)-(A7) as their quadrature demands [N-04]."""

    W0: float  # to part an unyielded contact [J]
    W1: float  # won on jumping in [J]
    W2: float  # up to yield [J]
    W3: float  # plastic [J]
    W4: float  # given back on unloading to alpha_p [J]
    W5: float  # from alpha_p to alpha_c0 [J]
    W6: float  # from alpha_c0 to detachment [J]
    dissipated: float  # of the cycle touch, alpha_max, detachment [J]


def works(c: Contact, peak: float) -> Works:
    """Works of a cycle up to an overlap alpha_max [m]."""
    u = unloading(c, peak)
    share = 56.0 / 162.0 * c.ratio + 17.0 / 162.0  # (35) [N-01]
    w0 = share * c.pull_off**2 / c.elastic
    w1 = 64.0 / 162.0 * c.pull_off**2 / c.elastic
    w2 = c.yield_force**2 / (2.0 * c.elastic)
    w4 = u.force**2 / (2.0 * u.elastic)
    w3 = (u.overlap - c.yield_overlap) * 0.5 * (u.force + c.yield_force) - w4
    w5 = 64.0 / 162.0 * u.pull_off**2 / u.elastic
    w6 = share * u.pull_off**2 / u.elastic
    return Works(w0, w1, w2, w3, w4, w5, w6, w2 - w1 + w3 + w5 + w6)


def yield_pressure(yield_stress: float, poisson_ratio: float) -> float:
    r"""Limiting pressure, (32) after Jackson and Green [Pa].

    .. math:: p_y = 1.295\,e^{0.736\nu}\sigma_y

    Parameters
    ----------
    yield_stress, poisson_ratio : float
        sigma_y [Pa], nu [-].

    Returns
    -------
    float
        p_y [Pa].

    Examples
    --------
    >>> f"{yield_pressure(3.42e9, 0.3):.4g}"
    '5.523e+09'
    """
    return 1.295 * exp(0.736 * poisson_ratio) * yield_stress


def yield_pressure_chang(yield_stress: float, poisson_ratio: float) -> float:
    """Limiting pressure, (33) after Chang, with the hardness 2.8 sigma_y [Pa]."""
    return (0.454 + 0.41 * poisson_ratio) * 2.8 * yield_stress


def rate_yield_stress(
    static: float, sensitivity: float, rate: float, reference_rate: float
) -> float:
    """Yield stress at a strain rate, (34): sigma_s (1 + Y ln(V_i/V_0)) [Pa]."""
    return static * (1.0 + sensitivity * log(rate / reference_rate))


def elastic_stiffness(pressure: float, radius: float) -> float:
    """k_el where nothing is measured, (52): pi R* p_y [N/m]."""
    return pi * radius * pressure


def elastic_stiffness_from_unloading(
    modulus: float,
    radius: float,
    adhesion: float,
    pressure: float,
    *,
    measured: float,
    overlap: float,
    plastic: float = 0.0,
) -> tuple[float, float]:
    """k_el and alpha_y from one measured unloading line, (45) or (49) with (29).

    Parameters
    ----------
    modulus, radius, adhesion, pressure : float
        E* [Pa], R* [m], Gamma [J/m^2], p_y [Pa].
    measured : float
        k_e0, stiffness of the line [N/m].
    overlap : float
        alpha_max0 at its upper end [m].
    plastic : float
        k_p in (49); 0 gives (45), which the authors prefer [N/m].

    Returns
    -------
    tuple of float
        k_el [N/m], alpha_y [m].
    """
    work = yield_work(modulus, radius, pressure)
    tension = 1.5 * pi * adhesion * radius
    at_yield = pi**2 * radius * pressure**2 / (4.0 * modulus**2)
    elastic = measured
    for _ in range(500):  # a contraction: some forty steps to the last digit [N-09]
        elastic = plastic + (measured - plastic) * sqrt(at_yield / overlap)
        new = 8.0 / 9.0 * tension / elastic + sqrt(2.0 * work / elastic)
        if new == at_yield:
            break
        at_yield = new
    return elastic, at_yield


def cohesion_yield_number(
    modulus: float, radius: float, adhesion: float, pressure: float
) -> float:
    """CY of (81), p_y^3 R/(E^2 Gamma) [-]: a resting contact yields below 0.740."""
    return pressure**3 * radius / (modulus**2 * adhesion)


CRITICAL_NUMBER = 8.0 * sqrt(5.0 / 6.0) / pi**2  # CY where f_y = f_0 [-]


def critical_pressure(modulus: float, radius: float, adhesion: float) -> float:
    """p_y below which jumping in suffices to yield, (80): f_y = f_0 [Pa]."""
    return float((CRITICAL_NUMBER * modulus**2 * adhesion / radius) ** (1.0 / 3.0))


def critical_pressure_sticking(modulus: float, radius: float, adhesion: float) -> float:
    """p_y where V_y = V_s, (77) with (52): W2 = W0 + W1 [Pa]."""
    tension = 1.5 * pi * adhesion * radius
    part = jkr_work(modulus, radius, adhesion)

    def left(pressure: float) -> float:
        won = 32.0 / 81.0 * tension**2 / elastic_stiffness(pressure, radius)
        return yield_work(modulus, radius, pressure) - won - part

    high = critical_pressure(modulus, radius, adhesion)
    while left(high) < 0.0:
        high *= 2.0
    return bisect(left, 0.0, high)


def bisect(function: Callable[[float], float], low: float, high: float) -> float:
    """Where an increasing function passes zero, to the last bit."""
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            return high
        if function(middle) < 0.0:
            low = middle
        else:
            high = middle


class Velocities(NamedTuple):
    """Velocities of an impact that matter."""

    sticking: float  # V_s, (73): below it an unyielded contact sticks [m/s]
    plain_yield: float  # V_y0, (74): yield without adhesion [m/s]
    yield_squared: float  # signed square of V_y, (75) [N-14] [m^2/s^2]
    plastic_sticking: float  # V_ys, (78) and (79) [m/s]


def velocities(c: Contact, mass: float) -> Velocities:
    """Characteristic velocities of an undamped impact of mass m* [kg]."""
    w = works(c, 0.0)
    sticking = sqrt(2.0 * w.W0 / mass)
    squared = 2.0 * (w.W2 - w.W1) / mass
    plastic = sticking
    if squared < sticking**2:
        u = unloading(c, _sticking_peak(c))
        more = (u.force + c.yield_force) * (u.overlap - c.yield_overlap) / mass
        plastic = sqrt(max(squared + more, 0.0))
    return Velocities(sticking, sqrt(2.0 * w.W2 / mass), squared, plastic)


def _sticking_peak(c: Contact) -> float:
    """Largest alpha_max from which an undamped contact cannot part, W4 = W5 + W6."""

    def left(peak: float) -> float:
        u = unloading(c, peak)
        return u.force**2 / (2.0 * u.elastic) - u.parting

    high = 2.0 * c.yield_overlap
    while left(high) < 0.0:
        high *= 2.0
    # (61) has several roots: come from above
    low = high
    while left(low) >= 0.0 and low > c.yield_overlap:
        high, low = low, max(0.99 * low, c.yield_overlap)
    return bisect(left, low, high)


def sticking_velocity(
    modulus: float, radius: float, adhesion: float, density: float
) -> float:
    """V_s of a sphere against a wall, (73) with the printed factor 1.84 [m/s]."""
    return float(
        1.84
        * (adhesion / radius) ** (5.0 / 6.0)
        / (sqrt(density) * modulus ** (1.0 / 3.0))
    )


def yield_velocity(modulus: float, density: float, pressure: float) -> float:
    """V_y0 of a sphere against a wall, (74) [m/s]."""
    return (pi / (2.0 * modulus)) ** 2 * sqrt(0.4 / density) * pressure**2.5


def damping_factor(restitution: float, beta: float = 1.0) -> float:
    """Damping gamma of (26) from the elastic restitution e_0 [-]."""
    loss = -log(restitution)
    return beta * loss / sqrt(pi**2 + loss**2)


def rayleigh_time_step(
    radius: float, density: float, youngs_modulus: float, poisson_ratio: float
) -> float:
    """Rayleigh time step of a sphere, (71) [s]."""
    shear = youngs_modulus / (2.0 * (1.0 + poisson_ratio))
    return pi * radius * sqrt(density / shear) / (0.1631 * poisson_ratio + 0.8766)


def critical_time_step(
    radius: float, density: float, youngs_modulus: float, depth: float
) -> float:
    """Step 2 sqrt(m/k_e) of (68) with k_e of (69), which together are (70) [s].

    `depth` is alpha_max/R [-], all else of the particle.  Not a bound: k_e exceeds
    Hertz's by up to 17 % where CY > 2 [N-17]; then use (68) with k_e(alpha_max).
    """
    mass = 4.0 / 3.0 * pi * radius**3 * density
    return 2.0 * sqrt(mass / (2.0 * youngs_modulus * radius * sqrt(depth)))


def time_step_ratio(poisson_ratio: float, depth: float) -> float:
    """Critical over Rayleigh step, (72), at alpha_max/R = depth [-]."""
    shape = (0.1631 * poisson_ratio + 0.8766) / sqrt(1.0 + poisson_ratio)
    return float(shape * sqrt(4.0 / (3.0 * pi)) * depth**-0.25)
