r"""Shahin (2021), chapter 3: rigid-plastic sphere that hardens by a power law.

With sigma = kappa eps^h, h = 1/m, and chapter 2 at its rigid-plastic limit
(H_max = 3.101 at x = 0, r = 1, q = 14.1819):

.. math::
    P &= H \kappa \pi a^2                                               \tag{3.45} \\
    H^{fp} &= [H_{max}' - p \tanh(qx) \cos(x - s)]\, x^{h/2}             \tag{3.48} \\
    H^{lc} &= \Big[H_{min}' + \frac{1 - \chi_{min}}{0.467\, e^{-0.5883 h}}
        \ln\{1 - w^2\}\Big] x^{h/2}                                      \tag{3.58} \\
    H^{ev} &= \infty \quad (x > x_{zp})

Print writes :math:`H_{max}' = 3.101\, e^{-1.748 h}` in the first term only; then the
curve jumps and becomes negative.  Reading "consistent" uses it throughout, so that
:math:`H_{min}' = H_{max}' - k (H_{max}' - 1)` with k of the configuration alone.  Other
readings are kept for comparison: "literal", "frozen_min" (H_min of h = 0), "scaled"
(all of (3.24) times the factor).  `lc_sign` +1 takes (3.59)'s sign of 0.5883 h.
"""

from typing import Any, Literal, NamedTuple, get_args

import numpy as np

from pestle.errors import InputError, did_you_mean
from pestle.particle.configuration import cell, cell_slope, deformation
from pestle.particle.shahin2021_hardness import Hardness
from pestle.particle.shahin2021_plastic import Plastic, plastic
from pestle.particle.shahin2021_radius import Coefficients, rigid_coefficients

Reading = Literal["consistent", "literal", "frozen_min", "scaled"]

HARDNESS_MAX = 3.101
Q = 14.1819


class Parameters(NamedTuple):
    """Everything that the law derives from h and the configuration."""

    configuration: str
    hardening: float
    radius: Coefficients  # of (3.47), with the factors of h
    rigid: Plastic  # chapter 2 at its limit, h = 0
    k: float  # (H_max - H_min)/(H_max - 1) of the configuration
    hardness_max: float  # H_max'
    hardness_min: float  # H_min'
    p: float
    chi_min: float
    u: float
    zero_porosity: float  # x [-]


def parameters(
    hardening: float,
    configuration: str,
    *,
    reading: Reading = "consistent",
    lc_sign: int = -1,
) -> Parameters:
    """All parameters of the law for equal radii (3.47)-(3.58)."""
    rigid_radius = rigid_coefficients(configuration)
    rigid = plastic(
        HARDNESS_MAX,
        0.0,
        Q,
        1.0,
        coefficients=rigid_radius,
        configuration=configuration,
    )
    factor = float(np.exp(-1.748 * hardening))
    top, bottom, drop = _levels(rigid, factor, reading)
    confined = configuration != "simple"
    chi_min = float(cell(rigid.lowest, configuration)) if confined else np.nan
    return Parameters(
        configuration,
        hardening,
        rigid_coefficients(configuration, hardening),
        rigid,
        float((HARDNESS_MAX - rigid.hardness_min) / (HARDNESS_MAX - 1.0)),
        top,
        bottom,
        drop / float(rigid.softening.shape(rigid.lowest)),
        chi_min,
        (chi_min - 1.0) / (0.467 * float(np.exp(lc_sign * 0.5883 * hardening))),
        float(deformation(1.0, configuration)) if confined else np.inf,
    )


def _levels(rigid: Plastic, factor: float, reading: str) -> tuple[float, ...]:
    """H_max', H_min' and the drop that fixes p, in one of the readings."""
    whole, lowest = HARDNESS_MAX, float(rigid.hardness_min)
    k, top = (whole - lowest) / (whole - 1.0), whole * factor
    if reading == "consistent":
        return top, top - k * (top - 1.0), k * (top - 1.0)
    if reading == "literal":
        return top, lowest, whole - lowest
    if reading == "frozen_min":
        return top, lowest, top - lowest
    if reading == "scaled":
        return top, lowest * factor, (whole - lowest) * factor
    raise InputError(
        "unknown-reading",
        f"there is no reading {reading!r} of chapter 3",
        hint=did_you_mean(reading, get_args(Reading)),
    )


def hardness(x: Any, law: Parameters) -> Hardness:
    """H = P/(kappa pi a^2) and its slope at deformations x (3.59).

    The regimes are numbered as in chapter 2: 2 plastic, 3 low compressibility, 4 beyond
    zero porosity, where H is infinite.
    """
    x = np.asarray(x, dtype=float)
    confined = law.configuration != "simple"
    regime = 2 + (x > law.rigid.lowest) * confined + (x > law.zero_porosity)
    with np.errstate(divide="ignore", invalid="ignore"):
        soft = law.rigid.softening
        core = law.hardness_max - law.p * soft.shape(x)
        core_slope = -law.p * soft.shape_slope(x)
        if confined:
            low, low_slope = _low_compressibility(x, law)
            core = np.select([regime == 2, regime == 3], [core, low], np.inf)
            core_slope = np.select(
                [regime == 2, regime == 3], [core_slope, low_slope], np.inf
            )
        power = x ** (0.5 * law.hardening)
        value = core * power
        slope = core_slope * power + 0.5 * law.hardening * value / x
    return Hardness(regime, value, slope)


def _low_compressibility(x: Any, law: Parameters) -> tuple[Any, Any]:
    """Bracket of (3.58) and its slope."""
    width = 1.0 - law.chi_min
    w = (cell(x, law.configuration) - law.chi_min) / width
    by_x = cell_slope(x, law.configuration) / width
    rest = 1.0 - w**2
    slope = 2.0 * law.u * w / rest * by_x
    return law.hardness_min - law.u * np.log(rest), slope
