"""Shahin (2021), section 2.6: the standing contacts of a die, recomputed."""

import numpy as np

from pestle.particle import shahin2021_hardness as law
from pestle.particle import shahin2021_secondary as standing
from pestle.particle.shahin2021_plastic import GAMMA, density_product
from pestle.particle.shahin2021_radius import coefficients
from pestle.reproduce.item import LIMIT, POINTS, Line, Panel, Result
from pestle.reproduce.shahin2021 import (
    LAMBDA_LABEL,
    LAMBDAS,
    SHAHIN2021,
    X_LABEL,
    table,
)

ONSETS = {
    163.08: 0.4159,
    386.40: 0.4115,
    1045.79: 0.4102,
    2841.32: 0.41,
    4954.40: 0.4098,
}
"""Table 2.4: where low compressibility begins in finite elements."""


def _materials() -> list[tuple[float, float, float, float]]:
    """E, nu, sigma_y and lambda of the softest and the stiffest material in a die."""
    rows = [row[1:] for row in table() if row[0] == "die"]
    return [min(rows, key=lambda row: row[-1]), max(rows, key=lambda row: row[-1])]


@SHAHIN2021.item("figure-2.26", "Parameters tau and omega")
def figure_2_26() -> Result:
    """(2.50) and (2.51) against lambda."""
    k = standing.growth(LAMBDAS)
    rows = (
        (k.tau, r"$\tau$ [mm$^{1-\omega}$]", "log"),
        (k.omega, r"$\omega$ [-]", "linear"),
    )
    panels = [
        Panel(LAMBDA_LABEL, label, [Line(LAMBDAS, y)], f"({letter})", ("log", scale))
        for letter, (y, label, scale) in zip("ab", rows, strict=True)
    ]
    said = "No numbers are printed. tau holds for millimetres and R = 10 mm."
    return Result(said, panels, across=2)


@SHAHIN2021.item("figure-2.27", "Displacement of the standing contacts")
def figure_2_27() -> Result:
    """(2.49) in millimetres, R = 10 mm."""
    lines = []
    gamma = np.linspace(1e-3, 2.0, 300)
    for number, lam in enumerate((123.41, 5933.40)):
        k = standing.growth(lam)
        label = rf"$\lambda$ = {lam:g}"
        lines.append(Line(gamma, k.tau * gamma**k.omega, label, "ours", number))
    panel = Panel(r"$\gamma$ [mm]", r"$\gamma_s$ [mm]", lines)
    said = "No numbers are printed; shown up to x = 0.1 (2 mm), the range of the fit."
    return Result(said, [panel], across=1)


@SHAHIN2021.item("figure-2.28", "Density product of the standing contacts")
def figure_2_28() -> Result:
    """(2.52) up to x = 0.1, where the law has a radius, and the points of Table 2.4."""
    x = np.linspace(1e-3, standing.LARGEST, 200)
    lines = []
    for number, (e, nu, y, lam) in enumerate(_materials()):
        start = law.onset(law.material_numbers(e, nu, y)[0])
        small = standing.small(x, start, coefficients(start.lam, "die"))
        product = density_product(x, small.radius, "die_secondary")
        lines.append(Line(product, x, rf"(2.52), $\lambda$ = {lam:g}", "ours", number))
    onsets = list(ONSETS.values())
    lines.append(Line([GAMMA] * 5, onsets, "Table 2.4", POINTS, 2))
    lines.append(Line([GAMMA, GAMMA], [0.0, 0.45], r"$\Gamma$", LIMIT, 1))
    panel = Panel(r"$\rho_V\rho_S$ [-]", X_LABEL, lines)
    said = (
        "The thesis' curves are finite elements. The law has a radius of the standing "
        "contact up to x = 0.1 only and cannot reach Gamma; Table 2.4's points are "
        "shown."
    )
    return Result(said, [panel], across=1)


@SHAHIN2021.item("figure-2.29", "Standing contacts at small deformation")
def figure_2_29() -> Result:
    """Radius and force up to x = 0.1."""
    x = np.linspace(1e-4, standing.LARGEST, 300)
    radius, force = [], []
    for number, (e, nu, y, lam) in enumerate(_materials()):
        start = law.onset(law.material_numbers(e, nu, y)[0])
        label = rf"$\lambda$ = {lam:g}"
        for configuration, kind in (("die", "ours"), ("simple", LIMIT)):
            c = standing.small(x, start, coefficients(start.lam, configuration))
            load = np.pi * c.hardness.value * c.radius**2
            shown = label if kind == "ours" else ""
            if kind == LIMIT and number == 0:
                shown = r"$b_i$ of simple compression"
            radius.append(Line(x, c.radius, shown, kind, number))
            force.append(Line(x, load, shown, kind, number))
    panels = [
        Panel(X_LABEL, r"$a_s/R$ [-]", radius, "(a)"),
        Panel(X_LABEL, r"$P_s/\sigma_yR^2$ [-]", force, "(b)"),
    ]
    said = (
        "The thesis does not say which b_i the radius takes: those of the die here, "
        "those of simple compression in grey, which changes it by 2.4 %. No numbers "
        "are printed."
    )
    return Result(said, panels, across=2)


@SHAHIN2021.item("figure-2.30", "Hardness of the standing contacts")
def figure_2_30() -> Result:
    """Small deformation, and from the onset of low compressibility on."""
    x = np.linspace(1e-4, standing.LARGEST, 300)
    lines = []
    onsets = (ONSETS[163.08], ONSETS[4954.40])
    for number, ((e, nu, y, lam), onset) in enumerate(
        zip(_materials(), onsets, strict=True)
    ):
        k = law.parameters(*law.material_numbers(e, nu, y), "die")
        small = standing.small(x, k.onset, coefficients(k.onset.lam, "die"))
        late = np.linspace(onset, 0.47, 200)
        large = standing.large(late, k, onset=onset)
        path = np.concatenate([x, [np.nan], late])
        hardness = np.concatenate([small.hardness.value, [np.nan], large.value])
        lines.append(Line(path, hardness, rf"$\lambda$ = {lam:g}", "ours", number))
    panel = Panel(X_LABEL, r"$P_s/\sigma_y\pi a_s^2$ [-]", lines)
    said = (
        "Between x = 0.1 and the onset of Table 2.4 the thesis has no law, and none is "
        "shown. No numbers are printed."
    )
    return Result(said, [panel], across=1)


@SHAHIN2021.item("table-2.4", "Onset of low compressibility, standing contacts")
def table_2_4() -> Result:
    """What the printed onsets imply; they cannot be derived from the law."""
    implied = [standing.radius_at_onset(x) for x in ONSETS.values()]
    said = (
        "Cannot be derived: the onsets are interpolated in the contact areas of finite "
        "elements, which the law does not give beyond x = 0.1. (2.52) = 0.0593 turns "
        f"them into contact radii of {min(implied):.4f} to {max(implied):.4f} R, "
        "rising with lambda, which is plausible and all that can be checked. Table A.1 "
        "has 2841.34 for the 2841.32 printed here."
    )
    columns = {
        "lambda": list(ONSETS),
        "gamma/2R, printed": list(ONSETS.values()),
        "a_s/R that (2.52) implies": implied,
    }
    return Result(said, columns=columns)
