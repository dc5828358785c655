"""Shahin (2021), figures 2.21 to 2.23: the law beside our finite elements.

The softest and the stiffest material of Table A.1 in each configuration.
"""

from math import pi

import numpy as np

from pestle.particle import shahin2021_hardness as law
from pestle.particle.shahin2021_plastic import plastic
from pestle.particle.shahin2021_radius import Coefficients, relative_radius
from pestle.reproduce.item import PRINTED, Line, Panel, Result
from pestle.reproduce.shahin2021 import (
    ENDS,
    SHAHIN2021,
    X_LABEL,
    printed_coefficients,
    table,
)
from pestle.reproduce.shahin2021_lab import with_lab


def _response(configuration: str) -> Result:
    """Hardness, contact radius and force of the softest and the stiffest material."""
    rows = [row for row in table() if row[0] == configuration]
    ends = [min(rows, key=lambda row: row[-1]), max(rows, key=lambda row: row[-1])]
    x = np.linspace(1e-5, ENDS[configuration][0], 1500)
    curves: list[list[Line]] = [[], [], []]
    for number, (_, e, nu, y, printed_lambda) in enumerate(ends):
        k = law.parameters(*law.material_numbers(e, nu, y), configuration)
        label = rf"$\lambda$ = {printed_lambda:g}"
        for kind, radius in (
            ("ours", k.radius),
            (PRINTED, printed_coefficients(k.onset.lam, configuration)),
        ):
            if kind == PRINTED and configuration == "simple":
                continue
            hardness = law.hardness(
                x, k if kind == "ours" else _with_radius(k, radius)
            ).value
            a = relative_radius(x, radius)
            shown = (
                label
                if kind == "ours"
                else ("(2.14) as printed" if number == 0 else "")
            )
            values = (hardness, a, pi * hardness * a**2)
            for lines, value in zip(curves, values, strict=True):
                lines.append(Line(x, value, shown, kind, number))
    labels = (r"$P/\sigma_y\pi a^2$ [-]", r"$a/R$ [-]", r"$P/\sigma_yR^2$ [-]")
    panels = [
        Panel(X_LABEL, label, lines, f"({letter})")
        for letter, label, lines in zip("abc", labels, curves, strict=True)
    ]
    panels, agreement = with_lab(configuration, panels, [row[-1] for row in ends])
    said = (
        "The softest and stiffest material of Table A.1; the thesis prints no numbers "
        f"for them.{agreement}"
    )
    if configuration != "simple":
        last = x[-1]
        ours, printed = (line.y[-1] for line in curves[2][2:4])
        said += (
            f" With (2.14) as printed the force at {last:g} and the largest lambda is "
            f"{100 * (printed / ours - 1):+.0f} % against ours."
        )
    return Result(said, panels)


def _with_radius(k: law.Parameters, d: Coefficients) -> law.Parameters:
    """The law with other coefficients of the radius and what follows from them."""
    middle = plastic(
        k.onset.hardness_max,
        k.onset.at_max,
        k.plastic.simple.q,
        k.plastic.simple.r,
        coefficients=d,
        configuration=k.configuration,
    )
    assert k.compaction is not None
    end = law.compaction(k.compaction.zeta, middle, k.configuration)
    return law.Parameters(k.configuration, k.onset, d, middle, end)


@SHAHIN2021.item("figure-2.21", "Simple compression")
def figure_2_21() -> Result:
    """Hardness, radius and force."""
    return _response("simple")


@SHAHIN2021.item("figure-2.22", "Die compression, moving contacts")
def figure_2_22() -> Result:
    """Hardness, radius and force."""
    return _response("die")


@SHAHIN2021.item("figure-2.23", "Hydrostatic compression")
def figure_2_23() -> Result:
    """Hardness, radius and force."""
    return _response("hydrostatic")
