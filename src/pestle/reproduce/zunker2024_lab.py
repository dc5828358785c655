"""Zunker and Kamrin (2024), Part I: their finite-element figures, from our lab.

Figures read the tables of `pestle lab study zunker2024 --mesh medium`; the study took
486 s of one processor, a figure a second (the pull-offs of F.20 four).
The paper prints no numbers for its curves: sentences compare with its fits and words.
"""

from collections.abc import Callable, Sequence

import numpy as np

from pestle.lab.packaged import Table, parameter_set, table
from pestle.reference import mdr, validity
from pestle.reproduce.item import LAB, LIMIT, Array, Line, Panel, Result
from pestle.reproduce.zunker2024 import RATIOS, ZUNKER2024

NU = 0.3
E_STAR = 1.0 / (1.0 - NU**2)
D_LABEL, D_MAX_LABEL = r"$\delta_o/R_o$ [-]", r"$\delta_{o,max}/R_o$ [-]"
LABELS = (r"$F/ER_o^2$ [-]", r"$A_C/\pi R_o^2$ [-]", r"$\bar p/Y$ [-]")
OURS_IS = "Our finite elements (2880 elements)."


def hardening(d: Array, a: float = 1.75, b: float = 4.4) -> Array:
    """Mean pressure (16) over Y."""
    return np.asarray(a * np.exp(-b * d) + 1.0)


def _curves(one: Table) -> tuple[Array, Array, Array, Array]:
    """Displacement, force, area, mean pressure over Y of a loading."""
    d, force, area = one["d_R"], one["F_ER2"], one["A_piR2"]
    return d, force, area, force / (np.pi * area) * one["modulus_ratio"]


def _staircase(one: Table) -> tuple[float, float]:
    """Typical and largest relative width of the bracket of the area beyond 0.05."""
    deep = one["d_R"] > 0.05
    width = (one["r_out"] ** 2 / one["r_in"] ** 2 - 1.0)[deep]
    return float(np.median(width)), float(width.max())


@ZUNKER2024.item("figure-5", "Force, area and pressure by finite elements")
def figure_5() -> Result:
    """Loading for all E/Y; the hardening curve."""
    loads = table("zunker2024_loading").where(poisson_ratio=NU)
    lines: list[list[Line]] = [[], [], []]
    for number, ratio in enumerate(RATIOS):
        d, *values = _curves(loads.where(modulus_ratio=ratio))
        for kept, y in zip(lines, values, strict=True):
            label = f"E/Y = {ratio:g}" if kept is lines[0] else ""
            kept.append(Line(d, y, label, LAB, number))
    x = np.linspace(0.0, 0.5, 200)
    lines[1].append(Line(x, x, r"Hertz, $\delta_oR_o$", LIMIT, 0))
    lines[1].append(Line(x, 2.0 * x - x**2, "sphere cut by the flat", LIMIT, 1))
    d, _, _, p = _curves(loads.where(modulus_ratio=200.0))
    own = parameter_set("zunker2024-lab")["constants"].values()
    deep = d >= 0.03
    off = p[deep] / hardening(d[deep]) - 1.0
    fit = [
        Line(d, p, "E/Y = 200", LAB, 0),
        Line(x[1:], hardening(x[1:]), "(16)", LIMIT, 0),
        Line(x[1:], hardening(x[1:], *own), "(16), fitted to it", LIMIT, 1),
    ]
    panels = [
        Panel(D_LABEL, label, kept, f"({letter})", xlim=(0.0, 0.52))
        for letter, label, kept in zip("abc", LABELS, lines, strict=True)
    ]
    panels.append(Panel(D_LABEL, LABELS[2], fit, "(d)", xlim=(0.0, 0.52)))
    middle, worst = _staircase(loads.where(modulus_ratio=200.0))
    said = (
        f"{OURS_IS} At E/Y = 200 the pressure lies {100 * off.min():+.1f} to "
        f"{100 * off.max():+.1f} % from the printed fit (16) beyond 0.03, "
        f"{100 * np.quantile(np.abs(off), 0.9):.1f} % for nine steps in ten: the "
        "steps are those of the nodes in contact. A fit to it has "
        f"{', '.join(f'{c:.3g}' for c in own)} for 1.75 and 4.4. The contact area is "
        f"known to a bracket of {100 * middle:.0f} % in the median, {100 * worst:.0f} "
        "% at most."
    )
    return Result(said, panels, across=2)


@ZUNKER2024.item("figure-B.15", "Effect of the Poisson ratio")
def figure_b15() -> Result:
    """Force, area and pressure at E/Y = 50."""
    loads = table("zunker2024_loading").where(modulus_ratio=50.0)
    lines: list[list[Line]] = [[], [], []]
    ends: list[list[float]] = [[], [], []]
    for number, nu in enumerate(loads.values("poisson_ratio")):
        d, *values = _curves(loads.where(poisson_ratio=nu))
        for kept, end, y in zip(lines, ends, values, strict=True):
            kept.append(Line(d, y, rf"$\nu$ = {nu:g}", LAB, number))
            end.append(float(np.mean(y[d > 0.4])))
    panels = [
        Panel(D_LABEL, label, kept, f"({letter})", xlim=(0.0, 0.52))
        for letter, label, kept in zip("abc", LABELS, lines, strict=True)
    ]
    spans = ", ".join(f"{100 * (max(e) / min(e) - 1.0):.1f} %" for e in ends)
    said = (
        f"{OURS_IS} The paper does not print its E/Y; here it is 50. Beyond 0.4 force, "
        f"area and pressure differ by {spans} between Poisson ratios of 0 and 0.45: "
        "negligible, as the paper says."
    )
    return Result(said, panels)


def _six(make: Callable[[float, str], list[Line]], x: str, y: str) -> list[Panel]:
    return [
        Panel(x, y, make(ratio, letter), f"({letter}) E/Y = {ratio:g}")
        for letter, ratio in zip("abcdef", RATIOS, strict=True)
    ]


def _profiles(name: str, column: str) -> Callable[[float, str], list[Line]]:
    profiles = table(name)

    def make(ratio: float, letter: str) -> list[Line]:
        own, lines = profiles.where(modulus_ratio=ratio), []
        for number, d in enumerate(own.values("dmax_R")):
            one = own.where(dmax_R=d)
            z = one[column] - (one[column][0] if column == "z_R" else 0.0)
            label = f"{d:g}" if letter == "a" and number % 3 == 0 else ""
            lines.append(Line(one["r_R"], z, label, LAB, number))
        return lines

    return make


@ZUNKER2024.item("figure-B.16", "Pressure profiles")
def figure_b16() -> Result:
    """Pressure over Y under the flat, ten displacements."""
    make = _profiles("zunker2024_pressure", "p_Y")
    panels = _six(make, r"$r/R_o$ [-]", r"$p/Y$ [-]")
    first, last = panels[0].lines[0], panels[0].lines[-1]
    said = (
        f"{OURS_IS} Displacements of 0.05 to 0.5 from left to right. At E/Y = 200 the "
        f"pressure on the axis is {first.y[0]:.2f} Y at 0.05 and {last.y[0]:.2f} Y at "
        "0.5; soft spheres keep Hertz' ellipse up to yield. Every node is shown: the "
        "last one has the jump of the edge."
    )
    return Result(said, panels)


@ZUNKER2024.item("figure-F.17", "Relaxed profiles")
def figure_f17() -> Result:
    """Surface of the relaxed sphere up to the largest contact radius."""
    make = _profiles("zunker2024_relaxed", "z_R")
    panels = _six(make, r"$r/R_o$ [-]", r"$z/R_o$ [-]")
    rows = table("zunker2024_unloading").where(poisson_ratio=NU)
    dimples = []
    for ratio in RATIOS:
        one = rows.where(modulus_ratio=ratio)
        ring = one["dmax_R"][one["dimple_R"] > 1e-5]
        dimples.append(f"{ring[0]:g} ({ratio:g})" if ring.size else f"- ({ratio:g})")
    said = (
        f"{OURS_IS} Displacements of 0.05 to 0.5 from left to right; z is counted from "
        "the pole. A ring lower than the pole is first seen after (E/Y): "
        f"{', '.join(dimples)}; the paper has it from 0.15 on, later for soft spheres."
    )
    return Result(said, panels)


@ZUNKER2024.item("figure-13b", "A relaxed profile with a ring")
def figure_13b() -> Result:
    """E/Y = 12.5 after 0.4."""
    one = table("zunker2024_relaxed").where(modulus_ratio=12.5, dmax_R=0.4)
    z = one["z_R"] - one["z_R"][0]
    low = int(np.argmin(z))
    lines = [Line(one["r_R"], z, "relaxed, up to $a_{max}$", LAB, 0)]
    lines.append(Line([one["r_R"][low]] * 2, [z[low], 0.0], r"$r_{peak}$", LIMIT, 1))
    panel = Panel(r"$r/R_o$ [-]", r"$z/R_o$ [-]", lines, "(b)")
    start = _yield_displacement(12.5)
    fit = validity.peak_radius(0.4, 1.0, yield_overlap=start)
    said = (
        f"{OURS_IS} The ring is {-z[low]:.4f} R below the pole, at r = "
        f"{one['r_R'][low]:.3f} R; (F.1) gives {fit:.3f} R."
    )
    return Result(said, [panel], across=1)


def _yield_displacement(ratio: float) -> float:
    """delta_Y (41) of E = R = 1."""
    return mdr.yield_overlap(1.0, modulus=E_STAR, yield_stress=1.0 / ratio)


def _rings() -> dict[float, tuple[Array, Array, Array, Array]]:
    """Displacement, r_peak, a_max and depth of the ring by E/Y."""
    rows = table("zunker2024_unloading").where(poisson_ratio=NU)
    found = {}
    for ratio in RATIOS:
        one = rows.where(modulus_ratio=ratio)
        names = ("dmax_R", "r_peak_R", "amax_R", "dimple_R")
        d, r, a, depth = (one[name] for name in names)
        found[ratio] = d, np.where(depth > 1e-5, r, 0.0), a, depth
    return found


def _scattered(
    x: Callable[[float, Array], Array], y: Callable[[float, Sequence[Array]], Array]
) -> list[Line]:
    return [
        Line(x(ratio, rows[0]), y(ratio, rows), f"E/Y = {ratio:g}", LAB, number)
        for number, (ratio, rows) in enumerate(_rings().items())
    ]


def _shifted(onset: float) -> Callable[[float, Array], Array]:
    return lambda ratio, d: d - _yield_displacement(ratio) - onset


ONSET, ONSET_DEPTH = 0.135, 0.15
SHIFTED = r"$(\delta_{o,max}-\delta_Y-\delta_\Xi)/R_o$ [-]"


@ZUNKER2024.item("figure-F.18", "Radius of the ring")
def figure_f18() -> Result:
    """r_peak, raw and shifted, with (F.1)."""
    x = np.linspace(0.0, 0.37, 200)
    shifted = _scattered(_shifted(ONSET), lambda _, rows: rows[1])
    law = Line(x, 1.75 * x**0.75, "(F.1)", LIMIT, 0)
    raw = _scattered(lambda _, d: d, lambda _, rows: rows[1])
    ylabel = r"$r_{peak}/R_o$ [-]"
    panels = [
        Panel(D_MAX_LABEL, ylabel, raw, "(a)"),
        Panel(SHIFTED, ylabel, [*shifted, law], "(b)", xlim=(-0.4, 0.4)),
    ]
    off = _off(shifted, lambda s: 1.75 * s**0.75)
    said = f"{OURS_IS} Where there is a ring, (F.1) is {off}."
    return Result(said, panels, across=2)


def _off(lines: Sequence[Line], law: Callable[[Array], Array]) -> str:
    """How far a fit is from rings that are there."""
    errors: list[float] = []
    for line in lines:
        there = (line.y > 0.0) & (line.x > 0.03)
        errors.extend(law(line.x[there]) / line.y[there] - 1.0)
    found = np.array(errors)
    return (
        f"{100 * found.mean():+.0f} % off in the mean, {100 * found.min():+.0f} to "
        f"{100 * found.max():+.0f} % more than 0.03 beyond onset ({len(found)} rings; "
        "the radius of a ring is that of a node)"
    )


@ZUNKER2024.item("figure-F.19", "The ring over the contact radius, and its depth")
def figure_f19() -> Result:
    """r_peak/a_max and Xi, raw and collapsed."""
    x = np.linspace(0.0, 0.36, 200)
    share = _scattered(_shifted(ONSET), lambda _, rows: rows[1] / rows[2])
    law = Line(x, 1.1 * np.cbrt(x), "(F.2)", LIMIT, 0)
    scaled = _scattered(_shifted(ONSET_DEPTH), lambda e, rows: rows[3] * e**1.175)
    curve = 0.1025 - 0.1025 / 0.18**2 * (x - 0.18) ** 2
    depth = Line(x, curve, r"(F.3), $0.1025/0.18^2$", LIMIT, 0)
    raw = _scattered(lambda _, d: d, lambda _, rows: rows[1] / rows[2])
    deep = _scattered(lambda _, d: d, lambda _, rows: rows[3])
    ylabel, name = r"$r_{peak}/a_{max}$ [-]", r"$\Xi/R_o$ [-]"
    wide = (-0.4, 0.4)
    panels = [
        Panel(D_MAX_LABEL, ylabel, raw, "(a)"),
        Panel(SHIFTED, ylabel, [*share, law], "(b)", xlim=wide),
        Panel(D_MAX_LABEL, name, deep, "(c)", ("linear", "log"), ylim=(1e-5, 0.02)),
        Panel(
            SHIFTED, r"$\Xi/R_o\,(E/Y)^{1.175}$ [-]", [*scaled, depth], "(d)", xlim=wide
        ),
    ]
    tops = ", ".join(f"{line.y.max():.3f}" for line in scaled)
    said = (
        f"{OURS_IS} (F.2) is {_off(share, lambda s: 1.1 * np.cbrt(s))}. The largest "
        f"scaled depths are {tops} from E/Y = 200 down; (F.3) has 0.1025 at most. As "
        "printed (F.3) lacks the square of 0.18."
    )
    return Result(said, panels, across=2)
