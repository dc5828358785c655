"""Shahin (2021), chapter 2: the curves of the law and the tables that follow from it.

The finite-element points of the thesis are left out.  Where the power of b_i in (2.14)
matters, the printed 1/2 is shown beside our i/2.
"""

import csv
from importlib.resources import files
from typing import Any

import numpy as np

from pestle.particle import shahin2021_hardness as law
from pestle.particle.configuration import CONFIGURATIONS
from pestle.particle.shahin2021_plastic import (
    GAMMA,
    Softening,
    density_product,
    lowest_point,
)
from pestle.particle.shahin2021_radius import (
    ALPHA,
    B_OF,
    BETA,
    DELTA,
    Coefficients,
    coefficients,
    relative_radius,
    rigid_coefficients,
)
from pestle.reproduce.item import PRINTED, Array, Line, Panel, Paper, Result

SHAHIN2021 = Paper(
    "shahin2021",
    "M. B. Shahin, master's thesis, Purdue University (2021)",
)

LAMBDAS = np.geomspace(100.0, 6000.0, 300)
LAMBDA_LABEL, X_LABEL = r"$\lambda$ [-]", r"$\gamma/2R$ [-]"

ENDS = {
    "simple": (0.5, "figure-2.21"),
    "die": (0.47, "figure-2.22"),
    "hydrostatic": (0.19, "figure-2.23"),
}


def table() -> list[tuple[str, float, float, float, float]]:
    """Rows of Table A.1: configuration, E, nu, sigma_y and lambda as printed."""
    text = (files("pestle.reproduce") / "shahin2021_table_a1.csv").read_text()
    rows = list(csv.reader(text.splitlines()))[1:]
    return [(row[0], *map(float, row[1:])) for row in rows]  # type: ignore[misc]


def printed_coefficients(lam: Any, configuration: str) -> Coefficients:
    """(2.14) as printed, with b_i^(1/2)."""
    rows = zip(ALPHA, BETA, DELTA, B_OF[configuration], strict=True)
    return Coefficients(
        *(b**0.5 * alpha * np.tanh(beta * lam**delta) for alpha, beta, delta, b in rows)
    )


@SHAHIN2021.item("figure-2.14", "Coefficients of the contact radius")
def figure_2_14() -> Result:
    """D_1, D_3, D_5 against lambda."""
    panels = []
    for n, name in enumerate(("D_1", "D_3", "D_5")):
        lines = []
        for number, configuration in enumerate(CONFIGURATIONS):
            ours = coefficients(LAMBDAS, configuration)[n]
            printed = printed_coefficients(LAMBDAS, configuration)[n]
            lines.append(Line(LAMBDAS, ours, configuration, "ours", number))
            if n and number:
                label = r"(2.14) as printed, $b_i^{1/2}$" if number == 1 else ""
                lines.append(Line(LAMBDAS, printed, label, PRINTED, number))
        title = f"({'abc'[n]}) ${name}$"
        panels.append(
            Panel(LAMBDA_LABEL, f"${name}$ [-]", lines, title, ("log", "linear"))
        )
    said = (
        "The thesis' figure is simple compression, where b_i = 1 and both readings are "
        "one; confined, the power i/2 of b_i gives Table 3.1 in the limit and the "
        "printed 1/2 does not."
    )
    return Result(said, panels)


@SHAHIN2021.item("figure-2.15", "Largest hardness and where it is")
def figure_2_15() -> Result:
    """(2.19) and (2.20) against lambda."""
    start = law.onset(LAMBDAS)
    rows = (
        (start.hardness_max, r"$H_{max}$ [-]"),
        (start.at_max, r"$\gamma/2R$ at $H_{max}$ [-]"),
    )
    panels = [
        Panel(LAMBDA_LABEL, label, [Line(LAMBDAS, y)], f"({letter})", ("log", "linear"))
        for letter, (y, label) in zip("ab", rows, strict=True)
    ]
    end = law.onset(1e60)
    said = (
        f"H_max tends to {float(end.hardness_max):.3f}, the similarity law has 3; no "
        "numbers are printed for the curves."
    )
    return Result(said, panels, across=2)


@SHAHIN2021.item("figure-2.16", "What the parameters of the plastic regime do")
def figure_2_16() -> Result:
    """(2.25) with one parameter varied at a time, lambda = 1721.55."""
    start = law.onset(1721.55)
    base = {"q": 8.0, "r": 2.0, "p": 1.5, "lowest": 0.8}
    changes = {
        "q": (4.0, 16.0),
        "r": (1.0, 4.0),
        "p": (1.0, 2.0),
        "lowest": (0.6, 1.0),
    }
    names = {"q": "q", "r": "r", "p": "p", "lowest": r"\gamma_{H_{min}}/2R"}
    x = np.linspace(float(start.at_max), 1.0, 400)
    panels = []
    for letter, (key, values) in zip("abcd", changes.items(), strict=True):
        lines = []
        for number, value in enumerate((base[key], *values)):
            v = {**base, key: value}
            y = v["lowest"] - float(start.at_max)
            s = y - np.arctan(2.0 * v["q"] / np.sinh(2.0 * v["q"] * y))
            soft = Softening(float(start.at_max), v["q"], v["r"], s)
            shape = np.where(x <= v["lowest"], soft.value(x), np.nan)
            hardness = float(start.hardness_max) - v["p"] * shape
            lines.append(
                Line(x, hardness, f"${names[key]}$ = {value:g}", "ours", number)
            )
        panels.append(
            Panel(X_LABEL, r"$H^{fp}$ [-]", lines, f"({letter})", ylim=(0.8, 3.1))
        )
    said = (
        "The solid curves are the thesis' reference set (q = 8, r = 2, p = 1.5, "
        "minimum at 0.8); it does not print the perturbed values, ours are in the "
        "legends."
    )
    return Result(said, panels, across=2)


@SHAHIN2021.item("figure-2.17", "Density product at the minimum of hardness")
def figure_2_17() -> Result:
    """The constant Gamma, and the deformation at which each confined law reaches it."""
    first = [Line(LAMBDAS, np.full_like(LAMBDAS, GAMMA), r"$\Gamma$ = 0.0593")]
    second = []
    reached = []
    for number, configuration in enumerate(("die", "hydrostatic")):
        d = coefficients(LAMBDAS, configuration)
        lowest = _lowest(d, configuration)
        product = density_product(lowest, relative_radius(lowest, d), configuration)
        reached.append(float(np.max(np.abs(product / GAMMA - 1.0))))
        second.append(Line(LAMBDAS, lowest, configuration, "ours", number))
        printed = _lowest(printed_coefficients(LAMBDAS, configuration), configuration)
        label = r"(2.14) as printed" if number == 0 else ""
        second.append(Line(LAMBDAS, printed, label, PRINTED, number))
    panels = [
        Panel(
            LAMBDA_LABEL,
            r"$\Gamma$ [-]",
            first,
            "(a)",
            ("log", "linear"),
            ylim=(0.0, 0.08),
        ),
        Panel(
            LAMBDA_LABEL,
            r"$\gamma/2R$ at $H_{min}$ [-]",
            second,
            "(b)",
            ("log", "linear"),
        ),
    ]
    said = (
        "Gamma is the thesis' mean over finite elements and enters as a number; (b), "
        "not in the thesis, is where the law reaches it, to "
        f"{max(reached):.0e} of its value."
    )
    return Result(said, panels, across=2)


def _lowest(d: Coefficients, configuration: str) -> Array:
    return np.asarray(lowest_point(d, configuration), dtype=float)


@SHAHIN2021.item("figure-2.18", "Smallest hardness of confined contacts")
def figure_2_18() -> Result:
    """H_min and its two estimates against lambda."""
    panels = []
    for letter, configuration in zip("ab", ("die", "hydrostatic"), strict=True):
        k = law.parameters(LAMBDAS, 1e3, configuration).plastic
        lines = [
            Line(LAMBDAS, k.estimates[0], r"$H_{min,1}$ (2.33)", "ours", 1),
            Line(LAMBDAS, k.estimates[1], r"$H_{min,2}$ (2.36)", "ours", 2),
            Line(LAMBDAS, k.hardness_min, "mean (2.37)", "ours", 0),
        ]
        title = f"({letter}) {configuration}"
        panels.append(
            Panel(LAMBDA_LABEL, r"$H_{min}$ [-]", lines, title, ("log", "linear"))
        )
    said = (
        "No numbers are printed for the curves; the finite-element points are left out."
    )
    return Result(said, panels, across=2)


@SHAHIN2021.item("figure-2.19", "Parameters q and r")
def figure_2_19() -> Result:
    """(2.39) and (2.40) against lambda."""
    k = law.parameters(LAMBDAS, 1e3, "simple").plastic.simple
    rows = ((k.q, "q [-]"), (k.r, "r [-]"))
    panels = [
        Panel(LAMBDA_LABEL, label, [Line(LAMBDAS, y)], f"({letter})", ("log", "linear"))
        for letter, (y, label) in zip("ab", rows, strict=True)
    ]
    return Result("No numbers are printed for the curves.", panels, across=2)


@SHAHIN2021.item("figure-2.20", "Parameter l of low compressibility")
def figure_2_20() -> Result:
    """(2.47): ln(1 - l) against zeta."""
    zeta = np.geomspace(30.0, 2e4, 200)
    y = -np.log1p(0.2335 * zeta)
    panel = Panel(
        r"$\zeta$ [-]", r"$\ln(1 - l)$ [-]", [Line(zeta, y)], scales=("log", "linear")
    )
    return Result("No numbers are printed for the curve.", [panel], across=1)


@SHAHIN2021.item("table-A.1", "Materials of the space-filling design")
def table_a1() -> Result:
    """Lambda from the printed constants beside the printed lambda."""
    rows = table()
    ours = [float(law.material_numbers(e, nu, y)[0]) for _, e, nu, y, _ in rows]
    printed = [row[-1] for row in rows]
    worst = max(abs(a / b - 1.0) for a, b in zip(ours, printed, strict=True))
    said = (
        f"All {len(rows)} printed lambdas agree with those of the printed, rounded "
        f"constants to {worst:.1e}; two rows are out of order (2703.51 before 2677.75, "
        "2275.87 before 2227.45)."
    )
    columns: dict[str, list[Any]] = {
        "configuration": [row[0] for row in rows],
        "E [MPa]": [row[1] for row in rows],
        "nu": [row[2] for row in rows],
        "sigma_y [MPa]": [row[3] for row in rows],
        "lambda": ours,
        "lambda, printed": printed,
    }
    return Result(said, columns=columns)


DISCRIMINANTS = {
    ("die", 1): -31.76,
    ("die", 2): -121.70,
    ("hydrostatic", 1): -300.49,
    ("hydrostatic", 2): -1191.71,
}


@SHAHIN2021.item("table-C.1", "Discriminants in the rigid-plastic limit")
def table_c1() -> Result:
    """Of F_1 = D_1 - D_3 x + D_5 x^2 and F_2 = D_1 - 3 D_3 x + 5 D_5 x^2."""
    ours: list[float] = []
    with_print: list[float] = []
    for configuration, n in DISCRIMINANTS:
        for found, d in (
            (ours, rigid_coefficients(configuration)),
            (with_print, printed_coefficients(1e60, configuration)),
        ):
            d1, d3, d5 = map(float, d)
            first, second = d3**2 - 4.0 * d1 * d5, 9.0 * d3**2 - 20.0 * d1 * d5
            found.append(first if n == 1 else second)
    printed = list(DISCRIMINANTS.values())
    worst = max(abs(a - b) for a, b in zip(ours, printed, strict=True))
    said = (
        f"All four printed numbers come out to {worst:.2g}, with b_i^(i/2) in (2.14); "
        "the printed b_i^(1/2) gives others, which proves the power."
    )
    columns: dict[str, list[Any]] = {
        "configuration": [c for c, _ in DISCRIMINANTS],
        "F": [n for _, n in DISCRIMINANTS],
        "discriminant/4R^2": ours,
        "printed": printed,
        "with (2.14) as printed": with_print,
    }
    return Result(said, columns=columns)
