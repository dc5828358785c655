r"""Hollomon's and Ludwik's hardening, and the fit of one to the other.

.. math::
    \sigma = \kappa\, \epsilon^{h}, \qquad
    \sigma = \sigma_y + K \epsilon_{pl}^{1/n}, \quad
    \epsilon_{pl} = \epsilon - \sigma/E \tag{3.1-3.3}

Both fits are least squares without weights over plastic strains
:math:`\epsilon_j = j\, \epsilon_{max}/N`.  The thesis gives no range; 1.5
reproduces its numbers for lead.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

TIGHT: dict[str, Any] = {"xtol": 1e-14, "ftol": 1e-14, "gtol": 1e-14}
"""The fits end at round-off."""


class Hollomon(NamedTuple):
    """Strength kappa [Pa] and exponent h = 1/m [-]."""

    strength: float
    exponent: float


class Ludwik(NamedTuple):
    """Yield stress sigma_y [Pa], strength K [Pa], exponent 1/n [-], modulus E [Pa]."""

    yield_stress: float
    strength: float
    exponent: float
    youngs_modulus: float

    def stress(self, plastic_strain: NDArray[np.float64]) -> NDArray[np.float64]:
        """Stress at plastic strains (3.1) [Pa]."""
        return self.yield_stress + self.strength * plastic_strain**self.exponent


def strains(largest: float = 1.5, number: int = 1000) -> NDArray[np.float64]:
    """Plastic strains of the fits, without zero [-]."""
    return largest * np.arange(1, number + 1) / number


def hollomon_from_ludwik(
    material: Ludwik, plastic_strain: NDArray[np.float64]
) -> Hollomon:
    """Fit Hollomon's law to Ludwik's stress over the total strain.

    Examples
    --------
    >>> lead = Ludwik(5e6, 15.5e6, 1 / 2.857, 10e9)
    >>> fit = hollomon_from_ludwik(lead, strains())
    >>> round(fit.strength / 1e6, 2), round(1 / fit.exponent, 2)  # 20.5, 4.167 in print
    (20.49, 4.15)
    """
    from scipy.optimize import least_squares

    stress = material.stress(plastic_strain)
    strain, scale = plastic_strain + stress / material.youngs_modulus, stress[-1]

    def residual(v: NDArray[np.float64]) -> NDArray[np.float64]:
        return v[0] * strain ** v[1] - stress / scale

    fit = least_squares(residual, (1.0, 0.3), **TIGHT)
    return Hollomon(float(fit.x[0] * scale), float(fit.x[1]))


def ludwik_from_hollomon(
    material: Hollomon,
    plastic_strain: NDArray[np.float64],
    *,
    yield_stress: float,
    youngs_modulus: float,
) -> Ludwik:
    """Fit Ludwik's K and 1/n to Hollomon's stress at a given yield stress and modulus.

    The residual is kappa (eps_pl + sigma_L/E)^h - sigma_L(eps_pl).
    """
    from scipy.optimize import least_squares

    scale = material.strength

    def residual(v: NDArray[np.float64]) -> NDArray[np.float64]:
        stress = yield_stress / scale + v[0] * plastic_strain ** v[1]
        strain = plastic_strain + stress * scale / youngs_modulus
        return strain**material.exponent - stress

    fit = least_squares(residual, (1.0, max(material.exponent, 0.1)), **TIGHT)
    return Ludwik(
        yield_stress, float(fit.x[0] * scale), float(fit.x[1]), youngs_modulus
    )
