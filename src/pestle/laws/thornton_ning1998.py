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

from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple

from pestle.errors import InputError
from pestle.laws._base import Geometry, Pair, Response, register
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
class ThorntonNing1998:
    """JKR with a limiting pressure and plastic flattening.

    Parameters
    ----------
    variant : str
        Force after yield: ``"tangent"`` (reproduces Ning's curves), ``"exact"`` (the
        truncated JKR pressure integrated) or ``"ay_over_a"``.
    """

    variant: str = field(
        default="tangent",
        metadata={"help": "force after yield", "choices": VARIANTS},
    )

    name: ClassVar[str] = "thornton_ning1998"
    summary: ClassVar[str] = "JKR with yield and plastic flattening, non-linear"
    requires: ClassVar[tuple[str, ...]] = ("yield_stress",)
    citation: ClassVar[str] = (
        "@article{thornton1998, author={Thornton, Colin and Ning, Zemin}, title={A "
        "theoretical model for the stick/bounce behaviour of adhesive, elastic-plastic "
        "spheres}, journal={Powder Technology}, volume={99}, pages={154--162}, "
        "year={1998}, doi={10.1016/S0032-5910(98)00099-0}}"
    )

    def __post_init__(self) -> None:
        """Check the options."""
        if self.variant not in VARIANTS:
            raise InputError(
                "unknown-choice",
                f"variant {self.variant!r} is none of {', '.join(VARIANTS)}",
                "law.variant",
            )

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
    # on loading JKR of R*, after yield JKR of R_p, shifted
    loads = g.overlap > overlap_at(widest, e, r, w)
    flowed = s.widest > 0.0
    top, _ = plastic_force(widest, yields, e, r, w, k.pressure, k.variant)
    flat = flattened_radius(widest, top, e, r, w)
    own = flat if flowed and not loads else r
    shift = 0.0 if loads or not flowed else widest * widest * (1.0 / r - 1.0 / flat)
    a = contact_radius(g.overlap - shift, e, own, w)
    least = shift - separation_length(e, own, w)
    on = g.overlap >= (least if s.attached > 0.0 else shift)
    flows = on and loads and a > yields
    back = force_at(a, e, own, w)
    slope = stiffness_at(a, e, own, w)
    force, rise = plastic_force(max(a, yields), yields, e, r, w, k.pressure, k.variant)
    steep = rise / overlap_slope(max(a, yields), e, r, w)
    curved = flattened_radius(a, force, e, r, w) if flows else own
    widest = a if flows else s.widest
    return (
        Response(
            (force if flows else back) if on else 0.0,
            a if on else 0.0,
            (max(steep, 0.0) if flows else slope) if on else 0.0,
            energy_at(a, e, curved, w) if on else 0.0,
            1.0,
        ),
        State(widest if on or g.overlap >= 0.0 else 0.0, 1.0 if on else 0.0),
    )


def reach(k: Constants, g: Geometry) -> float:
    """Negative overlap at which an unyielded contact parts, the farthest of all [m]."""
    return separation_length(k.modulus, g.radius, k.adhesion)


register(
    ThorntonNing1998, constants=Constants, state=State, contact=contact, reach=reach
)
