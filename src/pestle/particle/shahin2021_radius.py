r"""Shahin (2021), contact radius: a similarity law with two corrections for curvature.

.. math::
    a &= D_1 \frac{\gamma^{1/2}}{A^{1/2}} - D_3 \frac{B}{A^{5/2}} \gamma^{3/2}
        + D_5 \frac{B^2}{A^{9/2}} \gamma^{5/2}                        \tag{2.13} \\
    D_i &= b_i^{i/2}\, \alpha_i \tanh(\beta_i \lambda^{\delta_i})      \tag{2.14}

with :math:`A = 1/R_1 + 1/R_2`, :math:`B = 1/R_1^3 + 1/R_2^3`, and for equal radii
:math:`a/R = D_1 x^{1/2} - D_3 x^{3/2} + D_5 x^{5/2}`.  With hardening each D_i of the
rigid-plastic limit gets a factor of the exponent h = 1/m (3.47).  Printed is
:math:`b_i^{1/2}`; the power is i/2, as Table 3.1 and Table C.1 prove.
"""

from typing import Any, NamedTuple

import numpy as np

ALPHA = (1.7527, 2.3702, 3.3715)
BETA = (0.3540, 0.0411, 0.0634)
DELTA = (0.2633, 0.5366, 0.4766)
B_OF = {
    "simple": (1.0, 1.0, 1.0),
    "die": (1.048, 1.1818, 1.2352),
    "hydrostatic": (1.1701, 2.4002, 2.9376),
}
"""Table 2.2."""


class Coefficients(NamedTuple):
    """Coefficients of the contact radius [-]."""

    d1: Any
    d3: Any
    d5: Any


def coefficients(lam: Any, configuration: str) -> Coefficients:
    """D_1, D_3, D_5 at lambda = E/((1 - nu^2) sigma_y) (2.14) [-]."""
    rigid = rigid_coefficients(configuration)
    return Coefficients(
        *(
            d * np.tanh(beta * lam**delta)
            for d, beta, delta in zip(rigid, BETA, DELTA, strict=True)
        )
    )


def rigid_coefficients(configuration: str, hardening: float = 0.0) -> Coefficients:
    """D_1, D_3, D_5 of a rigid-plastic sphere with sigma = kappa eps^h (3.47) [-].

    Examples
    --------
    >>> [round(d, 4) for d in rigid_coefficients("die")]  # Table 3.1
    [1.7943, 3.0451, 5.717]
    """
    h = hardening
    factors = np.exp(-0.485 * h), np.exp(-1.455 * h), np.exp(-0.5279 * h**0.4616)
    powers, b = (0.5, 1.5, 2.5), B_OF[configuration]
    rows = zip(b, powers, ALPHA, factors, strict=True)
    return Coefficients(*(float(b**p * alpha * f) for b, p, alpha, f in rows))


def relative_radius(x: Any, d: Coefficients) -> Any:
    """Contact radius over R for equal radii at x = gamma/2R (2.13) [-]."""
    return np.sqrt(x) * (d.d1 - x * (d.d3 - x * d.d5))


def relative_radius_slope(x: Any, d: Coefficients) -> Any:
    """Derivative of the relative radius with x [-]."""
    return (0.5 * d.d1 - x * (1.5 * d.d3 - 2.5 * x * d.d5)) / np.sqrt(x)


def contact_radius(gamma: Any, radius_1: Any, radius_2: Any, d: Coefficients) -> Any:
    """Contact radius of two spheres at an approach gamma (2.13), (3.10), (3.47) [m]."""
    a, b = 1.0 / radius_1 + 1.0 / radius_2, radius_1**-3 + radius_2**-3
    root = np.sqrt(gamma / a)
    z = b * gamma / a**2
    return root * (d.d1 - z * (d.d3 - z * d.d5))
