r"""What an MDR particle keeps: its sums over contacts, growth and bulk response.

Equation numbers are those of Zunker & Kamrin (2024), Part I; [Dn] are decisions of the
reading notes.
"""

from math import pi
from typing import TYPE_CHECKING, NamedTuple

from pestle.laws._base import Geometry

if TYPE_CHECKING:
    from pestle.laws._mdr_quantities import Side, SideConstants


class Particle(NamedTuple):
    """What a particle knows besides its apparent radius."""

    initial_radius: float  # R_o [m]
    volume: float  # elastic volume V = V_o (1 + eps) [m^3]
    free: float  # free-surface fraction psi [-]
    onset: float  # volume beyond the flats at the onset of bulk response, else -1 [m^3]
    sunk: float  # mean displacement of the surface in the bulk response [m]
    sunk_before: float  # the same a step ago [m]
    pressure: float  # of the bulk response [Pa]
    pressure_before: float  # the same a step ago [Pa]
    firmness: float  # rise of the pressure with the mean displacement [Pa/m]
    growth: float  # last growth of R [m]
    energy: float  # held by the bulk response, to which all contacts give [J]


class Sums(NamedTuple):
    """What one side of a contact adds to its particle in one step."""

    volume: float  # volume displaced by the flat's motion [m^3]
    caps: float  # 2 pi R delta, area of the caps [m^2]
    flows: float  # 1 if a yielded contact moves inwards at its maximum
    excess: float  # contact area minus caps at the maximum, A' [m^2]
    area: float  # contact area [m^2]
    cut: float  # area cut from the sphere [m^2]
    inside: float  # volume of the cap beyond the flat [m^3]
    swept: float  # by how much it will grow if the flat moves on as it did [m^3]
    strain: float  # elastic volume strain [-]
    imbalance: float  # |F_i - F_j| [N]
    worked: float  # given to the bulk response in this step [J]


def sums(
    k: "SideConstants",
    particle: Particle,
    g: Geometry,
    radius: float,
    flat: float,
    flat_old: float,
    moved: float,
    force: float,
    a: "Side",
    imbalance: float,
) -> Sums:
    """Return what a side adds to its particle."""
    first = particle.initial_radius
    grown = radius - first
    d = max(flat + grown, 0.0)
    step = flat - flat_old
    active = a.radius + a.push > 0.0  # transmits force or adheres [D17]
    strain = -force * (first - flat) / (3.0 * k.bulk * particle.volume)  # (38) [D11]
    displaced = pi * step * (2.0 * flat * first - flat * flat + radius**2 - first**2)
    flows = a.at_peak > 0.0 and a.offset < 0.0 and step > 0.0
    mean = 0.5 * (particle.pressure + particle.pressure_before)
    return Sums(
        g.weight * displaced if active else 0.0,
        g.weight * 2.0 * pi * radius * d if active else 0.0,
        1.0 if flows or k.always > 0.0 else 0.0,
        g.weight * (a.area - 2.0 * pi * radius * max(a.depth + particle.sunk, 0.0)),
        g.weight * a.area,
        g.weight * a.cut,
        g.weight * pi * d * d * (radius - d * (1.0 / 3.0)),
        g.weight * a.cut * moved,
        strain,
        imbalance,
        g.weight * (a.sinking + mean * a.cut * step),
    )


def update(
    c: tuple[float, float], radius: float, p: Particle, s: Sums
) -> tuple[float, Particle]:
    """New apparent radius (37) and particle state from the sums of one step.

    In the bulk response the volume x V_o that the flats press into a particle since
    its onset can no longer flow to a free surface: it raises a pressure
    p = kappa x / (1 - x) and sinks the surface by x V_o over the area of the flats.
    """
    first = p.initial_radius
    whole = 4.0 / 3.0 * pi * first**3
    sphere = 4.0 * pi * radius * radius
    strain = max(s.strain, -0.5)
    surface = sphere + s.excess
    free = (surface - s.area) / surface if surface > 0.0 else 0.0
    bulk = free < c[1] or (p.onset >= 0.0 and s.inside > p.onset)
    # (37); the open part of the sphere ends at 0: growth fades out below a tenth of it
    open_part = max(1.0 - s.caps / sphere, 0.0)
    fade = min(open_part * 10.0, 1.0)
    fade = fade * fade * (3.0 - 2.0 * fade)
    growth = 0.0
    if s.flows > 0.0 and not bulk and open_part > 0.0:
        elastic = whole * (1.0 + strain) - p.volume  # -Delta V^e
        growth = max((s.volume + elastic) / (sphere * open_part), 0.0) * fade
        growth = min(growth, 1e-3 * first)
    onset = s.inside if p.onset < 0.0 else p.onset
    pressed = max(s.inside + s.swept - onset, 0.0) if bulk else 0.0
    x = min(pressed / whole, 0.9)
    per_volume = c[0] / (whole * (1.0 - x))
    return radius + growth, Particle(
        first,
        whole * (1.0 + strain),
        free,
        onset if bulk else -1.0,
        pressed / s.cut if s.cut > 0.0 else 0.0,
        p.sunk,
        x * whole * per_volume,
        p.pressure,
        per_volume * s.cut if bulk else 0.0,
        growth,
        max(p.energy + s.worked, 0.0) if bulk or s.worked != 0.0 else 0.0,
    )
