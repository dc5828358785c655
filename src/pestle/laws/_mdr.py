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
    stored: float  # [J]
    peak: float  # delta_max below the maximum, -1 at it [m]
    offset: float  # c_A, 0 before yield [m^2]
    bulk: float  # delta_BULK [m]
    area: float  # A_C [m^2]
    depth: float  # delta_max [m]
    at_peak: float  # 1 at the maximum
    parted: float  # 1 if adhesion has just let go


class Particle(NamedTuple):
    """What a particle knows besides its apparent radius."""

    initial_radius: float  # R_o [m]
    volume: float  # elastic volume V = V_o (1 + eps) [m^3]
    free: float  # free-surface fraction psi [-]
    bulk: float  # 1 while the bulk response is on
    shift: float  # mean surface displacement to be used in the next step [m]
    inside: float  # volume of the caps beyond the flats in the last step [m^3]
    compress: float  # contact area over volume, A_con / V_geo [1/m]
    growth: float  # last growth of R [m]


class Sums(NamedTuple):
    """What one side of a contact adds to its particle in one step."""

    volume: float  # volume displaced by the flat's motion [m^3]
    caps: float  # 2 pi R delta, area of the caps [m^2]
    flows: float  # 1 if a yielded contact moves inwards at its maximum
    excess: float  # contact area minus caps at the maximum, A' [m^2]
    area: float  # contact area [m^2]
    cap_volume: float  # [m^3]
    strain: float  # elastic volume strain [-]
    inside: float  # volume of the cap beyond the flat, weighed [m^3]
    imbalance: float  # |F_i - F_j| [N]


def decay(x: float) -> float:
    """exp(x) for -10 <= x <= 0 to 4e-15, by squaring a Taylor polynomial [-]."""
    y = max(x, -10.0) * 0.03125
    p = 1.0 + y / 11.0
    p = 1.0 + y / 10.0 * p
    p = 1.0 + y / 9.0 * p
    p = 1.0 + y / 8.0 * p
    p = 1.0 + y / 7.0 * p
    p = 1.0 + y / 6.0 * p
    p = 1.0 + y / 5.0 * p
    p = 1.0 + y / 4.0 * p
    p = 1.0 + y / 3.0 * p
    p = 1.0 + y / 2.0 * p
    p = 1.0 + y * p
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


def side(
    k: SideConstants,
    particle: Particle,
    radius: float,
    flat: float,
    flat_old: float,
    peak: float,
    offset: float,
    bulk: float,
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
    peak, offset, bulk, adhered : float
        State of the side, see `zunker2024.State`.
    """
    grown = radius - particle.initial_radius
    # delta_max of a side at its maximum grows with R [D7b], else it stays [D7]
    before = flat_old + grown - bulk
    reached = before if peak < 0.0 else peak
    geometric = flat + grown  # delta, to the flat
    if particle.bulk > 0.0 and geometric > 0.0:
        bulk = max(bulk + particle.shift, 0.0)
    d = geometric - bulk
    at_peak = d >= reached
    depth = d if at_peak else reached
    if offset == 0.0 and at_peak and d > k.onset * radius:
        offset = (k.onset * k.onset - k.onset) * radius * radius * pi  # (43), < 0
    yielded = offset < 0.0

    # elliptic indenter: (31) before yield, (28) and (32)-(36) after it
    x = depth / radius
    soft = decay(-4.4 * x)
    pressure = k.yield_stress * (1.75 * soft + 1.0)
    widest = sqrt(max(2.0 * depth * radius - depth * depth + offset / pi, 1e-300))
    height = 4.0 * pressure / k.modulus * widest if yielded else 4.0 * radius
    width = 2.0 * widest if yielded else 2.0 * radius
    half = 0.5 * height
    z = radius - (depth - half)
    root = sqrt(widest * widest + z * z)
    centre = pressure * (
        (
            2.0 * widest * widest * (k.poisson - 1.0)
            - z * (2.0 * k.poisson - 1.0) * (root - z)
        )
        / (2.0 * k.shear * root)
    )  # delta_R, (34)
    ease = 1.0 + centre / half if yielded else 1.0
    de = (d - depth + half + centre) / ease if yielded else d  # (35)
    de = min(de, half)

    # adhesion: springs stretch to Delta l, then peel [D2]-[D4]
    bare = width / height * sqrt(max(de, 0.0) * (height - max(de, 0.0)))
    r = min(2.0 * adhered / width, 1.0)
    u = r * r / (1.0 + sqrt(1.0 - r * r))  # g(a) = half u
    stretch = sqrt(pi * k.adhesion * width / k.modulus)  # Delta l at the equator
    pulled = bare < adhered
    peels = pulled and de + stretch * sqrt(r) < half * u
    parted = False
    v = u
    for _ in range(6):  # Newton from the right on a concave function
        q = max(v * (2.0 - v), 1e-30)
        edge = stretch * sqrt(sqrt(q))
        gain = de + edge - half * v
        falls = 0.5 * edge / q * (1.0 - v) - half
        parted = parted or falls >= 0.0
        v = v - gain / min(falls, -1e-30)
        parted = parted or v <= 0.0
        v = min(max(v, 0.0), 1.0)
    parted = peels and parted
    if peels:
        u = v
    holds = pulled and not parted
    a = 0.5 * width * sqrt(u * (2.0 - u)) if holds else bare
    seat = half * u if holds else max(de, 0.0)  # displacement without adhesion
    lift = seat - de if holds else 0.0
    t = seat / height
    scale = 0.25 * k.modulus * height * width
    pushed = scale * indented(t)
    force = pushed - 2.0 * k.modulus * lift * a  # (47)
    stored = scale * height * indented_work(t) - lift * pushed + k.modulus * lift**2 * a

    stiffness = 2.0 * k.modulus * a / ease
    hardens = (
        2.0 * pi * pressure * (radius - depth)
        - 7.7 * k.yield_stress * soft * pi * widest * widest / radius
    )
    slope = max(hardens, 0.01 * stiffness) if yielded and at_peak else stiffness
    opened = max(geometric, 0.0)
    area = max(
        pi * (2.0 * opened * radius - opened * opened) + offset
        if yielded
        else pi * opened * radius,
        0.0,
    )  # (42)
    squeeze = k.bulk * area * particle.compress
    return Side(
        force + squeeze * bulk,
        a,
        stiffness + squeeze,
        slope + squeeze,
        half,
        ease * stored + 0.5 * squeeze * bulk * bulk,
        -1.0 if at_peak else depth,
        offset,
        bulk,
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
    force: float,
    a: Side,
    imbalance: float,
) -> Sums:
    """Return what a side adds to its particle."""
    first = particle.initial_radius
    grown = radius - first
    d = max(flat + grown, 0.0)
    step = flat - flat_old
    active = a.radius > 0.0 or a.bulk > 0.0  # transmits force or adheres [D17]
    strain = -force * (first - flat) / (3.0 * k.bulk * particle.volume)  # (38) [D11]
    displaced = pi * step * (2.0 * flat * first - flat * flat + radius**2 - first**2)
    flows = a.at_peak > 0.0 and a.offset < 0.0 and step > 0.0
    cap = pi * d * d * (3.0 * radius - d) / 3.0
    return Sums(
        g.weight * displaced if active else 0.0,
        g.weight * 2.0 * pi * radius * d if active else 0.0,
        1.0 if flows or k.always > 0.0 else 0.0,
        g.weight * (a.area - 2.0 * pi * radius * max(a.depth + a.bulk, 0.0)),
        g.weight * a.area,
        cap,
        strain,
        g.weight * cap,
        imbalance,
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
    """New apparent radius (37) and particle state from the sums of one step."""
    first = p.initial_radius
    whole = 4.0 / 3.0 * pi * first**3
    sphere = 4.0 * pi * radius * radius
    hull = min(4.0 / 3.0 * pi * radius**3 - s.cap_volume, whole)
    hull = max(hull, 0.25 * whole)
    strain = max(s.strain, -0.5)
    surface = sphere + s.excess
    free = (surface - s.area) / surface if surface > 0.0 else 0.0
    bulk = free < c[1]
    # (37); the open part of the sphere ends at 0: growth fades out below a tenth of it
    open_part = max(1.0 - s.caps / sphere, 0.0)
    fade = min(open_part * 10.0, 1.0)
    fade = fade * fade * (3.0 - 2.0 * fade)
    growth = 0.0
    if s.flows > 0.0 and not bulk and open_part > 0.0:
        elastic = whole * (1.0 + strain) - p.volume  # -Delta V^e
        growth = max((s.volume + elastic) / (sphere * open_part), 0.0) * fade
        growth = min(growth, 1e-3 * first)
    # mean displacement of the surface: a state's difference, so jitter does not add up
    wide = max(s.area, 0.5 * s.caps)
    shift = (s.inside - p.inside) / wide if wide > 0.0 else 0.0
    return radius + growth, Particle(
        first,
        whole * (1.0 + strain),
        free,
        1.0 if bulk else 0.0,
        shift if bulk else 0.0,
        s.inside,
        s.area / hull,
        growth,
    )
