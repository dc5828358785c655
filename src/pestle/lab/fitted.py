"""A law of unloading with constants of one's own lab: Edmans and Sinka, (1)-(3)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from pestle.errors import InputError
from pestle.lab import fits
from pestle.particle.edmans2020 import Unloading as PowerLaw
from pestle.particle.edmans2020 import exponent, power_law
from pestle.particle.law import Array, Curve, Peak, Unloading


@dataclass(frozen=True, kw_only=True)
class FittedUnloading(Unloading):
    """Power law of Edmans and Sinka with a secant stiffness fitted to the lab.

    Parameters
    ----------
    youngs_modulus, poisson_ratio, yield_stress : float
        E [Pa], nu [-], Y [Pa].
    gammas : tuple of float
        The five constants of Eq. (3) [-].
    """

    youngs_modulus: float
    poisson_ratio: float
    yield_stress: float
    gammas: tuple[float, ...]

    name: ClassVar[str] = "edmans2020-lab"
    summary: ClassVar[str] = "unloading with constants of one's own lab"
    validity: ClassVar[str] = "the grid that the constants were fitted to"
    citation: ClassVar[str] = ""

    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force below a peak (2); this law has no contact radius."""
        ratio = self.youngs_modulus / self.yield_stress
        largest = np.asarray(peak.displacement / peak.radius)
        nu = np.asarray(self.poisson_ratio)
        rho = fits.secant_stiffness(self.gammas, largest, np.asarray(ratio), nu)
        alpha = exponent(largest, ratio, self.poisson_ratio)
        return power_law(displacement, peak, PowerLaw(rho, alpha))


def from_file(path: Path, **material: Any) -> FittedUnloading:
    """Law of a parameter set that `pestle lab study edmans2020` wrote.

    Parameters
    ----------
    path : Path
        The parameter set.
    **material : float
        youngs_modulus, poisson_ratio, yield_stress.
    """
    study, constants = fits.load(path)
    if study != "edmans2020":
        raise InputError(
            "parameter-set-of-another-study",
            f"{path} holds constants of {study}, not of a law of unloading",
            hint="use a set that `pestle lab study edmans2020` wrote",
        )
    return FittedUnloading(gammas=tuple(constants.values()), **material)
