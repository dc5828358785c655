r"""Storakers, Biwa and Larsson (1997): similarity law of power-law hardening spheres.

For sigma = sigma_0 eps^n (n = 1/m) and two spheres of the same n,

.. math::
    F = 2^{1-n/2}\,3^{1-n}\,\pi\,c^{2+n}\,\sigma_0\,R^*\,h\,(h/R^*)^{n/2}, \quad
    a^2 = 2c^2R^*h, \quad c^2 = 1.43\,e^{-0.97n}, \quad
    \sigma_0^{-1/n} = \sigma_1^{-1/n} + \sigma_2^{-1/n}

Below the overlap where Hertz's force is smaller the contact is elastic.  Unloading is
Hertz on the flattened sphere: F = F_max (h_e/h_max,e)^{3/2},
h_max,e = 3 F_max/(4 E* a).  The yield stress of the material is read as sigma_0, the
stress at a plastic strain of 1; with n = 0 it is the yield stress and the force is
3 sigma_0 pi a^2.  No adhesion.

References: B. Storakers, S. Biwa, P.-L. Larsson, Int. J. Solids Struct. 34 (1997)
3061-3083; S. Biwa, B. Storakers, J. Mech. Phys. Solids 43 (1995) 1303-1333.
"""

from dataclasses import dataclass
from math import exp, inf, pi, sqrt
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, parameter


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    modulus: float  # E* [Pa]
    factor: float  # F/(R* h (h/R*)^(n/2)) [Pa]
    exponent: float  # n/2 [-]
    patch: float  # 2 c^2 [-]


class State(NamedTuple):
    """What a contact remembers; zero at first touch."""

    peak: float  # largest overlap once yielded [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Storakers1997(PairLaw):
    """Power-law hardening spheres, elastic unloading."""

    hardening_exponent: float = parameter(
        "n = 1/m in sigma = sigma_0 eps^n; 0 is perfectly plastic",
        "1",
        0.0,
        1.0,
        "[)",
        default=0.0,
    )

    name: ClassVar[str] = "storakers1997"
    summary: ClassVar[str] = "similarity law (Biwa) with power-law hardening"
    validity: ClassVar[str] = (
        "small strain, x up to about 0.03; contacts independent of each other"
    )
    requires: ClassVar[tuple[str, ...]] = ("yield_stress",)
    citation: ClassVar[str] = cite("storakers1997")

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        n = self.hardening_exponent
        patch = 1.43 * exp(-0.97 * n)  # c^2
        strength = combined(pair.first.yield_stress, pair.second.yield_stress, n)
        shape = 2.0 ** (1.0 - 0.5 * n) * 3.0 ** (1.0 - n) * patch ** (1.0 + 0.5 * n)
        return Constants(pair.modulus, shape * pi * strength, 0.5 * n, 2.0 * patch)


def combined(first: float, second: float, n: float) -> float:
    """Strength sigma_0 of a pair of strengths [Pa] with the same exponent."""
    low, high = min(first, second), max(first, second)
    if n == 0.0 or high == inf:
        return low
    return low * (1.0 + (low / high) ** (1.0 / n)) ** -n


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, contact radius, stiffness and energy at an overlap."""
    h = max(g.overlap, 0.0)
    round_ = sqrt(g.radius * h)
    hertz = 4.0 / 3.0 * k.modulus * round_ * h
    peak = max(s.peak, h)
    top = k.factor * g.radius * peak * (peak / g.radius) ** k.exponent
    flows = h >= s.peak and top < hertz
    yielded = flows or s.peak > 0.0
    wide = sqrt(k.patch * g.radius * peak)
    spring = 0.75 * top / (k.modulus * wide + 1e-300)  # elastic part of the peak
    part = min(max((h - peak) / (spring + 1e-300) + 1.0, 0.0), 1.0)
    narrow = sqrt(part)
    force = top * part * narrow
    a = wide * narrow
    slope = (1.0 + k.exponent) * top / (h + 1e-300) if flows else 2.0 * k.modulus * a
    on = h > 0.0
    return (
        Response(
            force if yielded else hertz,
            a if yielded else round_,
            slope if yielded else 2.0 * k.modulus * round_,
            0.4 * (force * spring * part if yielded else hertz * h),
            1.0,
        ),
        State(peak if yielded and on else 0.0),
    )


register(Storakers1997, constants=Constants, state=State, contact=contact)
