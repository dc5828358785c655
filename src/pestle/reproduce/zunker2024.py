"""Zunker and Kamrin (2024), Part I: the model's curves, from the exact solver.

Everything is per E, R_o and with nu = 0.3.  The paper computed its figures in steps
after its Appendix E, in which the radius may grow at any time (`eq37`); our rule lets
it grow by plastic flow alone [D13].  Both are shown.
"""

import warnings
from collections.abc import Sequence
from functools import cache
from math import pi

import numpy as np

from pestle.errors import EnergyWarning
from pestle.particle import Particle, ParticleMaterial, ParticleState, RadiusRule
from pestle.particle.pull_off import indenter
from pestle.reference import hertz, jkr, mdr, peeling, validity
from pestle.reproduce.item import LIMIT, PRINTED, Line, Panel, Paper, Result

ZUNKER2024 = Paper(
    "zunker2024",
    "W. Zunker, K. Kamrin, J. Mech. Phys. Solids 183 (2024) 105492",
)

RATIOS = (200.0, 100.0, 50.0, 25.0, 12.5, 6.25)
LEGS = (0.1, 0.2, 0.3, 0.4, 0.5)
RULES: tuple[tuple[RadiusRule, str], ...] = (
    ("plastic", "our rule: plastic flow"),
    ("eq37", "(37) in every step, as printed"),
)


def material(ratio: float, adhesion: float = 0.0) -> ParticleMaterial:
    """E = 1, nu = 0.3, Y = 1/ratio."""
    return ParticleMaterial(
        youngs_modulus=1.0,
        poisson_ratio=0.3,
        yield_stress=1.0 / ratio,
        work_of_adhesion=adhesion,
    )


def follow(
    ratio: float,
    rule: RadiusRule,
    path: Sequence[float],
    counts: tuple[int, ...] = (2,),
) -> list[ParticleState]:
    """States of a unit particle along displacements of its first group of flats."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", EnergyWarning)
        particle = Particle(material(ratio), 1.0, counts=counts, radius_rule=rule)
    still = (0.0,) * (len(counts) - 1)
    return [particle.move((d, *still)) for d in path]


@cache
def loading(ratio: float, rule: RadiusRule) -> tuple[ParticleState, ...]:
    """First loading to 0.5."""
    return tuple(follow(ratio, rule, np.linspace(0.0, 0.5, 101).tolist()))


@cache
def unloading(ratio: float, rule: RadiusRule) -> tuple[tuple[ParticleState, ...], ...]:
    """Unloading from each peak of a fresh particle until it parts."""
    found = []
    for top in LEGS:
        state = follow(ratio, rule, [top])[0]
        flat = state.flats[0]
        loss = 0.3 / ratio if flat.yielded else top
        path = [top, *(top - loss * t for t in np.linspace(0.0, 4.0, 161)[1:])]
        states = follow(ratio, rule, [d for d in path if d > -0.01])
        parted = [n for n, s in enumerate(states) if s.flats[0].force == 0.0]
        found.append(tuple(states[: parted[0] + 1] if parted else states))
    return tuple(found)


def six_panels(quantity: str, ylabel: str) -> list[Panel]:
    """A panel for each E/Y: loading to 0.5 and unloading from five peaks."""
    panels = []
    for letter, ratio in zip("abcdef", RATIOS, strict=True):
        lines: list[Line] = []
        for rule, label in RULES:
            kind = {"plastic": "ours", "eq37": PRINTED}[rule]
            number = {"plastic": 0, "eq37": 1}[rule]
            curves = [loading(ratio, rule), *unloading(ratio, rule)]
            for n, states in enumerate(curves):
                x = [s.flats[0].displacement for s in states]
                y = [_value(s, quantity, ratio) for s in states]
                shown = label if n == 0 and letter == "a" else ""
                lines.append(Line(x, y, shown, kind, number))
        if quantity == "pressure":
            states = loading(ratio, "plastic")
            x = [s.flats[0].displacement for s in states]
            y = [
                mdr.hardening_pressure(s.flats[0].largest, s.radius, yield_stress=1.0)
                for s in states
            ]
            label = "(16), hardening" if letter == "a" else ""
            lines.append(Line(x, y, label, LIMIT, 3))
        panels.append(
            Panel(
                r"$\delta_o/R_o$ [-]",
                ylabel,
                lines,
                f"({letter}) E/Y = {ratio:g}",
                xlim=(0.0, 0.52),
            )
        )
    return panels


def _value(state: ParticleState, quantity: str, ratio: float) -> float:
    flat = state.flats[0]
    if quantity == "pressure":
        return flat.pressure * ratio
    found: dict[str, float] = {
        "force": flat.force,
        "area": flat.area / pi,
        "volume": state.volume_ratio,
    }
    return found[quantity]


def difference() -> str:
    """How far the printed rule lies above ours at 0.5."""
    parts = []
    for ratio in RATIOS:
        ours, printed = (loading(ratio, rule)[-1].flats[0].force for rule, _ in RULES)
        parts.append(f"{100.0 * (printed / ours - 1.0):.2g}")
    return ", ".join(parts) + " % at E/Y = " + ", ".join(f"{r:g}" for r in RATIOS)


NO_NUMBERS = (
    "The paper prints no numbers for these curves; finite-element ones are left out."
)


@ZUNKER2024.item("figure-8", "Force of a sphere between two flats")
def figure_8() -> Result:
    """Force against displacement."""
    said = (
        f"{NO_NUMBERS} At a displacement of 0.5 the printed rule gives a force above "
        f"ours by {difference()}."
    )
    return Result(said, six_panels("force", r"$F/ER_o^2$ [-]"))


@ZUNKER2024.item("figure-9", "Contact area")
def figure_9() -> Result:
    """Contact area against displacement."""
    return Result(NO_NUMBERS, six_panels("area", r"$A_C/\pi R_o^2$ [-]"))


@ZUNKER2024.item("figure-10", "Mean contact pressure")
def figure_10() -> Result:
    """Mean pressure against displacement, and the hardening curve."""
    said = (
        f"{NO_NUMBERS} While a yielded contact is loaded its pressure is (16) to "
        f"{_hardening_error():.0e}; it starts at 2.75 Y and is "
        f"{loading(200.0, 'plastic')[-1].flats[0].pressure * 200.0:.3f} Y at 0.5 for "
        "E/Y = 200."
    )
    return Result(said, six_panels("pressure", r"$\bar p/Y$ [-]"))


def _hardening_error() -> float:
    states = loading(200.0, "plastic")[5:]
    return max(
        abs(
            s.flats[0].pressure
            / mdr.hardening_pressure(
                s.flats[0].largest, s.radius, yield_stress=1.0 / 200.0
            )
            - 1.0
        )
        for s in states
    )


@ZUNKER2024.item("figure-11", "Volume of the particle")
def figure_11() -> Result:
    """Elastic volume against displacement."""
    said = (
        f"{NO_NUMBERS} V is the elastic volume (38): it returns to V_o when the flats "
        "leave."
    )
    return Result(said, six_panels("volume", r"$V/V_o$ [-]"))


@ZUNKER2024.item("figure-12", "Die compaction, E/Y = 20")
def figure_12() -> Result:
    """Force and area of moving and standing contacts of a cubic die."""
    ends = (0.2, 0.3, 0.4)
    rules = dict(RULES)
    panels = []
    for letter, group, quantity in (
        ("a", 0, "F"),
        ("b", 1, "F"),
        ("c", 0, "A"),
        ("d", 1, "A"),
    ):
        lines = []
        for number, (rule, label) in enumerate(rules.items()):
            kind = "ours" if rule == "plastic" else PRINTED
            for n, states in enumerate(_die(rule, ends)):
                x = [s.flats[0].displacement for s in states]
                y = [
                    s.flats[group].force
                    if quantity == "F"
                    else s.flats[group].area / pi
                    for s in states
                ]
                shown = label if letter == "a" and n == 0 else ""
                lines.append(Line(x, y, shown, kind, number))
        name = "moving" if group == 0 else "standing"
        ylabel = r"$F/ER_o^2$ [-]" if quantity == "F" else r"$A_C/\pi R_o^2$ [-]"
        panels.append(
            Panel(
                r"$\delta_o/R_o$ of the moving flats [-]",
                ylabel,
                lines,
                f"({letter}) {name} contact",
            )
        )
    last = _die("plastic", ends)[0][-1]
    kept = _die("plastic", ends)[-1]
    said = (
        f"{NO_NUMBERS} At 0.4 the force of a moving contact is "
        f"{last.flats[0].force:.5f} and of a standing one {last.flats[1].force:.5f} E "
        "R_o^2. On unloading the standing force stays exactly as it is "
        f"({kept[-1].flats[1].force / kept[0].flats[1].force:.12g} times its peak), as "
        "the paper's text says it persists. Beyond 0.489 the radius is singular."
    )
    return Result(said, panels, across=2)


@cache
def _die(rule: RadiusRule, ends: tuple[float, ...]) -> list[list[ParticleState]]:
    counts = (2, 4)
    found = [follow(20.0, rule, np.linspace(0.0, max(ends), 81).tolist(), counts)]
    for top in ends:
        path = [top, *np.linspace(top, top - 0.06, 61)[1:]]
        found.append(follow(20.0, rule, path, counts))
    return found


@ZUNKER2024.item("figure-13a", "Adhesion in the elastic range")
def figure_13a() -> Result:
    """MDR, JKR and Hertz at E* R_o/W = 2.2e4."""
    modulus, adhesion = 2.2e4, 1.0
    solid = ParticleMaterial(
        youngs_modulus=modulus * 0.91,
        poisson_ratio=0.3,
        yield_stress=1e9,
        work_of_adhesion=adhesion,
    )
    k = {"modulus": modulus, "work_of_adhesion": adhesion}
    top = 0.006
    particle = Particle(solid, 1.0, counts=(2,))
    down = np.linspace(top, -0.004, 1001)
    trace = particle.trace(np.concatenate([np.linspace(0.0, top, 201), down])[:, None])
    path = np.concatenate([np.linspace(0.0, top, 201), down])
    force = trace.force[:, 0]
    last = int(np.flatnonzero(force[201:] == 0.0)[0]) + 202
    a = np.linspace(jkr.critical_radius(1.0, **k, control="displacement"), 0.12, 400)
    depth = np.array([jkr.overlap(x, 1.0, **k) for x in a])
    branch = np.array([jkr.force(x, 1.0, **k) for x in a])
    d = np.linspace(0.0, top, 200)
    elastic = [hertz.force(x, 1.0, modulus=modulus) for x in d]
    lines = [
        Line(path[:last], force[:last], "MDR, loading and unloading", "ours", 0),
        Line(depth[depth < top], branch[depth < top], "JKR", LIMIT, 1),
        Line(d, elastic, "Hertz", LIMIT, 3),
    ]
    panel = Panel(r"$\delta_o/R_o$ [-]", r"$F/WR_o$ [-]", lines, "(a) elastic adhesion")
    lowest = float(np.min(force))
    said = (
        "The paper says that MDR agrees with JKR exactly once the edge springs let go. "
        "That holds for a parabola; the ellipse differs by the order of (a/R)^2: its "
        f"pull-off force is {lowest:.4f} W R_o, that of JKR {-1.5 * pi:.4f}."
    )
    return Result(said, [panel], across=1)


@cache
def loaded(ratio: float, displacement: float) -> Particle:
    """Particle of a ratio E*/Y, E* = 1, at a displacement."""
    solid = ParticleMaterial(
        youngs_modulus=0.91, poisson_ratio=0.3, yield_stress=1.0 / ratio
    )
    particle = Particle(solid, 1.0, counts=(2,))
    particle.move([displacement])
    return particle


REASONS = ("ok", "peak", "ssy", "both")


def phase(ratio: float, modulus: float, displacement: float) -> str:
    """Why adhesion is not trusted, at E*/Y and E* R_o/W."""
    particle = loaded(ratio, displacement)
    flat = particle.state.flats[0]
    adhesion = 1.0 / modulus
    critical = peeling.critical_radius(
        indenter(particle), modulus=1.0, work_of_adhesion=adhesion
    )
    yields = mdr.yield_overlap(1.0, modulus=1.0, yield_stress=1.0 / ratio)
    start = flat.yield_overlap if flat.yielded else yields
    peak = validity.peak_radius(displacement, 1.0, yield_overlap=start)
    zone = validity.plastic_zone(
        modulus=1.0, work_of_adhesion=adhesion, yield_stress=1.0 / ratio
    )
    return validity.reason(critical, peak, zone)


@ZUNKER2024.item("figure-F.21", "Where adhesion can be trusted")
def figure_f21() -> Result:
    """Phase diagrams of (F.7)."""
    panels = []
    per_decade = 10
    steps = np.arange(-1.0, 3.5, 1.0 / per_decade)  # log10 of E*/Y, from 0.1 on
    log_moduli = np.arange(1.0, 6.0 + 1e-9, 1.0 / per_decade)
    largest = {}
    for letter, displacement in zip("abcde", LEGS, strict=True):
        log_yields = np.arange(0.0, 5.0 + 1e-9, 1.0 / per_decade)
        found = np.full((len(log_yields), len(log_moduli)), np.nan)
        for row, y in enumerate(log_yields):
            for column, x in enumerate(log_moduli):
                if steps[0] < x - y and x > y + 0.3:  # E* above 2 Y
                    key = round(10.0 ** round(x - y, 6), 9)
                    reason = phase(key, 10.0**x, displacement)
                    found[row, column] = REASONS.index(reason)
        valid = [
            10.0 ** (log_moduli[c] - log_yields[r])
            for r, c in np.argwhere(found == 0)
            if loaded(
                round(10.0 ** round(log_moduli[c] - log_yields[r], 6), 9), displacement
            )
            .state.flats[0]
            .yielded
        ]
        largest[displacement] = max(valid, default=float("nan"))
        panels.append(
            Panel(
                r"$E^*R_o/W$ [-]",
                r"$YR_o/W$ [-]",
                title=f"({letter}) " + r"$\delta_{o,max}/R_o$" + f" = {displacement:g}",
                scales=("log", "log"),
                regions=(
                    10.0**log_moduli,
                    10.0**log_yields,
                    found,
                    ("valid", r"$a_c \leq r_{peak}$", r"$2a_c < 15\,r_{Ip}$", "both"),
                ),
            )
        )
    limits = ", ".join(f"{v:.2g} at {d:g}" for d, v in largest.items() if d > 0.15)
    said = (
        "Recomputed with (F.1) and its onset 0.135 (text and caption of F.1 say 0.15); "
        "white is E* below 2 Y. The paper prints no numbers. With yielding the two "
        f"criteria hold together only up to E*/Y of {limits} on this grid of ten "
        "points a decade."
    )
    return Result(said, panels)
