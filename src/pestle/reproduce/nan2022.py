"""Nan, Goh and Rahman (2022): stiffness, pull-off force, time step."""

from typing import NamedTuple

import numpy as np

from pestle.reference import jkr_contact
from pestle.reference import nan2022 as theory
from pestle.reference import nan2022_energy as energy
from pestle.reproduce.item import LIMIT, POINTS, Array, Line, Panel, Paper, Result

NAN2022 = Paper(
    "nan2022",
    "W. Nan, W. P. Goh, M. T. Rahman, Powder Technol. 406 (2022) 117634",
)


class Case(NamedTuple):
    """A particle of Table 1 with the points of Table 2, rows restored. SI units."""

    name: str
    modulus: float  # E* [Pa]
    radius: float  # R* [m]
    adhesion: float  # Gamma [J/m^2]
    pressure: float  # p_y [Pa]
    force: tuple[float, float, float]  # f_max [N]
    overlap: tuple[float, float, float]  # alpha_max [m]
    rest: tuple[float, float, float]  # alpha_p [m]
    pull_off: tuple[float, float, float]  # f_cp [N]
    stiffness: tuple[float, float, float]  # k_e as printed [N/m]
    plastic: float  # k_p as printed [N/m]


NING = Case(
    "Ning (1995)",
    1.3e9,
    2.45e-6,
    0.2,
    35.3e6,
    (42.4e-6, 20.9e-6, 8.3e-6),
    (210.5e-9, 112.6e-9, 53.9e-9),
    (177.3e-9, 91.1e-9, 41.3e-9),
    (8.4e-6, 6.1e-6, 4.6e-6),
    (1274.0, 958.0, 639.0),
    217.0,
)
DU = Case(
    "Du et al. (2007)",
    410e9 / 0.91,
    4e-6,
    1.0,
    5.52e9,
    (8584.4e-6, 5170.7e-6, 2132.2e-6),
    (53.7e-9, 35.7e-9, 17.9e-9),
    (33.4e-9, 20.2e-9, 8.2e-9),
    (321.5e-6, 239.7e-6, 170.8e-6),
    (4.2e5, 3.3e5, 2.2e5),
    1.8e5,
)
CASES = (NING, DU)


def stiffness(case: Case, *, plastic: bool = False) -> tuple[float, float]:
    """k_el and alpha_y from the uppermost unloading line, (45) or (49)."""
    return energy.elastic_stiffness_from_unloading(
        case.modulus,
        case.radius,
        case.adhesion,
        case.pressure,
        measured=case.stiffness[0],
        overlap=case.overlap[0],
        plastic=case.plastic if plastic else 0.0,
    )


def hertz_stiffness(case: Case, overlap: Array | float) -> Array:
    """(41): 2 E* sqrt(R* alpha) [N/m]."""
    return np.asarray(2.0 * case.modulus * np.sqrt(case.radius * overlap))


@NAN2022.item("figure-5", "Yield pressure over yield stress")
def figure_5() -> Result:
    """(32) and (33) against Poisson's ratio."""
    nu = np.linspace(0.1, 0.45, 200)
    first = [energy.yield_pressure(1.0, x) for x in nu]
    second = [energy.yield_pressure_chang(1.0, x) for x in nu]
    lines = [Line(nu, first, "(32)"), Line(nu, second, "(33)", "ours", 1)]
    panel = Panel(r"$\nu$ [-]", r"$p_y/\sigma_y$ [-]", lines)
    ends = [energy.yield_pressure(1.0, x) for x in (0.1, 0.2, 0.4)]
    said = (
        f"Print says 1.4 to 1.7 for nu = 0.2 to 0.4; (32) gives {ends[1]:.2f} to "
        f"{ends[2]:.2f}, and {ends[0]:.2f} at 0.1."
    )
    return Result(said, [panel], across=1)


@NAN2022.item("figure-6", "Stiffness of unloading")
def figure_6() -> Result:
    """(44) and (48) through the uppermost line, Hertz, and the points of Table 2."""
    panels = []
    for letter, case in zip("ab", CASES, strict=True):
        top = 1.1 * case.overlap[0]
        a = np.linspace(0.01 * top, top, 300)
        root = np.sqrt(a / case.overlap[0])
        scale = 1e3 if case is NING else 1e5
        unit = "kN/m" if case is NING else r"$10^5$ N/m"
        plain = case.stiffness[0] * root
        with_kp = case.plastic + (case.stiffness[0] - case.plastic) * root
        lines = [
            Line(a * 1e9, plain / scale, "(44)"),
            Line(a * 1e9, with_kp / scale, "(48)", "ours", 1),
            Line(a * 1e9, hertz_stiffness(case, a) / scale, "Hertz (41)", LIMIT, 3),
            Line(
                np.array(case.overlap) * 1e9,
                np.array(case.stiffness) / scale,
                "Table 2",
                POINTS,
                2,
            ),
        ]
        title = f"({letter}) {case.name}"
        panels.append(Panel(r"$\alpha_{max}$ [nm]", f"$k_e$ [{unit}]", lines, title))
    off = {
        case.name: [
            case.stiffness[0] * np.sqrt(a / case.overlap[0]) / k - 1.0
            for a, k in zip(case.overlap[1:], case.stiffness[1:], strict=True)
        ]
        for case in CASES
    }
    shown = "; ".join(
        f"{name} {100 * a:+.1f} and {100 * b:+.1f} %" for name, (a, b) in off.items()
    )
    said = f"(44) against the other two points of Table 2: {shown}."
    return Result(said, panels, across=2)


RULE_LABELS = ("(59), default", "(61)", "(64)", "(67)")


def pull_off_curves(case: Case, overlaps: Array) -> dict[str, list[float]]:
    """f_cp by each of the four rules of Table 4 [N]."""
    elastic, _ = stiffness(case)
    ratio = theory.stiffness_ratio(case.modulus, case.radius, case.adhesion, elastic)
    plastic = case.plastic if case is NING else min(case.plastic, 10 * elastic)
    found = {}
    for rule, label in enumerate(RULE_LABELS):
        c = theory.contact(
            case.modulus,
            case.radius,
            case.adhesion,
            case.pressure,
            elastic,
            plastic,
            ratio,
            float(rule),
        )
        found[label] = [theory.unloading(c, float(a)).pull_off for a in overlaps]
    return found


@NAN2022.item("figure-7", "Pull-off force after plastic deformation")
def figure_7() -> Result:
    """The four formulas of Table 4 and the points of Table 2."""
    panels, words = [], []
    for letter, case in zip("ab", CASES, strict=True):
        a = np.linspace(0.02, 1.05, 300) * case.overlap[0]
        lines = [
            Line(a * 1e9, np.array(f) * 1e6, label, "ours", n)
            for n, (label, f) in enumerate(pull_off_curves(case, a).items())
        ]
        points = np.array(case.pull_off) * 1e6
        lines.append(Line(np.array(case.overlap) * 1e9, points, "Table 2", POINTS, 4))
        title = f"({letter}) {case.name}"
        panels.append(Panel(r"$\alpha_{max}$ [nm]", r"$f_{cp}$ [µN]", lines, title))
        at = pull_off_curves(case, np.array(case.overlap))["(59), default"]
        ours = ", ".join(f"{1e6 * f:.3g}" for f in at)
        theirs = ", ".join(f"{1e6 * f:.3g}" for f in case.pull_off)
        words.append(f"{case.name} {theirs} uN, (59) {ours} uN")
    said = (
        "As printed, all four are above Ning's points: "
        + "; ".join(words)
        + ". Curves are recomputed with k_el of (45), k_p = min(k_p, k_e). (61) is "
        "zero "
        "just after yield and creates energy there: never the default."
    )
    return Result(said, panels, across=2)


@NAN2022.item("figure-8", "Critical over Rayleigh time step")
def figure_8() -> Result:
    """(72) against Poisson's ratio."""
    nu = np.linspace(0.1, 0.45, 200)
    lines = [
        Line(
            nu, [energy.time_step_ratio(x, depth) for x in nu], f"{depth:g}", "ours", n
        )
        for n, depth in enumerate((0.1, 0.05, 0.01))
    ]
    lines[0] = Line(nu, lines[0].y, r"$\alpha_{max}/R$ = 0.1", "ours", 0)
    panel = Panel(r"$\nu$ [-]", r"$\Delta T_{crit}/\Delta T_R$ [-]", lines)
    low, high = energy.time_step_ratio(0.4, 0.1), energy.time_step_ratio(0.2, 0.1)
    said = (
        f"Print says 0.9 to 1.0 for nu = 0.2 to 0.4 at 0.1; (72) gives {low:.3f} to "
        f"{high:.3f}. It goes with depth^(-1/4), not inversely as the text says, and "
        "is not a bound where CY exceeds 2."
    )
    return Result(said, [panel], across=1)


@NAN2022.item("figure-13", "Normal stiffness of Hertz and of JKR")
def figure_13() -> Result:
    """R* = 2.45 um, E* = 1.3 GPa, Gamma = 0.2 J/m^2."""
    k = NING.modulus, NING.radius, NING.adhesion
    end = jkr_contact.separation_length(*k)
    d = np.concatenate(
        [np.linspace(-0.999 * end, 0.0, 200), np.linspace(0, 20e-9, 300)[1:]]
    )
    a = np.array([jkr_contact.contact_radius(x, *k) for x in d])
    slope = np.array([jkr_contact.slope_at(x, *k) for x in a])
    plus = d[d >= 0.0]
    lines = [
        Line(d * 1e9, slope, "JKR"),
        Line(plus * 1e9, hertz_stiffness(NING, plus), "Hertz", LIMIT, 3),
    ]
    panel = Panel(r"$\alpha$ [nm]", r"$k_n$ [N/m]", lines, ylim=(0.0, 700.0))
    force = np.array([jkr_contact.force_at(x, *k) for x in a])
    rest = float(np.interp(0.0, force[d > 0], d[d > 0]))
    there = slope[d >= rest] / np.asarray(hertz_stiffness(NING, d[d >= rest]))
    said = (
        "The paper takes Hertz' stiffness for JKR's where the force is positive. From "
        f"{rest * 1e9:.2f} nm on, where that is so, JKR's is {there[0]:.3f} falling to "
        f"{there[-1]:.3f} times Hertz'."
    )
    return Result(said, [panel], across=1)


@NAN2022.item("table-2", "Stiffnesses from the digitised curves")
def table_2() -> Result:
    """(50) and (51) from the printed forces and overlaps."""
    columns: dict[str, list[object]] = {
        "curves of": [],
        "quantity": [],
        "value [N/m]": [],
        "printed [N/m]": [],
    }
    off = []
    for case in CASES:
        f, a = case.force, case.overlap
        rows = [
            (f"k_e {n + 1}", f[n] / (a[n] - case.rest[n]), case.stiffness[n])
            for n in range(3)
        ]
        slopes = [(f[n] - f[n + 1]) / (a[n] - a[n + 1]) for n in range(2)]
        rows.append(("k_p", 0.5 * sum(slopes), case.plastic))
        for name, value, printed in rows:
            off.append(value / printed - 1.0)
            for column, cell in zip(
                columns.values(), (case.name, name, value, printed), strict=True
            ):
                column.append(cell)
    said = (
        "The rows of the printed table are restored (its second column begins in the "
        "wrong one). (50) and (51) give the printed stiffnesses to "
        f"{100 * max(map(abs, off)):.1f} %: Ning's 958 and 639 are 1.4 and 3 % below "
        "their own printed forces and overlaps."
    )
    return Result(said, columns=columns)


TABLE_3 = {
    "Ning (1995)": (
        ("k_el [N/m]", 283.0, 418.0),
        ("k_H(alpha_y) [N/m]", 416.0, 353.0),
        ("alpha_y [nm]", 10.4, 7.5),
        ("alpha_0 [nm]", 7.3, 4.9),
        ("k_el/k_cl", 1.8, 2.7),
    ),
    "Du et al. (2007)": (
        ("k_el [N/m]", 6.7e4, 2.1e5),
        ("k_H(alpha_y) [N/m]", None, None),
        ("alpha_y [nm]", 1.35, 0.71),
        ("alpha_0 [nm]", 0.25, 0.08),
        ("k_el/k_cl", 3.9, 12.6),
    ),
}


@NAN2022.item("table-3", "Parameters at the yield point")
def table_3() -> Result:
    """With (44) and with (48)."""
    columns: dict[str, list[object]] = {
        name: []
        for name in ("particle", "parameter", "(44)", "printed", "(48)", "printed (48)")
    }
    off = []
    for case in CASES:
        found = []
        for plastic in (False, True):
            k, at = stiffness(case, plastic=plastic)
            tension = 1.5 * np.pi * case.adhesion * case.radius
            ratio = theory.stiffness_ratio(case.modulus, case.radius, case.adhesion, k)
            rest = 8.0 / 9.0 * tension / k
            hertz = float(hertz_stiffness(case, at))
            found.append((k, hertz, at * 1e9, rest * 1e9, ratio))
        for n, (name, first, second) in enumerate(TABLE_3[case.name]):
            row = (case.name, name, found[0][n], first, found[1][n], second)
            for column, cell in zip(columns.values(), row, strict=True):
                column.append("" if cell is None else cell)
            pairs = ((found[0][n], first), (found[1][n], second))
            off += [abs(a / b - 1.0) for a, b in pairs if b is not None]
    said = (
        f"All 18 printed numbers come out to {100 * max(off):.1f} % (for Ning with E* "
        "= 1.3 GPa, as Fig. 13 has it), most to their last digit. Du's k_H is not "
        "printed. (36) is k_cl/k_el in its print; (38), (39) and this table are the "
        "inverse."
    )
    return Result(said, columns=columns)
