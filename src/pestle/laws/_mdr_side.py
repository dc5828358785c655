r"""One side of an MDR contact: a sphere of apparent radius R against a rigid flat.

Equation numbers are those of Zunker & Kamrin (2024), Part I; [Dn] are decisions of the
reading notes.
"""

from math import pi, sqrt

from pestle.laws._mdr_indenter import decay, indented, indented_work, peel
from pestle.laws._mdr_particle import Particle
from pestle.laws._mdr_quantities import Side, SideConstants


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
        State of the side, see `_mdr_quantities.State`.
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
    soft = decay(-k.fall * depth * curvature)
    pressure = k.yield_stress * (k.rise * soft + 1.0)
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
        - k.rise * k.fall * pi * k.yield_stress * soft * widest2 * curvature
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
