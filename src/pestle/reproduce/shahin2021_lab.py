"""Shahin (2021), chapter 2: the finite-element figures, from our lab.

Up to five of the 17 materials a configuration, from the smallest lambda on.  Figures
read the tables of `pestle lab study shahin2021-materials`: simple compression on 1280
axisymmetric elements, die and hydrostatic on 864 bricks of an eighth.  The thesis
prints no numbers for its curves.
"""

from collections.abc import Sequence
from math import pi

import numpy as np

from pestle.lab.packaged import Table, table
from pestle.reproduce.item import LAB, Array, Line, Panel, Result
from pestle.reproduce.shahin2021 import SHAHIN2021, X_LABEL

LABELS = (r"$P/\sigma_y\pi a^2$ [-]", r"$a/R$ [-]", r"$P/\sigma_yR^2$ [-]")
MESHES = {
    "simple": "1280 axisymmetric elements",
    "die": "864 bricks of an eighth of the sphere",
    "hydrostatic": "864 bricks of an eighth of the sphere",
}


def lab_curves(configuration: str, flat: int = 1) -> list[tuple[float, float, Table]]:
    """E/Y, lambda and the curves x, hardness, radius, force of each material.

    Parameters
    ----------
    configuration : str
        simple, die or hydrostatic.
    flat : int
        1: the moving contacts; 2: the standing ones.
    """
    found = table(f"shahin2021-materials_{configuration}")
    curves = []
    for ratio in found.values("modulus_ratio"):
        one = found.where(modulus_ratio=ratio)
        nu = float(one["poisson_ratio"][0])
        if configuration == "simple":
            force, area = one["F_ER2"], pi * one["A_piR2"]
        else:
            force, area = one[f"F{flat}_force"], one[f"F{flat}_area"]
        touching = area > 0.0
        force, area = force[touching] * ratio, area[touching]
        columns = {
            "x": one["d_R"][touching],
            "hardness": force / area,
            "radius": np.sqrt(area / pi),
            "force": force,
        }
        curves.append((ratio, ratio / (1.0 - nu**2), Table(found.note, columns)))
    return curves


def _panels(configuration: str, flat: int = 1) -> list[Panel]:
    panels = []
    for letter, name, label in zip(
        "abc", ("hardness", "radius", "force"), LABELS, strict=True
    ):
        lines = []
        for number, (_, lam, one) in enumerate(lab_curves(configuration, flat)):
            text = rf"$\lambda$ = {lam:.0f}" if name == "hardness" else ""
            lines.append(Line(one["x"], one[name], text, LAB, number))
        panels.append(Panel(X_LABEL, label, lines, f"({letter})"))
    return panels


def _at(one: Table, name: str, x: float) -> float:
    return float(np.interp(x, one["x"], one[name]))


def _ends(configuration: str, at: float, flat: int = 1) -> str:
    curves = lab_curves(configuration, flat)
    values = ", ".join(
        f"{_at(one, 'hardness', at):.2f} ({lam:.0f})" for _, lam, one in curves
    )
    return f"at x = {at:g} the hardness is (lambda) {values}"


def _is(configuration: str) -> str:
    count = len(lab_curves(configuration))
    return f"Our finite elements ({MESHES[configuration]}), {count} of 17 materials"


@SHAHIN2021.item("figure-2.9", "Simple compression by finite elements")
def figure_2_9() -> Result:
    """Hardness, radius, force."""
    peaks = ", ".join(
        f"{one['hardness'][one['x'] > 0.003].max():.2f}"
        for _, _, one in lab_curves("simple")
    )
    said = (
        f"{_is('simple')}. The largest hardness beyond x = 0.003 is {peaks} with "
        f"rising lambda; {_ends('simple', 0.4)}: beyond the plastic onset it hardly "
        "depends on the material, as the thesis says."
    )
    return Result(said, _panels("simple"))


@SHAHIN2021.item("figure-2.10", "Die compression by finite elements, moving contacts")
def figure_2_10() -> Result:
    """Hardness, radius, force."""
    said = f"{_is('die')}; {_ends('die', 0.2)}. {STAIRCASE}"
    return Result(said, _panels("die"))


STAIRCASE = (
    "With so few nodes in contact the curves have steps of some 10 %; a tooth is "
    "no property of the material."
)


@SHAHIN2021.item("figure-2.11", "Hydrostatic compression by finite elements")
def figure_2_11() -> Result:
    """Hardness, radius, force."""
    said = (
        f"{_is('hydrostatic')}; {_ends('hydrostatic', 0.1)}. It rises from x = 0.15 "
        f"on, as the thesis says. {STAIRCASE}"
    )
    return Result(said, _panels("hydrostatic"))


@SHAHIN2021.item("figure-2.12", "Die compression by finite elements, standing contacts")
def figure_2_12() -> Result:
    """Hardness, radius, force against the displacement of the moving contacts."""
    ratios = []
    for moving, standing in zip(lab_curves("die"), lab_curves("die", 2), strict=True):
        a, b = (_at(c[2], "hardness", 0.4) for c in (moving, standing))
        ratios.append(b / a)
    said = (
        f"{_is('die')}. At x = 0.4 the pressure of a standing "
        f"contact is {min(ratios):.2f} to {max(ratios):.2f} of that of a moving one: "
        f"similar at the end, as the thesis says. {STAIRCASE}"
    )
    return Result(said, _panels("die", 2))


@SHAHIN2021.item("figure-2.13", "Low compressibility by finite elements")
def figure_2_13() -> Result:
    """Pressure near the end: hydrostatic, moving and standing contacts of the die."""
    panels = []
    for letter, kind, flat, start in (
        ("a", "hydrostatic", 1, 0.12),
        ("b", "die", 1, 0.3),
        ("c", "die", 2, 0.3),
    ):
        lines = []
        for number, (ratio, lam, one) in enumerate(lab_curves(kind, flat)):
            late = one["x"] >= start
            nu = np.sqrt(1.0 - ratio / lam)
            zeta = ratio / (3.0 * (1.0 - 2.0 * nu))
            x, y = one["x"][late], one["hardness"][late]
            lines.append(Line(x, y, rf"$\zeta$ = {zeta:.0f}", LAB, number))
        name = f"{kind}, {'moving' if flat == 1 else 'standing'}"
        panels.append(Panel(X_LABEL, LABELS[0], lines, f"({letter}) {name}"))
    said = (
        f"{_is('die')}, up to 0.46 in the die and 0.185 hydrostatically, where the "
        "thesis goes on to the full cell. The pressure rises at the end."
    )
    return Result(said, panels)


def with_lab(
    configuration: str, panels: list[Panel], lambdas: Sequence[float]
) -> tuple[list[Panel], str]:
    """Panels of the law with the lab's materials of these lambdas; how they agree."""
    found = {
        number: (lam, one)
        for _, lam, one in lab_curves(configuration)
        for number, wanted in enumerate(lambdas)
        if abs(lam / wanted - 1.0) < 0.01
    }
    start = 0.02 if configuration == "simple" else 0.06
    added, words = [], []
    for panel, name in zip(panels, ("hardness", "radius", "force"), strict=True):
        lines, law = list(panel.lines), [x for x in panel.lines if x.kind == "ours"]
        for number, (lam, one) in sorted(found.items()):
            own = law[number]
            text = "our finite elements" if number == 0 and name == "hardness" else ""
            lines.append(Line(one["x"], one[name], text, LAB, number))
            deep = one["x"] >= start
            off = _over(own, one["x"][deep]) / one[name][deep] - 1.0
            rms = 100.0 * float(np.sqrt(np.mean(off**2)))
            mean = f"{100 * off.mean():+.1f} % (rms {rms:.1f})"
            words.append(f"{name} {mean} at lambda = {lam:.0f}")
        added.append(
            Panel(panel.xlabel, panel.ylabel, lines, panel.title, panel.scales)
        )
    said = (
        f" Against our finite elements ({MESHES[configuration]}) beyond x = {start:g} "
        f"the law is off in the mean by: {'; '.join(words)}."
    )
    return added, said


def _over(line: Line, x: Array) -> Array:
    return np.asarray(np.interp(x, np.asarray(line.x), np.asarray(line.y)))
