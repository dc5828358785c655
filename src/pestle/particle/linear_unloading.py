r"""Luding (2008), Walton and Braun (1986): linear unloading, the stiffer the later.

With the secant stiffness of loading k_1 = F_max/d_max,

.. math::
    k_2 &= k_1 + (k_{2,max} - k_1) \min(d_{max}/d_c^*, 1)   \tag{7, Luding} \\
    k_2 &= k_1 + S F_{max}                                  \tag{Walton and Braun} \\
    F &= F_{max} - k_2 (d_{max} - d), \quad k_2/k_1 = \rho d_{max}    \tag{8}

Equations as numbered by Edmans and Sinka (2020), who print (7) without the cap.

References: S. Luding, Granul. Matter 10 (2008) 235-246; O. R. Walton and R. L. Braun,
J. Rheol. 30 (1986) 949-980.
"""

from typing import Any

import numpy as np


def luding_stiffness(k1: Any, k2_max: Any, largest: Any, transition: Any) -> Any:
    """Unloading stiffness k_2, at most k_2max (7); any unit of stiffness.

    Examples
    --------
    >>> float(luding_stiffness(1.0, 5.0, 0.4, 0.2))
    5.0
    """
    return k1 + (k2_max - k1) * np.minimum(largest / transition, 1.0)


def walton_stiffness(k1: Any, slope: Any, force_max: Any) -> Any:
    """Unloading stiffness k_2 = k_1 + S F_max; `slope` S [1/displacement]."""
    return k1 + slope * force_max
