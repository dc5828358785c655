r"""Thornton and Ning (1998): elastic-plastic adhesive spheres.

JKR until the pressure in the middle of the contact reaches p_y, then a force that grows
with the contact radius at that pressure, then JKR on a flatter sphere of radius R_p,
shifted so that force and contact radius are continuous:

.. math::
    P = P_y + \pi p_y(a^2-a_y^2) - \tfrac23\sqrt{2\pi WE^*}(a^{3/2}-a_y^{3/2}), \quad
    R_p = \frac{R P_1}{P(a_*) + \sqrt{4P_cP_1}}

The overlap of a loading contact stays that of JKR.  A yielded contact that has parted
attaches again where its flattened surfaces touch, and is as new once they lie apart
(overlap below 0); the paper is silent on both.  Formulas: `pestle.reference.
thornton_ning1998`, from a digest of the paper, not checked against print.

Reference: C. Thornton, Z. Ning, Powder Technol. 99 (1998) 154-162.
"""

import warnings
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, choice
from pestle.reference.jkr_contact import (
    contact_radius,
    energy_at,
    force_at,
    overlap_at,
    separation_length,
    stiffness_at,
)
from pestle.reference.nan2022_energy import yield_pressure
from pestle.reference.thornton_ning1998 import (
    VARIANTS,
    flattened_radius,
    overlap_slope,
    plastic_force,
    yield_radius,
)


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    modulus: float  # E* [Pa]
    adhesion: float  # W [J/m^2]
    pressure: float  # p_y of the softer body [Pa]
    variant: float  # of the force after yield


class State(NamedTuple):
    """What a contact remembers; zero before the first touch."""

    widest: float  # largest contact radius a_* once yielded [m]
    attached: float  # 1 in contact


@dataclass(frozen=True, slots=True, kw_only=True)
class ThorntonNing1998(PairLaw):
    """JKR with a limiting pressure and plastic flattening."""

    variant: str = choice(
        'force after yield: "tangent" reproduces Ning\'s curves, "exact" integrates '
        "the truncated JKR pressure",
        VARIANTS,
        default="tangent",
    )

    name: ClassVar[str] = "thornton_ning1998"
    summary: ClassVar[str] = "JKR with yield and plastic flattening, non-linear"
    validity: ClassVar[str] = (
        "small overlaps, whose loading stays JKR's; not where adhesion alone makes a "
        "contact yield"
    )
    requires: ClassVar[tuple[str, ...]] = ("yield_stress",)
    citation: ClassVar[str] = cite("thornton1998")

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials; p_y is that of Jackson and Green."""
        sides = (pair.first, pair.second)
        pressure = min(yield_pressure(s.yield_stress, s.poisson_ratio) for s in sides)
        variant = float(VARIANTS.index(self.variant))
        return Constants(pair.modulus, pair.work_of_adhesion, pressure, variant)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, contact radius, stiffness and energy at an overlap."""
    e, r, w = k.modulus, g.radius, k.adhesion
    yields = yield_radius(e, r, w, k.pressure)
    widest = max(s.widest, yields)
    # on loading JKR of R*, after yield JKR of R_p, shifted.  Factors of 0 and 1 instead
    # of branches keep the engine's loop SIMD
    loads = g.overlap > overlap_at(widest, e, r, w)
    top, _ = plastic_force(widest, yields, e, r, w, k.pressure, k.variant)
    flat = flattened_radius(widest, top, e, r, w)
    lies = 1.0 if s.widest > 0.0 and not loads else 0.0
    own = flat * lies + r * (1.0 - lies)
    shift = widest * widest * (1.0 / r - 1.0 / flat) * lies
    a = contact_radius(g.overlap - shift, e, own, w)
    least = shift - separation_length(e, own, w)
    on = g.overlap >= (least if s.attached > 0.0 else shift)
    held = 1.0 if on else 0.0
    flows = 1.0 if on and loads and a > yields else 0.0
    wide = max(a, yields)
    force, rise = plastic_force(wide, yields, e, r, w, k.pressure, k.variant)
    steep = max(rise / overlap_slope(wide, e, r, w), 0.0)
    curved = flattened_radius(wide, force, e, r, w) * flows + own * (1.0 - flows)
    force = force * flows + force_at(a, e, own, w) * (1.0 - flows)
    slope = steep * flows + stiffness_at(a, e, own, w) * (1.0 - flows)
    stored = energy_at(a, e, curved, w)
    kept = 1.0 if on or g.overlap >= 0.0 else 0.0
    widest = (a * flows + s.widest * (1.0 - flows)) * kept
    return (
        Response(force * held, a * held, slope * held, stored * held, 1.0),
        State(widest, held),
    )


def reach(k: Constants, g: Geometry) -> float:
    """Negative overlap at which an unyielded contact parts, the farthest of all [m]."""
    e, r, w = k.modulus, g.radius, k.adhesion
    if w > 0.0 and yield_radius(e, r, w, k.pressure) < contact_radius(0.0, e, r, w):
        warnings.warn(
            f"thornton_ning1998: at R* = {r:.3g} m adhesion alone presses a contact "
            "beyond its yield pressure; the law was made for contacts that touch "
            "elastically, and its forces fall to nothing there",
            stacklevel=2,
        )
    return separation_length(k.modulus, g.radius, k.adhesion)


register(
    ThorntonNing1998, constants=Constants, state=State, contact=contact, reach=reach
)
