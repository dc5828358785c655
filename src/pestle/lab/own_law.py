"""A law of one's own material: Shahin's simple compression with fitted constants.

The forms are those of the thesis, chapter 2: three coefficients of the radius (2.13),
and the largest hardness, where it is, and q and r of the way down from it (2.18),
(2.25).  There they are functions of lambda fitted to 17 materials; here they are
numbers of one.
"""

from dataclasses import dataclass, field
from math import pi
from typing import Any, ClassVar

import numpy as np

from pestle.errors import InputError
from pestle.lab.fits import QUANTILES, Fit
from pestle.lab.mesh import Floats
from pestle.lab.press import Result
from pestle.particle import shahin2021_hardness as forms
from pestle.particle.law import Array, Curve, Loading
from pestle.particle.shahin2021_plastic import plastic
from pestle.particle.shahin2021_radius import Coefficients, relative_radius

LEAST = 0.01
"""Smaller depths are left out of the fit: their contact has few nodes [R]."""
NAMES = ("D_1", "D_3", "D_5", "hardness_max", "at_max", "q", "r")


@dataclass(frozen=True, kw_only=True)
class OwnShahin(Loading):
    """Simple compression after Shahin with constants of one's own.

    Parameters
    ----------
    youngs_modulus, poisson_ratio, yield_stress : float
        E [Pa], nu [-], sigma_y [Pa].
    constants : tuple of float
        D_1, D_3, D_5, largest hardness, the x of it, q, r [-].
    """

    youngs_modulus: float
    poisson_ratio: float
    yield_stress: float
    constants: tuple[float, ...] = field(default=())

    name: ClassVar[str] = "shahin2021-lab"
    summary: ClassVar[str] = "simple compression with constants of one's own lab"
    validity: ClassVar[str] = "the material and the depths that it was fitted to"
    citation: ClassVar[str] = ""
    configurations: ClassVar[tuple[str, ...]] = ("simple",)

    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        lam, _ = forms.material_numbers(
            self.youngs_modulus, self.poisson_ratio, self.yield_stress
        )
        d = Coefficients(*self.constants[:3])
        a = relative_radius(x, d) * radius
        value = hardness(x, float(lam), self.constants)
        return Curve(np.asarray(value * self.yield_stress * pi * a**2), a)


def hardness(x: Array, lam: float, constants: Any) -> Floats:
    """Hardness of the thesis' regimes with one's own constants [-]."""
    top, at_max, q, r = (float(c) for c in constants[3:])
    start = forms.onset(lam)
    rise, span = top - forms.YIELD_HARDNESS, np.log(at_max / start.at_yield)
    c2 = span * 0.5 * forms.YIELD_HARDNESS / rise  # (2.22)
    start = start._replace(hardness_max=top, at_max=at_max, c1=rise * span**-c2, c2=c2)
    d = Coefficients(*constants[:3])
    middle = plastic(top, at_max, q, r, coefficients=d, configuration="simple")
    law = forms.Parameters("simple", start, d, middle, None)
    return np.asarray(forms.hardness(x, law).value, dtype=float)


def fit_shahin(result: Result) -> Fit:
    """Fit radius and hardness of one loading, each by least squares, as the thesis.

    Parameters
    ----------
    result : Result
        A loading of a perfectly plastic sphere.
    """
    from scipy.optimize import least_squares

    material = result.sphere.material
    points = [p for p in result.loading if p.depth >= LEAST]
    if len(points) < 20 or points[-1].depth < 0.1:
        raise InputError(
            "too-few-results",
            f"{len(points)} steps beyond {LEAST:g} R are too few for seven constants",
            hint="load to 0.3 or deeper",
        )
    x, force, radius = np.array([(p.depth, p.force, p.radius) for p in points]).T
    lam, zeta = forms.material_numbers(
        1.0, material.poisson_ratio, material.yield_stress
    )
    published = forms.parameters(lam, zeta, "simple")
    powers = np.stack([x**0.5, -(x**1.5), x**2.5], axis=1)
    own, rest, *_ = np.linalg.lstsq(powers, radius, rcond=None)
    spread = np.sqrt(np.diag(np.linalg.inv(powers.T @ powers)) * rest / (len(x) - 3))
    measured = force / (pi * radius**2) * material.modulus_ratio

    def miss(theta: Floats) -> Floats:
        found = hardness(x, float(lam), (*own, *theta))
        return np.asarray(np.nan_to_num(found / measured - 1.0, nan=1e3))

    before = (
        *(published.onset.hardness_max, published.onset.at_max),
        *(published.plastic.simple.q, published.plastic.simple.r),
    )
    start = np.array(before, dtype=float)
    low = np.array([1.3, 3.0 * float(published.onset.at_yield), 0.5, 0.3])
    found = least_squares(
        miss, np.clip(start, low, (5.0, 0.2, 40.0, 8.0)), bounds=(low, (5, 0.2, 40, 8))
    )
    scale = float(found.fun @ found.fun) / (len(x) - 4)
    slopes = np.asarray(found.jac)
    other = np.sqrt(np.diag(np.linalg.pinv(slopes.T @ slopes)) * scale)
    constants = tuple(float(c) for c in (*own, *found.x))
    old = tuple(float(c) for c in (*published.radius, *before))
    return Fit(
        "shahin2021",
        "simple compression: radius (2.13), hardness (2.18), (2.25)",
        NAMES,
        constants,
        old,
        _errors(x, force, float(lam), constants, material.yield_stress),
        _errors(x, force, float(lam), old, material.yield_stress),
        len(x),
        tuple(float(s) for s in (*spread, *other)),
    )


def _errors(
    x: Floats, force: Floats, lam: float, constants: tuple[float, ...], stress: float
) -> tuple[float, ...]:
    """Quantiles of the relative error of the force."""
    a = relative_radius(x, Coefficients(*constants[:3]))
    own = hardness(x, lam, constants) * stress * pi * a**2
    return tuple(float(q) for q in np.quantile(np.abs(own / force - 1.0), QUANTILES))
