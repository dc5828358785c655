"""A law of unloading with constants of one's own lab: Edmans and Sinka, (1)-(3)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from pestle.errors import InputError
from pestle.lab import fits
from pestle.lab.own_law import NAMES, OwnShahin
from pestle.particle import Zunker2024
from pestle.particle.edmans2020 import Unloading as PowerLaw
from pestle.particle.edmans2020 import exponent, power_law
from pestle.particle.law import Array, Curve, Loading, Peak, Unloading


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


def loading_from_file(path: Path, **material: Any) -> Loading:
    """Law of loading of a parameter set that the lab wrote.

    Parameters
    ----------
    path : Path
        What `pestle lab law` or `pestle lab study zunker2024` wrote.
    **material : float
        youngs_modulus, poisson_ratio, yield_stress.
    """
    study, constants = fits.load(path)
    if study == "zunker2024" and set(constants) == {"a", "b"}:
        return Zunker2024(
            hardening_rise=constants["a"], hardening_decay=constants["b"], **material
        )
    if study == "shahin2021" and set(constants) == set(NAMES):
        return OwnShahin(constants=tuple(constants[k] for k in NAMES), **material)
    raise InputError(
        "parameter-set-of-another-study",
        f"{path} holds constants of {study}, not those of a law of loading",
        hint="use a set that `pestle lab law` wrote; one of edmans2020 stands behind a "
        "plus: shahin2021+mine.toml",
    )


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
