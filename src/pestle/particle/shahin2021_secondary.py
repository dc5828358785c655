r"""Shahin (2021), section 2.6: the standing contacts of a die.

Small deformations, x <= 0.1 of the moving contacts: the bulging sphere overlaps the
wall by

.. math:: \gamma_s = \tau \gamma^\omega, \quad x_s = \tau\, 20^{\omega-1} x^\omega
    \tag{2.49}

where the second form is free of the millimetres and the R = 10 mm that the fit used
(an ideally plastic sphere has no length of its own).  Radius and hardness are those of
chapter 2 at x_s.  Once the cell fills (2.52), all contacts have the hardness of the
moving ones.  In between the thesis has no law, nor is there one for the radius beyond
x = 0.1.  The thesis does not say which b_i the radius takes: "die" by default.
"""

from math import pi, sqrt
from typing import Any, NamedTuple

import numpy as np

from pestle.errors import InputError
from pestle.particle.shahin2021_hardness import (
    Hardness,
    Onset,
    Parameters,
    elastic,
    elastic_plastic,
    hardness,
)
from pestle.particle.shahin2021_plastic import GAMMA
from pestle.particle.shahin2021_radius import Coefficients, relative_radius

LARGEST = 0.1
"""Largest deformation of the moving contacts for the small law [-]."""


class Growth(NamedTuple):
    """How the standing contacts follow the moving ones."""

    tau: Any  # (2.50), in mm^(1 - omega) as fitted
    omega: Any  # (2.51) [-]
    relative: Any  # tau 20^(omega - 1) [-]


def growth(lam: Any) -> Growth:
    """Constants of (2.49) at lambda (2.50), (2.51)."""
    tau = 1.0 / (1480.8863 * np.tanh(5.0261e-5 * lam**1.2889))
    omega = 5.7775 * np.tanh(0.0159 * lam**0.6146)
    return Growth(tau, omega, tau * 20.0 ** (omega - 1.0))


class SmallContact(NamedTuple):
    """Standing contact at small deformation."""

    overlap: Any  # x_s [-]
    radius: Any  # a_s/R [-]
    hardness: Hardness


def small(x: Any, start: Onset, d: Coefficients) -> SmallContact:
    """Standing contact while x <= 0.1 (2.49), (2.13), (2.15), (2.18).

    Parameters
    ----------
    x : float or array
        Deformation of the moving contacts [-].
    start : Onset
        Elastic and elastic-plastic regimes of the material.
    d : Coefficients
        Coefficients of the radius; those of "die" unless one has a reason.
    """
    x = np.asarray(x, dtype=float)
    if np.any(x > LARGEST):
        raise InputError(
            "no-law-for-standing-contact",
            f"the standing contacts of a die have no law at x = {np.max(x):.4g}",
            hint="the small law holds for x <= 0.1, the hardness from the onset of "
            "low compressibility (x near 0.41) on",
        )
    law = growth(start.lam)
    x_s = law.relative * x**law.omega
    with np.errstate(divide="ignore", invalid="ignore"):
        branches = elastic(x_s, start), elastic_plastic(x_s, start)
    plastic = x_s > start.at_yield
    value, slope = (np.where(plastic, b, a) for a, b in zip(*branches, strict=True))
    return SmallContact(
        x_s, relative_radius(x_s, d), Hardness(plastic.astype(int), value, slope)
    )


def large(x: Any, law: Parameters, *, onset: float) -> Hardness:
    """Hardness of all contacts once the cell fills, from x = `onset` on (2.41), (2.44).

    The onset follows from (2.52) with the area of the standing contact, which the law
    does not give; Table 2.4 has 0.4098 to 0.4159 from finite elements.
    """
    x = np.asarray(x, dtype=float)
    if np.any(x < onset):
        raise InputError(
            "no-law-for-standing-contact",
            f"the standing contacts of a die have no law at x = {np.min(x):.4g}, "
            f"before low compressibility begins at {onset:.4g}",
            hint="the small law holds for x <= 0.1",
        )
    return hardness(x, law)


def radius_at_onset(onset: float) -> float:
    """Contact radius a_s/R at which (2.52) reaches Gamma at a deformation [-].

    Examples
    --------
    >>> round(radius_at_onset(0.4159), 4)  # Table 2.4, lambda = 163.08
    0.5433
    """
    return 12.0 * sqrt(GAMMA) * (1.0 - onset) / pi
