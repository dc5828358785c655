"""Edmans and Sinka (2020): the figures of their 560 simulations, from our lab.

Every figure reads the tables of `pestle lab study edmans2020` and takes no time; the
study took 994 s of one processor.  Where the paper prints no numbers the sentence
compares with its words.
"""

from math import pi

import numpy as np

from pestle.lab.packaged import Table, table
from pestle.particle import edmans2020, etsion2005, mesarovic2000
from pestle.reproduce.edmans2020 import (
    D_LABEL,
    E_LABEL,
    EDMANS2020,
    NU,
    RATIOS,
    RHO_LABEL,
)
from pestle.reproduce.item import LAB, LIMIT, POINTS, Array, Line, Panel, Result

POISSONS = (0.0, 0.15, 0.3, 0.45)
F_LABEL = r"$F/\pi R^2\sigma_y$ [-]"
ALPHA_LABEL = r"$\alpha$ [-]"
OURS_IS = "Our finite elements (1280 elements; the paper has 6670)."


def unloading(poisson: float = NU) -> Table:
    """The unloadings of a Poisson ratio."""
    return table("edmans2020_unloading").where(poisson_ratio=poisson)


@EDMANS2020.item("figure-3", "Load-displacement curves")
def figure_3() -> Result:
    """Loading for all E/Y; unloading of E/Y = 10; first yield."""
    loads, paths = table("edmans2020_loading"), table("edmans2020_paths")
    yields = table("edmans2020_first_yield").where(poisson_ratio=NU)
    lines = []
    for number, e in enumerate(RATIOS):
        one = loads.where(modulus_ratio=e)
        x, force = one["d_R"], one["F_ER2"] * e / pi
        lines.append(Line(x, force, f"E/Y = {e:g}", LAB, number))
    circles = []
    for e, depth in zip(yields["modulus_ratio"], yields["depth_R"], strict=True):
        one = loads.where(modulus_ratio=e)
        if depth > one["d_R"][0]:
            force = np.interp(depth, one["d_R"], one["F_ER2"]) * e / pi
            circles.append((depth, float(force)))
    x, y = np.array(circles).T
    lines.append(Line(x, y, "first yield of the lab", POINTS, 0))
    ten = paths.where(modulus_ratio=10.0)
    for top in ten.values("dmax_R"):
        one = ten.where(dmax_R=top)
        lines.append(Line(one["d_R"], one["F_ER2"] * 10.0 / pi, "", LAB, 3))
    panel = Panel(r"$\delta/R$ [-]", F_LABEL, lines, xlim=(0.0, 0.85))
    soft = loads.where(modulus_ratio=1.0)
    flow = float(soft["plastic_ER3"][-1])
    ends = {e: loads.where(modulus_ratio=e)["F_ER2"][-1] * e / pi for e in RATIOS}
    said = (
        f"{OURS_IS} At E/Y = 1 nothing yields up to 0.5 in the paper; "
        f"here the plastic work is {flow:.1g} E R^3. At 0.5 the force is "
        f"{ends[1.0]:.2f}, {ends[10.0]:.2f}, {ends[100.0]:.2f} and {ends[1000.0]:.2f} "
        "at E/Y = 1, 10, 100 and 1000. Circles are the lab's own first yield, where "
        "the paper has its equation (5)."
    )
    return Result(said, [panel], across=1)


@EDMANS2020.item("figure-4", "Strain energy in loading and unloading")
def figure_4() -> Result:
    """Elastic work against displacement, loading to 0.5 and back."""
    loads, paths = table("edmans2020_loading"), table("edmans2020_paths")
    lines, peaks, left, tops = [], [], [], []
    for number, e in enumerate(RATIOS):
        one = loads.where(modulus_ratio=e)
        back = paths.where(modulus_ratio=e, dmax_R=0.5)
        unit = pi / (3.0 * e**2)  # (2/3) pi R^3 Y^2/(2E)
        x = np.concatenate([one["d_R"], back["d_R"]])
        energy = np.concatenate([one["elastic_ER3"], back["elastic_ER3"]]) / unit
        lines.append(Line(x, energy, f"E/Y = {e:g}", LAB, number))
        tops.append(float(energy.max()))
        top = int(np.argmax(one["elastic_ER3"]))
        peaks.append(float(one["d_R"][top]))
        left.append(float(energy[-1] / energy[len(one["d_R"]) - 1]))
    panel = Panel(
        r"$\delta/R$ [-]",
        r"elastic work over $\frac{2}{3}\pi R^3\,\sigma_y^2/2E$ [-]",
        lines,
        xlim=(0.0, 0.85),
    )
    early = [f"{d:.2f} ({e:g})" for e, d in zip(RATIOS, peaks, strict=True) if d < 0.49]
    said = (
        f"{OURS_IS} The maxima of the paper's curves lie within the loading for stiff "
        "particles; here at a displacement of (E/Y): "
        f"{', '.join(early)}. They reach {max(tops):.2f}: above 1, as the paper notes. "
        f"Of the energy at 0.5 "
        f"{100 * left[-1]:.0f} % is still there after unloading at E/Y = 1000, "
        f"{100 * left[0]:.0f} % at 1: residual stress, as the paper says."
    )
    return Result(said, [panel], across=1)


@EDMANS2020.item("figure-8", "Exponent of unloading")
def figure_8() -> Result:
    """Fitted exponents against displacement, all and small ones."""
    panels = [
        Panel(D_LABEL, ALPHA_LABEL, _exponents(NU, label=True), "(a)", xlim=(0, 0.75)),
        Panel(D_LABEL, ALPHA_LABEL, _exponents(NU, to=0.1), "(b)", xlim=(0.0, 0.1)),
    ]
    all_of_them = table("edmans2020_unloading")
    soft, hard = (
        unloading().where(modulus_ratio=e, dmax_R=0.5)["alpha"][0] for e in (1, 1000)
    )
    said = (
        f"{OURS_IS} As in the paper the exponent rises with displacement at E/Y = 1 "
        f"and 2 (to {soft:.2f} at 1) and falls towards 1 for stiff particles "
        f"({hard:.3f} at 1000). The power law has a median R^2 of "
        f"{np.median(all_of_them['R2']):.6f} over the 560 unloadings; the paper prints "
        "0.999847."
    )
    return Result(said, panels, across=2)


def _exponents(poisson: float, *, to: float = 0.5, label: bool = False) -> list[Line]:
    lines = []
    for number, e in enumerate(RATIOS):
        one = unloading(poisson).where(modulus_ratio=e)
        few = one["dmax_R"] <= to
        text = f"E/Y = {e:g}" if label else ""
        lines.append(Line(one["dmax_R"][few], one["alpha"][few], text, LAB, number))
    return lines


@EDMANS2020.item("figure-9", "Exponent against Etsion's")
def figure_9() -> Result:
    """Exponents of stiff particles beside (6)."""
    lines, ratios = [], []
    for number, e in enumerate((200.0, 500.0, 1000.0)):
        one = unloading().where(modulus_ratio=e)
        d = one["dmax_R"]
        lines.append(Line(d, one["alpha"], f"E/Y = {e:g}", LAB, number))
        law = etsion2005.exponent(d, edmans2020.first_yield(e, NU))
        lines.append(Line(d, law, "(6)" if number == 0 else "", LIMIT, number))
        ratios.append(float(np.max(np.abs(law / one["alpha"] - 1.0))))
    panel = Panel(D_LABEL, ALPHA_LABEL, lines)
    said = (
        f"{OURS_IS} Beyond 0.1 both fall with displacement, at different rates, as the "
        f"paper says; below it the lab's exponent rises. (6) is at most "
        f"{100 * max(ratios):.0f} % off here."
    )
    return Result(said, [panel], across=1)


@EDMANS2020.item("figure-10", "Stiffness ratio against displacement")
def figure_10() -> Result:
    """(8) against displacement over that of first yield."""
    lines = []
    for number, e in enumerate(RATIOS):
        one = unloading().where(modulus_ratio=e)
        x = one["dmax_R"] / edmans2020.first_yield(e, NU)
        ratio = one["rho"] * one["dmax_R"]
        lines.append(Line(x, ratio, f"E/Y = {e:g}", LAB, number))
    x = r"$\delta_{max}/\delta_c$ [-]"
    panel = Panel(x, r"$k_2/k_1$ [-]", lines, scales=("log", "log"))
    said = (
        f"{OURS_IS} Luding's law (7) would be straight lines on linear axes. "
        f"{_spread()} So the curves do not collapse on the relative displacement, as "
        "the paper finds. The axis has our reading of (5)."
    )
    return Result(said, [panel], across=1)


def _spread() -> str:
    """Stiffness ratio of different materials at one relative displacement."""
    at, found = 1000.0, []
    for e in RATIOS:
        one = unloading().where(modulus_ratio=e)
        x = np.log(one["dmax_R"] / edmans2020.first_yield(e, NU))
        if x[0] <= np.log(at) <= x[-1]:
            ratio = np.interp(np.log(at), x, one["rho"] * one["dmax_R"])
            found.append(f"{ratio:.1f} at E/Y = {e:g}")
    return f"At 1000 times the displacement of first yield it is {', '.join(found)}."


@EDMANS2020.item("figure-11", "Stiffness ratio against force")
def figure_11() -> Result:
    """(8) against the force before unloading."""
    lines, bends = [], []
    for number, e in enumerate(RATIOS):
        one = unloading().where(modulus_ratio=e)
        force = one["Fmax_ER2"] * e / pi
        ratio = one["rho"] * one["dmax_R"]
        lines.append(Line(force, ratio, f"E/Y = {e:g}", LAB, number))
        slopes = np.diff(ratio) / np.diff(force)
        if e >= 20.0:
            bends.append(float(slopes[-1] / slopes[0]))
    panel = Panel(F_LABEL, r"$k_2/k_1$ [-]", lines, scales=("log", "log"))
    said = (
        f"{OURS_IS} Walton and Braun's law would be straight on linear axes: from the "
        f"first to the last interval the slope changes by a factor of {min(bends):.2f} "
        f"to {max(bends):.2f} for E/Y of 20 and more."
    )
    return Result(said, [panel], across=1)


@EDMANS2020.item("figure-12", "Etsion's recovery against finite elements")
def figure_12() -> Result:
    """Secant stiffness of (9) over that of the lab."""
    lines, ends = [], []
    for number, e in enumerate((200.0, 500.0, 1000.0)):
        one = unloading().where(modulus_ratio=e)
        d = one["dmax_R"]
        law = etsion2005.secant_stiffness(d, edmans2020.first_yield(e, NU))
        ratio = law / one["rho"]
        lines.append(Line(d, ratio, f"E/Y = {e:g}", LAB, number))
        ends.append(f"{ratio[0]:.2f} to {ratio[-1]:.2f} at {e:g}")
    panel = Panel(D_LABEL, r"$\rho_{(9)}/\rho_{FE}$ [-]", lines)
    said = (
        f"{OURS_IS} From 0.01 to 0.5 the ratio goes from {', '.join(ends)}: best at "
        "the smallest displacement and E/Y, less recovery in the finite elements "
        "beyond, as in the paper. It depends on the reading of (5)."
    )
    return Result(said, [panel], across=1)


@EDMANS2020.item("figure-13", "Force against area in unloading")
def figure_13() -> Result:
    """Unloading from 0.5, beside Mesarovic and Johnson's (10)."""
    paths = table("edmans2020_paths").where(dmax_R=0.5)
    lines, away = [], {}
    for number, e in enumerate(RATIOS):
        one = paths.where(modulus_ratio=e)
        a = one["a_R"] / one["a_R"][0]
        force = one["F_ER2"] / one["F_ER2"][0]
        lines.append(Line(a**2, force, f"E/Y = {e:g}", LAB, number))
        law = mesarovic2000.force_ratio(np.clip(a, 0.0, 1.0))
        away[e] = float(np.sqrt(np.mean((force - law) ** 2)))
    a = np.linspace(0.0, 1.0, 200)
    law = mesarovic2000.force_ratio(a)
    lines.append(Line(a**2, law, "(10), Mesarovic and Johnson", LIMIT, 0))
    panel = Panel(r"$a^2/a_{max}^2$ [-]", r"$F/F_{max}$ [-]", lines)
    shown = ", ".join(f"{away[e]:.3f} ({e:g})" for e in (1.0, 5.0, 10.0, 50.0, 1000.0))
    said = (
        f"{OURS_IS} Root mean square of the difference in force from (10), at E/Y: "
        f"{shown}. The paper finds (10) realistic for low stiffness only, and a second "
        "separation at the contact's centre at E/Y = 10."
    )
    return Result(said, [panel], across=1)


def _stiffness_lines(poisson: float, label: bool) -> list[Line]:
    found, lines = unloading(poisson), []
    for number, d in enumerate(found.values("dmax_R")):
        one = found.where(dmax_R=d)
        e, rho = _sorted(one["modulus_ratio"], one["rho"])
        text = rf"$\delta_{{max}}/R$ = {d:g}" if label else ""
        lines.append(Line(e, rho, text, LAB, number))
        lines.append(Line([0.5, 3.0], [1.0 / d] * 2, "", LIMIT, 3))
    return lines


def _sorted(x: Array, y: Array) -> tuple[Array, Array]:
    order = np.argsort(x)
    return x[order], y[order]


@EDMANS2020.item("figure-18", "Secant stiffness against material, all Poisson ratios")
def figure_18() -> Result:
    """rho of the lab at constant displacement; elastic ones dotted."""
    panels = [
        Panel(
            E_LABEL,
            RHO_LABEL,
            _stiffness_lines(nu, label=nu == 0.0),
            rf"({letter}) $\nu$ = {nu:g}",
            ("log", "log"),
            xlim=(0.5, 6e4) if nu == 0.0 else (0.5, 1500.0),
        )
        for letter, nu in zip("abcd", POISSONS, strict=True)
    ]
    elastic = table("edmans2020_unloading").where(modulus_ratio=1.0)
    worst = np.max(np.abs(elastic["rho"] * elastic["dmax_R"] - 1.0))
    said = (
        f"{OURS_IS} At E/Y = 1 the lab gives the elastic 1/d_max within "
        f"{100 * worst:.2g} %; beyond yield rho is nearly linear in E/Y, as in the "
        "paper."
    )
    return Result(said, panels, across=2)


@EDMANS2020.item("figure-19", "Secant stiffness against displacement, with (3)")
def figure_19() -> Result:
    """rho of the lab with the circles of (3)."""
    panels, errors = [], []
    for letter, nu in zip("abcd", POISSONS, strict=True):
        lines = []
        for number, e in enumerate(RATIOS):
            one = unloading(nu).where(modulus_ratio=e)
            d = one["dmax_R"]
            law = edmans2020.secant_stiffness(d, e, nu)
            text = f"E/Y = {e:g}" if nu == 0.0 else ""
            lines.append(Line(d, one["rho"], text, LAB, number))
            text = "(3)" if nu == 0.15 and number == 0 else ""
            lines.append(Line(d, law, text, POINTS, number))
            errors.extend(np.abs(law / one["rho"] - 1.0))
        xlim = (0.0, 0.8) if nu == 0.0 else (0.0, 0.52)
        name = rf"({letter}) $\nu$ = {nu:g}"
        panels.append(Panel(D_LABEL, RHO_LABEL, lines, name, ("linear", "log"), xlim))
    shown = ", ".join(f"{100 * q:.2f}" for q in np.quantile(errors, (0.5, 0.75, 0.9)))
    said = (
        f"{OURS_IS} Median, 75th and 90th percentile of the relative error of (3) with "
        f"the printed constants: {shown} %, at most {100 * max(errors):.1f} %; the "
        "paper prints 1.84, 5.29, 11.78 and 36.33 %."
    )
    return Result(said, panels, across=2)


@EDMANS2020.item("figure-20", "Exponent, all Poisson ratios")
def figure_20() -> Result:
    """Fitted exponents against displacement."""
    panels = [
        Panel(
            D_LABEL,
            ALPHA_LABEL,
            _exponents(nu, label=nu == 0.0),
            rf"({letter}) $\nu$ = {nu:g}",
            xlim=(0.0, 0.8) if nu == 0.0 else (0.0, 0.52),
        )
        for letter, nu in zip("abcd", POISSONS, strict=True)
    ]
    return Result(f"{OURS_IS} {_exponent_words()}", panels, across=2)


def _exponent_words() -> str:
    ends = [
        [
            unloading(nu).where(modulus_ratio=e, dmax_R=0.5)["alpha"][0]
            for nu in (0.0, 0.45)
        ]
        for e in (1.0, 1000.0)
    ]
    (a, b), (c, d) = ends
    return (
        f"From nu = 0 to 0.45 the exponent at 0.5 goes from {a:.2f} to {b:.2f} at E/Y "
        f"= 1 and from {c:.3f} to {d:.3f} at 1000; the paper says that it rises for "
        "the elastic cases and falls somewhat at high E/Y."
    )


@EDMANS2020.item("figure-21", "Effect of the Poisson ratio on stiffness")
def figure_21() -> Result:
    """rho over that at nu = 0.3."""
    panels, spans = _over_usual("rho", r"$\rho/\rho(\nu = 0.3)$ [-]")
    said = (
        f"{OURS_IS} Shown over the value at nu = 0.3; rho differs from it by "
        f"{spans[0]} at 0.01 and {spans[1]} at 0.5: minor, as the paper says."
    )
    return Result(said, panels, across=2)


@EDMANS2020.item("figure-22", "Effect of the Poisson ratio on the exponent")
def figure_22() -> Result:
    """alpha over that at nu = 0.3."""
    panels, _ = _over_usual("alpha", r"$\alpha/\alpha(\nu = 0.3)$ [-]")
    said = f"{OURS_IS} Shown over the value at nu = 0.3. {_exponent_words()}"
    return Result(said, panels, across=2)


def _over_usual(name: str, ylabel: str) -> tuple[list[Panel], list[str]]:
    panels, spans = [], []
    for letter, d in zip("ab", (0.01, 0.5), strict=True):
        lines: list[Line] = []
        seen: list[float] = []
        usual = unloading().where(dmax_R=d)
        for number, nu in enumerate(POISSONS):
            one = unloading(nu).where(dmax_R=d)
            e, y = _sorted(one["modulus_ratio"], one[name])
            _, base = _sorted(usual["modulus_ratio"], usual[name])
            lines.append(Line(e, y / base, rf"$\nu$ = {nu:g}", LAB, number))
            seen.extend(y / base - 1.0)
        title = rf"({letter}) $\delta_{{max}}/R$ = {d:g}"
        panels.append(Panel(E_LABEL, ylabel, lines, title, ("log", "linear")))
        spans.append(f"{100 * min(seen):+.0f} to {100 * max(seen):+.0f} %")
    return panels, spans
