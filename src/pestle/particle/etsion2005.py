r"""Etsion, Kligerman and Kadin (2005): unloading of an elastic-plastic sphere.

.. math::
    \frac{1}{\rho} &= [1 - (1 - \hat d^{-0.28})(1 - \hat d^{-0.69})] d_{max},
        \quad \hat d = d_{max}/d_c                                     \tag{9} \\
    \alpha &= 1.5\, \hat d^{-0.0331}                                   \tag{6}

Equations as numbered by Edmans and Sinka (2020), with their power law (2) and their
d_c (5).  Fitted for 297 <= E/sigma_y <= 2464 and d_max/d_c <= 170.  Up to first yield
everything is recovered, rho = 1/d_max.

Reference: I. Etsion, Y. Kligerman and Y. Kadin, Int. J. Solids Struct. 42 (2005)
3716-3729.
"""

from typing import Any

import numpy as np


def secant_stiffness(largest: Any, d_c: Any) -> Any:
    """Secant stiffness rho of unloading (9) [-]."""
    ratio = np.maximum(largest / d_c, 1.0)
    left = 1.0 - (1.0 - ratio**-0.28) * (1.0 - ratio**-0.69)
    return 1.0 / (left * largest)


def exponent(largest: Any, d_c: Any) -> Any:
    """Exponent alpha as fitted (6), without limits [-]."""
    return 1.5 * (largest / d_c) ** -0.0331
