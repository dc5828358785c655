r"""Shahin (2021), chapter 2: elastic-perfectly plastic sphere, five regimes.

.. math::
    P &= H \sigma_y \pi a^2                                            \tag{2.12} \\
    H^e &= \frac{2}{3\pi} \lambda \sqrt{A \gamma}
        = \frac{4}{3\pi} \lambda \sqrt{x}                              \tag{2.15} \\
    H^{ep} &= H_{max} - c_1 [\ln(x_{Hmax}/x)]^{c_2}                    \tag{2.18} \\
    H^{fp} &= H_{max} - p f(x)^r                                       \tag{2.25} \\
    H^{lc} &= H_{min} - u \ln\{1 - l w^2\}, \quad
        w = \frac{\chi - \chi_{min}}{\chi_{zp} - \chi_{min}}           \tag{2.41} \\
    H^{ev} &= \zeta (1 - \chi)                                         \tag{2.44}

with :math:`\lambda = E/((1-\nu^2)\sigma_y)`, :math:`\zeta = E/(3(1-2\nu)\sigma_y)`.
H is C1 at every border.  The elastic branch has Hertz' pressure but not Hertz' radius:
its force is D_1^2 times that of Hertz, up to 3.07.
"""

from functools import cache
from math import pi
from typing import Any, NamedTuple

import numpy as np

from pestle.particle.configuration import cell, cell_slope, deformation
from pestle.particle.shahin2021_plastic import Plastic, plastic
from pestle.particle.shahin2021_radius import Coefficients, coefficients

REGIMES = ("e", "ep", "fp", "lc", "ev")
"""Elastic, elastic-plastic, fully plastic, low compressibility, elastic volumetric."""

YIELD_HARDNESS = 1.1


class Onset(NamedTuple):
    """Elastic and elastic-plastic regimes; the same in every configuration."""

    lam: Any
    contrast: Any  # A (R_1 + R_2)/4, 1 for equal radii [-]
    hardness_max: Any
    at_max: Any  # x at H_max [-]
    at_yield: Any  # x at first yield [-]
    c1: Any
    c2: Any


class Compaction(NamedTuple):
    """Low-compressibility and elastic volumetric regimes of a confined sphere."""

    zeta: Any
    hardness_min: Any
    chi_min: Any
    l: Any  # noqa: E741 - the thesis' symbol
    u: Any
    volume_loss: Any  # V_el/V_particle at zero porosity [-]
    chi_zero: Any  # chi at zero porosity [-]
    zero_porosity: Any  # x at zero porosity [-]


class Parameters(NamedTuple):
    """Everything that the law derives from lambda, zeta and the configuration."""

    configuration: str
    onset: Onset
    radius: Coefficients
    plastic: Plastic
    compaction: Compaction | None


def material_numbers(
    youngs_modulus: Any, poisson_ratio: Any, yield_stress: Any
) -> tuple[Any, Any]:
    """Lambda and zeta: plane-strain and bulk modulus over the yield stress [-]."""
    ratio = youngs_modulus / yield_stress
    return ratio / (1.0 - poisson_ratio**2), ratio / (3.0 * (1.0 - 2.0 * poisson_ratio))


def onset(lam: Any, contrast: Any = 1.0) -> Onset:
    """Elastic and elastic-plastic regimes (2.17)-(2.23).

    `contrast` is A (R_1 + R_2)/4 = (R_1 + R_2)^2/(4 R_1 R_2) for unequal radii.
    """
    hardness_max = 3.101 * np.tanh(0.6746 * lam**0.0829)  # (2.19)
    at_max = np.expm1(0.7073 / lam**0.6547)  # (2.20)
    at_yield = (3.3 * pi / (4.0 * lam)) ** 2 / contrast  # (2.17)
    rise, span = hardness_max - YIELD_HARDNESS, np.log(at_max / at_yield)
    c2 = span * 0.5 * YIELD_HARDNESS / rise  # (2.22)
    return Onset(lam, contrast, hardness_max, at_max, at_yield, rise * span**-c2, c2)


@cache
def smallest_lambda() -> float:
    """Smallest lambda with c_2 >= 1, that is with a finite slope at H_max (2.24) [-].

    Examples
    --------
    >>> round(smallest_lambda(), 4)  # 22.08 in print
    22.0931
    """
    from scipy.optimize import brentq

    return float(brentq(lambda lam: onset(lam).c2 - 1.0, 15.0, 100.0, xtol=1e-13))


def compaction(zeta: Any, law: Plastic, configuration: str) -> Compaction:
    """Low-compressibility regime that meets the volumetric one in C1 (2.43)-(2.47)."""
    chi_min = cell(law.lowest, configuration)
    rest = 1.0 / (1.0 + 0.2335 * zeta)  # 1 - l (2.47)
    l, log = 1.0 - rest, -np.log1p(0.2335 * zeta)  # noqa: E741
    h = law.hardness_min
    volume_loss = (2.0 * l * h / zeta + (1.0 - chi_min) * rest * log) / (
        2.0 * l + rest * log
    )  # (2.46)
    u = (h - zeta * volume_loss) / log  # (2.45)
    chi_zero = 1.0 - volume_loss  # (2.43)
    at_zero = deformation(chi_zero, configuration)
    return Compaction(zeta, h, chi_min, l, u, volume_loss, chi_zero, at_zero)


def parameters(lam: Any, zeta: Any, configuration: str) -> Parameters:
    """All parameters of the law for equal radii (2.14)-(2.47)."""
    start = onset(lam)
    d = coefficients(lam, configuration)
    q = 14.1819 * np.tanh(0.3729 * lam**0.1013)  # (2.39)
    r = np.exp(1.6199 / lam**0.3232)  # (2.40)
    middle = plastic(
        start.hardness_max,
        start.at_max,
        q,
        r,
        coefficients=d,
        configuration=configuration,
    )
    end = None if configuration == "simple" else compaction(zeta, middle, configuration)
    return Parameters(configuration, start, d, middle, end)


class Hardness(NamedTuple):
    """Mean contact pressure over the yield stress, or over kappa."""

    regime: Any  # index into REGIMES
    value: Any
    slope: Any  # dH/dx [-]


def hardness(x: Any, law: Parameters) -> Hardness:
    """H and its slope at deformations x, in every regime (2.48)."""
    x = np.asarray(x, dtype=float)
    start, middle, end = law.onset, law.plastic, law.compaction
    last = np.inf if end is None else end.zero_porosity
    regime = (
        (x > start.at_yield).astype(int)
        + (x > start.at_max)
        + (x > middle.lowest)
        + (x > last)
    )
    with np.errstate(divide="ignore", invalid="ignore"):  # branches not in use
        branches = [elastic(x, start), elastic_plastic(x, start), softened(x, middle)]
        branches += [] if end is None else list(confined(x, end, law.configuration))
    pick = [regime == n for n in range(len(branches))]
    value = np.select(pick, [b[0] for b in branches], np.nan)
    slope = np.select(pick, [b[1] for b in branches], np.nan)
    return Hardness(regime, value, slope)


def elastic(x: Any, k: Onset) -> tuple[Any, Any]:
    """H and slope of the elastic regime (2.15), (2.16)."""
    factor = 4.0 / (3.0 * pi) * k.lam * np.sqrt(k.contrast)
    root = np.sqrt(x)
    return factor * root, 0.5 * factor / root


def elastic_plastic(x: Any, k: Onset) -> tuple[Any, Any]:
    """H and slope of the elastic-plastic regime (2.18), (2.21)."""
    log = np.log(k.at_max / x)
    slope = k.c1 * k.c2 / x * log ** (k.c2 - 1.0)
    return k.hardness_max - k.c1 * log**k.c2, slope


def softened(x: Any, k: Plastic) -> tuple[Any, Any]:
    """H and slope of the plastic regime (2.25), (2.27)."""
    return k.hardness_max - k.p * k.softening.value(x), -k.p * k.softening.slope(x)


def confined(x: Any, k: Compaction, configuration: str) -> tuple[Any, Any]:
    """H and slope at low compressibility (2.41) and in the volumetric regime (2.44)."""
    chi, by_x = cell(x, configuration), cell_slope(x, configuration)
    width = k.chi_zero - k.chi_min
    w = (chi - k.chi_min) / width
    rest = 1.0 - k.l * w**2
    slope = 2.0 * k.u * k.l * w / rest / width * by_x
    return (k.hardness_min - k.u * np.log(rest), slope), (
        k.zeta * (1.0 - chi),
        -k.zeta * by_x,
    )
