r"""One side of an MDR contact: a sphere of apparent radius R against a rigid flat.

Equation numbers are those of Zunker & Kamrin (2024), Part I; [Dn] are decisions of the
reading notes.  All functions are scalar and free of data-dependent loops, so that the
compiler turns the engine's loop over contacts into SIMD.
"""

from math import pi, sqrt
from typing import NamedTuple

from pestle.laws._base import Geometry


class SideConstants(NamedTuple):
    """Material of one side."""

    modulus: float  # E_c [Pa]
    yield_stress: float  # Y [Pa]
    poisson: float  # nu [-]
    shear: float  # G [Pa]
    bulk: float  # kappa [Pa]
    onset: float  # delta_Y / R [-]
    adhesion: float  # work of adhesion borne by this side [J/m^2]
    always: float  # 1: R grows by (37) in every step, as printed


class Side(NamedTuple):
    """Response and new state of one side."""

    force: float  # [N]
    radius: float  # contact radius a [m]
    stiffness: float  # dF/d delta on the elastic branch, bulk included [N/m]
    slope: float  # dF/d delta while loading, bulk included [N/m]
    elastic: float  # elastic depth of the indenter, A/2 [m]
    stored: float  # energy of the indenter [J]
    sinking: float  # work of the indenter on the sinking surface [J]
    peak: float  # delta_max below the maximum, -1 at it [m]
    offset: float  # c_A, 0 before yield [m^2]
    push: float  # force of the bulk response [N]
    cut: float  # area that the flat cuts from the sphere [m^2]
    area: float  # A_C [m^2]
    depth: float  # delta_max [m]
    at_peak: float  # 1 at the maximum
    parted: float  # 1 if adhesion has just let go


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


def decay(x: float) -> float:
    """exp(x) for -10 <= x <= 0 to 4e-15, by squaring a Taylor polynomial [-]."""
    y = max(x, -10.0) * 0.03125
    p = 1.0 / 39916800.0
    p = p * y + 1.0 / 3628800.0
    p = p * y + 1.0 / 362880.0
    p = p * y + 1.0 / 40320.0
    p = p * y + 1.0 / 5040.0
    p = p * y + 1.0 / 720.0
    p = p * y + 1.0 / 120.0
    p = p * y + 1.0 / 24.0
    p = p * y + 1.0 / 6.0
    p = p * y + 0.5
    p = p * y + 1.0
    p = p * y + 1.0
    p = p * p
    p = p * p
    p = p * p
    p = p * p
    return p * p


def hardening(x: float) -> float:
    """p_Y / Y at x = delta_max / R, (16) with [D6] [-]."""
    return 1.75 * decay(-4.4 * x) + 1.0


def indented(t: float) -> float:
    """acos(1 - 2t) - (1 - 2t) 2 sqrt(t - t^2), 0 <= t <= 1/2, to round-off: (30).

    The function is t^1.5 times a smooth one, here a polynomial: no cancellation.
    """
    p = -0.17221952324072604
    p = p * t + 0.49366742340336056
    p = p * t - 0.6906045821807619
    p = p * t + 0.5758994424222323
    p = p * t - 0.33428270354054423
    p = p * t + 0.1250801684832229
    p = p * t - 0.04614130362037028
    p = p * t - 0.0031433740901652546
    p = p * t - 0.01634846331010071
    p = p * t - 0.021749249631870887
    p = p * t - 0.033663023112940844
    p = p * t - 0.056817744546010074
    p = p * t - 0.11111112365280747
    p = p * t - 0.285714285526146
    p = p * t - 1.6000000000011116
    p = p * t + 5.333333333333335
    return t * sqrt(t) * p


def indented_work(t: float) -> float:
    """Integral of `indented` from 0 to t [-]."""
    p = -0.007615001423107151
    p = p * t + 0.021401708996664666
    p = p * t - 0.02985790004501196
    p = p * t + 0.024603976920906122
    p = p * t - 0.014451594580818088
    p = p * t + 0.005091070956434357
    p = p * t - 0.0023318599436322716
    p = p * t - 0.0007153464577438112
    p = p * t - 0.001646520838079092
    p = p * t - 0.002568203821263391
    p = p * t - 0.004487567786921956
    p = p * t - 0.008741240252004482
    p = p * t - 0.020202020732052517
    p = p * t - 0.06349206348411514
    p = p * t - 0.4571428571429041
    p = p * t + 2.1333333333333333
    return t * t * sqrt(t) * p


def peel(de: float, stretch: float, r: float, pulled: bool) -> tuple[bool, bool, float]:
    """Adhesion: springs stretch to Delta l at the rim, then it peels [D2]-[D4].

    All lengths along the axis are over half the indenter's height, here 1, and radii
    over half its width.  At the rim of a peeling contact of radius r = s^2 the springs
    meet the indenter: u = 1 - sqrt(1 - r^2) = de + stretch s.  Squared this is a
    quartic in s, convex where it counts.

    Parameters
    ----------
    de : float
        Displacement of the indenter, negative when pulled out [-].
    stretch : float
        Delta l of a contact as wide as the indenter [-].
    r : float
        Adhered contact radius [-].
    pulled : bool
        The contact would be smaller than that without adhesion.

    Returns
    -------
    holds, parted : bool
        Adhesion acts; it has just let go.
    r : float
        Contact radius if adhesion holds [-].
    """
    s = sqrt(r)
    u = de + stretch * s
    peels = pulled and u < 1.0 and r * r > u * (2.0 - u)
    parted = False
    for _ in range(4):  # Halley from the right: never passes a root
        u = de + stretch * s
        square = s * s
        over = square * square - u * (2.0 - u)
        grows = 2.0 * square * s - stretch * (1.0 - u)  # its derivative / 2
        bends = over * (6.0 * square + stretch * stretch)  # second derivative / 2
        # a quartic with a root further left falls more steeply than this
        parted = parted or 1.5 * grows * abs(grows) < bends
        s -= 2.0 * over * grows / max(4.0 * grows * grows - bends, 1e-200)
        parted = parted or s <= 0.0
        s = min(max(s, 0.0), 1.0)
    parted = peels and parted
    return pulled and not parted, parted, s * s if peels else r


def side(
    k: SideConstants,
    particle: Particle,
    radius: float,
    flat: float,
    flat_old: float,
    peak: float,
    offset: float,
    adhered: float,
) -> Side:
    """Evaluate one side at a displacement of its flat.

    Parameters
    ----------
    k : SideConstants
        Material.
    particle : Particle
        State of the sphere.
    radius : float
        Apparent radius R [m].
    flat, flat_old : float
        Displacement delta_o of the flat now and before [m].
    peak, offset, adhered : float
        State of the side, see `zunker2024.State`.
    """
    grown = radius - particle.initial_radius
    curvature = 1.0 / radius
    # delta_max of a side at its maximum grows with R [D7b], else it stays [D7]
    before = flat_old + grown - particle.sunk_before
    reached = before if peak < 0.0 else peak
    d = flat + grown - particle.sunk
    at_peak = d >= reached
    depth = d if at_peak else reached
    if offset == 0.0 and at_peak and d > k.onset * radius:
        offset = (k.onset * k.onset - k.onset) * radius * radius * pi  # (43), < 0
    yielded = offset < 0.0

    # elliptic indenter: (31) before yield, (28) and (32)-(36) after it
    soft = decay(-4.4 * depth * curvature)
    pressure = k.yield_stress * (1.75 * soft + 1.0)
    widest2 = max(2.0 * depth * radius - depth * depth + offset * (1.0 / pi), 1e-300)
    widest = sqrt(widest2)
    half = 2.0 / k.modulus * pressure * widest if yielded else 2.0 * radius
    width = 2.0 * widest if yielded else 2.0 * radius
    height = 2.0 * half
    z = radius - depth + half
    root = sqrt(widest2 + z * z)
    # the inverses of root, widest and pressure, by one division
    product = root * widest
    inverse = 1.0 / (product * pressure)
    per_pressure = product * inverse
    per_widest = root * pressure * inverse
    aspect = 0.5 * k.modulus * per_pressure if yielded else 0.5  # width / height
    per_width = 0.5 * per_widest if yielded else 0.5 * curvature
    per_height = aspect * per_width
    centre = (
        (2.0 * (k.poisson - 1.0) * widest2 - (2.0 * k.poisson - 1.0) * z * (root - z))
        * (0.5 / k.shear * pressure)
        * (widest * pressure * inverse)
    )  # delta_R, (34)
    ease = 1.0 + 2.0 * centre * per_height if yielded else 1.0
    per_ease = 1.0 / ease
    de = (d - depth + half + centre) * per_ease if yielded else d  # (35)
    de = min(de, half)

    # contact radius and displacement of the springs, without and with adhesion
    pressed = max(de, 0.0)
    a = aspect * sqrt(pressed * (height - pressed))
    seat, lift, parted = pressed, 0.0, False
    if k.adhesion > 0.0:
        stretch = sqrt(pi * k.adhesion * width / k.modulus)  # Delta l at the equator
        r = min(2.0 * adhered * per_width, 1.0)
        holds, parted, r = peel(
            2.0 * de * per_height, 2.0 * stretch * per_height, r, a < adhered
        )
        a = 0.5 * width * r if holds else a
        u = r * r / (1.0 + sqrt(1.0 - r * r))
        seat = half * u if holds else seat
        lift = seat - de if holds else 0.0
    t = seat * per_height
    scale = 0.25 * k.modulus * height * width
    pushed = scale * indented(t)
    force = pushed - 2.0 * k.modulus * lift * a  # (47)
    stored = scale * height * indented_work(t) - lift * pushed + k.modulus * lift**2 * a

    stiffness = 2.0 * k.modulus * a * per_ease
    hardens = (
        2.0 * pi * pressure * (radius - depth)
        - 7.7 * pi * k.yield_stress * soft * widest2 * curvature
    )
    slope = max(hardens, 0.01 * stiffness) if yielded and at_peak else stiffness
    # bulk response: a pressure on what the flat cuts from the sphere
    opened = max(flat + grown, 0.0)
    cut = pi * (2.0 * radius - opened) * opened
    area = max(cut + offset if yielded else pi * opened * radius, 0.0)  # (42)
    push = particle.pressure * cut
    rim = 2.0 * pi * (radius - opened) if opened > 0.0 else 0.0
    firm = particle.firmness * cut + particle.pressure * rim
    mean = force - 0.5 * stiffness * (d - before)  # over the step
    return Side(
        force + push,
        a,
        stiffness + firm,
        slope + firm,
        half,
        ease * stored,
        mean * (particle.sunk - particle.sunk_before),
        -1.0 if at_peak else depth,
        offset,
        push,
        cut,
        area,
        depth,
        1.0 if at_peak else 0.0,
        1.0 if parted else 0.0,
    )


def sums(
    k: SideConstants,
    particle: Particle,
    g: Geometry,
    radius: float,
    flat: float,
    flat_old: float,
    moved: float,
    force: float,
    a: Side,
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


def release(modulus: float, adhesion: float, radius: float) -> float:
    """Negative overlap at which an elastic adhesive flat lets go, with a margin [m]."""
    if adhesion <= 0.0 or modulus <= 0.0:
        return 0.0
    length = (adhesion / modulus) ** 2 * radius
    return 2.5 * length ** (1.0 / 3.0)


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
