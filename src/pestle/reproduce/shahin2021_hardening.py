"""Shahin (2021), chapter 3: power-law hardening, recomputed.

Shown are our reading, the printed one (3.48) with the factor of h in its first term
only, and the sign of (3.59) in the low-compressibility regime.
"""

from math import pi
from typing import Any

import numpy as np

from pestle.particle import biwa1995
from pestle.particle import shahin2021_hardening as law
from pestle.particle.configuration import CONFIGURATIONS
from pestle.particle.shahin2021_radius import relative_radius, rigid_coefficients
from pestle.reproduce.item import LIMIT, PRINTED, Line, Panel, Result
from pestle.reproduce.shahin2021 import SHAHIN2021, X_LABEL, printed_coefficients

EXPONENTS = {
    "simple": (0.01147, 0.32677, 0.66044, 0.98094),
    "die": (3.64464e-5, 0.37109, 0.68869, 0.99996),
    "hydrostatic": (0.03555, 0.30431, 0.66875, 0.99223),
}
ENDS = {"simple": 0.5, "die": 0.47, "hydrostatic": 0.19}
MCC = {"h": 0.6585, "kappa": 6.0272}
"""Calibrated microcrystalline cellulose: 1/m, kappa [MPa]."""


def _response(configuration: str) -> Result:
    x = np.linspace(1e-4, ENDS[configuration], 1200)
    radius: list[Line] = []
    pressure: list[Line] = []
    force: list[Line] = []
    largest = 0.0
    for number, h in enumerate(EXPONENTS[configuration]):
        ours = law.parameters(h, configuration)
        a = relative_radius(x, ours.radius)
        hardness = law.hardness(x, ours).value
        largest = max(largest, float(np.max(hardness)))
        label = f"1/m = {h:.4g}"
        radius.append(Line(x, a, label, "ours", number))
        pressure.append(Line(x, hardness, "", "ours", number))
        force.append(Line(x, pi * hardness * a**2, "", "ours", number))
        literal = law.hardness(
            x, law.parameters(h, configuration, reading="literal")
        ).value
        shown = "(3.48) as printed" if number == 1 else ""
        if number:
            pressure.append(Line(x, literal, shown, PRINTED, number))
        if number and configuration != "simple":
            other = law.hardness(x, law.parameters(h, configuration, lc_sign=1)).value
            force.append(
                Line(
                    x,
                    pi * other * a**2,
                    "(3.59) as printed" if number == 1 else "",
                    LIMIT,
                    3,
                )
            )
    top = 1.05 * largest
    panels = [
        Panel(X_LABEL, r"$a/R$ [-]", radius, "(a)"),
        Panel(
            X_LABEL, r"$P/\kappa\pi a^2$ [-]", pressure, "(b)", ylim=(-0.15 * top, top)
        ),
        Panel(X_LABEL, r"$P/\kappa R^2$ [-]", force, "(c)"),
    ]
    hardest = law.parameters(
        EXPONENTS[configuration][-1], configuration, reading="literal"
    )
    below = law.hardness(x, hardest).value < 0.0
    said = "The thesis prints no numbers for the curves. (3.48) as printed " + (
        f"makes the pressure negative from x = {x[np.argmax(below)]:.3f} on at the "
        "largest exponent."
        if np.any(below)
        else "jumps at the minimum of hardness."
    )
    if configuration != "simple":
        said += " Grey in (c): the sign of (3.59) instead of that of (3.57) and (3.58)."
    return Result(said, panels)


@SHAHIN2021.item("figure-3.6", "Hardening, simple compression")
def figure_3_6() -> Result:
    """Radius, pressure and force."""
    return _response("simple")


@SHAHIN2021.item("figure-3.7", "Hardening, die compression")
def figure_3_7() -> Result:
    """Radius, pressure and force."""
    return _response("die")


@SHAHIN2021.item("figure-3.8", "Hardening, hydrostatic compression")
def figure_3_8() -> Result:
    """Radius, pressure and force."""
    return _response("hydrostatic")


def _mcc(x: Any, configuration: str) -> tuple[Any, Any]:
    """Force over pi R^2 [MPa] and contact radius over R of the calibrated cellulose."""
    k = law.parameters(MCC["h"], configuration)
    a = relative_radius(x, k.radius)
    return MCC["kappa"] * law.hardness(x, k).value * a**2, a


@SHAHIN2021.item("figure-3.9", "Microcrystalline cellulose: force")
def figure_3_9() -> Result:
    """With the calibrated constants; the measured points are left out."""
    lines = []
    for number, configuration in enumerate(CONFIGURATIONS):
        x = np.linspace(1e-4, ENDS[configuration], 600)
        lines.append(Line(x, _mcc(x, configuration)[0], configuration, "ours", number))
    x = np.linspace(1e-4, 0.5, 400)
    geometry = biwa1995.two(1.0, 1.0)
    a = biwa1995.contact_radius(2.0 * x, geometry, MCC["h"])
    similar = MCC["kappa"] * biwa1995.hardness(x, MCC["h"]) * a**2
    lines.append(Line(x, similar, "similarity law", LIMIT, 3))
    panel = Panel(X_LABEL, r"$P/\pi R^2$ [MPa]", lines, ylim=(0.0, 12.0))
    at = float(_mcc(np.array([0.5]), "simple")[0][0])
    said = (
        "kappa = 6.0272 MPa and 1/m = 0.6585 are the thesis' calibration; the measured "
        "points are others' and left out. The law rises above the similarity law at "
        f"large deformation, {at:.2f} against {similar[-1]:.2f} MPa at 0.5, as the "
        "thesis says."
    )
    return Result(said, [panel], across=1)


@SHAHIN2021.item("figure-3.10", "Microcrystalline cellulose: contact radius")
def figure_3_10() -> Result:
    """With the calibrated constants."""
    lines = []
    for number, configuration in enumerate(CONFIGURATIONS):
        x = np.linspace(0.0, ENDS[configuration], 400)
        lines.append(Line(x, _mcc(x, configuration)[1], configuration, "ours", number))
    panel = Panel(X_LABEL, r"$a/R$ [-]", lines)
    said = "A prediction of the thesis; it prints no numbers for it."
    return Result(said, [panel], across=1)


TABLE_3_1 = {
    "simple": (1.7527, 2.3702, 3.3715),
    "die": (1.7943, 3.0451, 5.7169),
    "hydrostatic": (1.8959, 8.8138, 39.8654),
}


@SHAHIN2021.item("table-3.1", "Coefficients of the radius, rigid-plastic limit")
def table_3_1() -> Result:
    """Limit of (2.14), with b_i^(i/2) and with b_i^(1/2)."""
    columns: dict[str, list[Any]] = {
        "configuration": [],
        "coefficient": [],
        "value": [],
        "printed": [],
        "with (2.14) as printed": [],
    }
    for configuration, printed in TABLE_3_1.items():
        ours = rigid_coefficients(configuration)
        other = printed_coefficients(1e60, configuration)
        for n, name in enumerate(("D_1", "D_3", "D_5")):
            row = (configuration, name, ours[n], printed[n], float(other[n]))
            for column, value in zip(columns.values(), row, strict=True):
                column.append(value)
    agree = [
        abs(a / b - 1.0)
        for a, b in zip(columns["value"], columns["printed"], strict=True)
    ]
    said = (
        f"Eight of the nine printed numbers come out to {sorted(agree)[-2]:.1e}. The "
        f"ninth, D_5 hydrostatic, is 3.3715 * 2.9376^2.5 = {columns['value'][-1]:.3f}, "
        "not 39.8654: Table C.1 needs it, and the contact would not fill its face."
    )
    return Result(said, columns=columns)
