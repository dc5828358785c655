"""Zunker and Kamrin (2024), Part I: pull-off of true profiles against elliptic ones.

The relaxed profiles of the lab are mapped by the MDR transform and peeled; the model
peels its ellipse.  A few seconds for all of it, beside the study that the profiles are
from.  The paper prints the works of adhesion in its figures only: here they are chosen
so that a_c/r_peak at 0.5 is what its text says, or below and above 1.
"""

from functools import cache

import numpy as np

from pestle.lab.packaged import table
from pestle.lab.pull_off import peel
from pestle.particle import Particle
from pestle.particle.pull_off import indenter, pull_off
from pestle.reference import peeling
from pestle.reference.ellipse import Ellipse
from pestle.reproduce.item import LAB, OURS, Line, Panel, Result
from pestle.reproduce.zunker2024 import ZUNKER2024, material
from pestle.reproduce.zunker2024_lab import D_MAX_LABEL, E_STAR, NU, OURS_IS

TARGETS = {12.5: (0.8, 1.15, 1.35), 200.0: (0.8, 1.06, 1.2)}
"""a_c/r_peak at 0.5 by E/Y; the middle ones are those of the paper's text."""


def _loaded(ratio: float, adhesion: float, displacement: float) -> Particle:
    particle = Particle(material(ratio, adhesion), 1.0, counts=(2,))
    particle.move([displacement])
    return particle


@cache
def _shape(ratio: float) -> Ellipse:
    return indenter(_loaded(ratio, 0.0, 0.5))


@cache
def work_of_adhesion(ratio: float, target: float) -> float:
    """Work of adhesion at which a_c of the ellipse is target times r_peak [E R]."""
    from scipy.optimize import brentq

    rows = table("zunker2024_unloading")
    one = rows.where(modulus_ratio=ratio, poisson_ratio=NU, dmax_R=0.5)
    goal = target * float(one["r_peak_R"][0])

    def miss(log_work: float) -> float:
        work = float(np.exp(log_work))
        found = peeling.critical_radius(
            _shape(ratio), modulus=E_STAR, work_of_adhesion=work
        )
        return found - goal

    return float(np.exp(brentq(miss, np.log(1e-12), np.log(10.0))))


@cache
def _panel(ratio: float, target: float, letter: str) -> tuple[Panel, float, float]:
    """Pull-off against displacement; deviation of the ellipse at 0.1 and at 0.5."""
    work = work_of_adhesion(ratio, target)
    profiles = table("zunker2024_relaxed").where(modulus_ratio=ratio)
    depths = [d for d in profiles.values("dmax_R") if d > 0.0]
    true, ellipse = [], []
    for d in depths:
        one = profiles.where(dmax_R=d)
        found = peel(one["r_R"], one["z_R"], work, E_STAR)
        true.append(-found.force / work)
        ellipse.append(-pull_off(_loaded(ratio, work, d)).force / work)
    lines = [
        Line(depths, true, "profile of finite elements", LAB, 0),
        Line(depths, ellipse, "MDR model", OURS, 1),
    ]
    title = f"({letter}) E/Y = {ratio:g}, $a_c/r_{{peak}}$ = {target:g}"
    panel = Panel(D_MAX_LABEL, r"$F_c/WR_o$ [-]", lines, title)
    off = np.array(ellipse) / np.array(true) - 1.0
    return panel, float(off[1]), float(off[-1])


def _words(found: list[tuple[Panel, float, float]]) -> str:
    ends = ", ".join(f"{100 * end:+.0f}" for _, _, end in found)
    starts = ", ".join(f"{100 * start:+.0f}" for _, start, _ in found)
    return (
        f"The ellipse's pull-off differs from that of the true profile by {starts} % "
        f"at 0.1 and by {ends} % at 0.5, panel by panel"
    )


@ZUNKER2024.item("figure-13cd", "Pull-off of true profiles and of the model")
def figure_13cd() -> Result:
    """A work of adhesion for each E/Y."""
    found = [
        _panel(ratio, TARGETS[ratio][1], letter)
        for letter, ratio in zip("cd", TARGETS, strict=True)
    ]
    works = ", ".join(
        f"{1.0 / work_of_adhesion(ratio, t[1]):.3g}" for ratio, t in TARGETS.items()
    )
    said = (
        f"{OURS_IS} {_words(found)}. E R_o/W is {works}: chosen for the a_c/r_peak "
        "shown."
    )
    return Result(said, [panel for panel, _, _ in found], across=2)


@ZUNKER2024.item("figure-F.20", "Pull-off with rising work of adhesion")
def figure_f20() -> Result:
    """Three works of adhesion for each E/Y."""
    cases = [(ratio, target) for ratio, t in TARGETS.items() for target in t]
    found = [
        _panel(ratio, target, letter)
        for letter, (ratio, target) in zip("abcdef", cases, strict=True)
    ]
    said = (
        f"{OURS_IS} {_words(found)}. As the paper says the model falls behind once "
        "there is a ring wider than a_c, (a) and (d), and not where a_c is wider."
    )
    return Result(said, [panel for panel, _, _ in found])
