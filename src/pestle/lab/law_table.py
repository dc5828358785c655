"""Every law of a single particle beside the lab, over the range that it claims.

Loadings and unloadings are those of the packaged grid of Edmans and Sinka (perfectly
plastic).  A law of unloading starts from the lab's own peak, so that nothing of a law
of loading enters.  What claims a range outside of that grid has its own experiment.
"""

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from pestle.lab.compare import LEAST_DEPTH, branch_numbers, make_law
from pestle.lab.material import Hardening, Material
from pestle.lab.mesh import Floats
from pestle.lab.packaged import table
from pestle.lab.press import press
from pestle.lab.unloading import unloading_numbers

_POINTS = 1500


@dataclass(frozen=True)
class Claim:
    """A law and where it says that it holds.

    Parameters
    ----------
    law : str
        As for `compare`; behind a plus a law of unloading.
    ratios : tuple of float
        Smallest and largest E/Y [-].
    depths : tuple of float
        Smallest and largest depth [R].
    poissons : tuple of float
        Smallest and largest Poisson ratio of unloadings; loadings have 0.3 [-].
    """

    law: str
    ratios: tuple[float, float]
    depths: tuple[float, float]
    poissons: tuple[float, float] = (0.0, 0.45)


CLAIMS = (
    Claim("biwa1995", (500.0, 1000.0), (LEAST_DEPTH, 0.03)),
    Claim("cylinders2020", (5.0, 1000.0), (LEAST_DEPTH, 0.3)),
    Claim("shahin2021", (110.0, 1000.0), (LEAST_DEPTH, 0.05)),
    Claim("shahin2021", (110.0, 1000.0), (0.05, 0.5)),
    Claim("shahin2021_hardening", (500.0, 1000.0), (LEAST_DEPTH, 0.05)),
    Claim("shahin2021_hardening", (500.0, 1000.0), (0.05, 0.5)),
    Claim("zunker2024", (5.0, 20.0), (LEAST_DEPTH, 0.1), (0.3, 0.3)),
    Claim("zunker2024", (5.0, 20.0), (0.1, 0.5), (0.3, 0.3)),
    Claim("zunker2024", (50.0, 1000.0), (LEAST_DEPTH, 0.1), (0.3, 0.3)),
    Claim("zunker2024", (50.0, 1000.0), (0.1, 0.5), (0.3, 0.3)),
    Claim("shahin2021+edmans2020", (1.0, 1000.0), (0.01, 0.5)),
    Claim("shahin2021+mesarovic2000", (50.0, 1000.0), (0.01, 0.1)),
    Claim("shahin2021+cylinders2020", (20.0, 1000.0), (0.1, 0.5)),
)
"""Perfectly plastic laws; a rigid-plastic one is compared with the largest E/Y."""


@dataclass(frozen=True)
class Deviation:
    """Deviation of a law from the lab.

    Parameters
    ----------
    law, quantity : str
        Law; force, area, pressure, rho (relative) or alpha (absolute).
    ratios, depths : tuple of float
        Range of E/Y [-] and depth [R] that was compared.
    points : int
        Number of values.
    mean, rms, largest : float
        Mean, root mean square and the largest with its sign.
    """

    law: str
    quantity: str
    ratios: tuple[float, float]
    depths: tuple[float, float]
    points: int
    mean: float
    rms: float
    largest: float


def law_table(progress: Callable[[str], None] | None = None) -> list[Deviation]:
    """Deviations of all laws; takes a minute or two.

    Parameters
    ----------
    progress : callable, optional
        Called with the name of every law before its turn.
    """
    found: list[Deviation] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for claim in CLAIMS:
            if progress:
                progress(claim.law)
            loads, _, unloads = claim.law.partition("+")
            errors = _loading(claim) if not unloads else {}
            if unloads or loads == "zunker2024":
                errors.update(_unloading(claim))
            found.extend(_deviations(claim, errors))
        for claim, errors in _own_experiments(progress):
            found.extend(_deviations(claim, errors))
    return found


def _deviations(claim: Claim, errors: dict[str, Floats]) -> Iterator[Deviation]:
    name = claim.law.partition("+")
    shown = name[0] if not name[2] else f"unloading of {name[2]}"
    for quantity, values in errors.items():
        good = values[np.isfinite(values)]
        if good.size:
            yield Deviation(
                shown,
                quantity,
                claim.ratios,
                claim.depths,
                good.size,
                float(good.mean()),
                float(np.sqrt(np.mean(good**2))),
                float(good[np.argmax(np.abs(good))]),
            )


def _inside(values: Sequence[float], limits: tuple[float, float]) -> list[float]:
    return [v for v in values if limits[0] - 1e-9 <= v <= limits[1] + 1e-9]


def _loading(claim: Claim) -> dict[str, Floats]:
    """Force, area and pressure of a law over those of the lab, less 1."""
    grid = table("edmans2020_loading")
    parts = []
    for ratio in _inside(grid.values("modulus_ratio"), claim.ratios):
        one = grid.where(modulus_ratio=ratio)
        keep = (one["d_R"] >= claim.depths[0]) & (one["d_R"] <= claim.depths[1])
        d, force, area = (one[k][keep] for k in ("d_R", "F_ER2", "A_piR2"))
        rule = make_law(claim.law, Material(ratio, 0.3), _parameters(claim.law, ratio))
        parts.append(_ratios(rule, d, force, pi * area))
    return {k: np.concatenate([part[k] for part in parts]) for k in parts[0]}


def _parameters(law: str, ratio: float, exponent: float = 0.0) -> dict[str, float]:
    """What a rigid-plastic law needs: sigma = kappa strain^h, here kappa = Y."""
    if law in ("biwa1995", "shahin2021_hardening"):
        return {"strength": 1.0 / ratio, "hardening_exponent": exponent}
    return {}


def _ratios(rule: Any, d: Floats, force: Floats, area: Floats) -> dict[str, Floats]:
    path = np.union1d(np.linspace(0.0, d[-1], 400), d)
    curve = rule.follow(path, radius=1.0)
    at = np.searchsorted(path, d)
    own, own_area = curve.force[at], pi * curve.contact_radius[at] ** 2
    return {
        "force": own / force - 1.0,
        "area": own_area / area - 1.0,
        "pressure": own / own_area / (force / area) - 1.0,
    }


def _unloading(claim: Claim) -> dict[str, Floats]:
    """Secant stiffness (relative) and exponent (difference) against the lab."""
    grid = table("edmans2020_unloading")
    rho, alpha = [], []
    columns = ("modulus_ratio", "poisson_ratio", "dmax_R", "Fmax_ER2", "amax_R")
    numbers = ("rho", "alpha")
    rows = zip(*(grid[name] for name in (*columns, *numbers)), strict=True)
    for ratio, nu, depth, force, radius, lab_rho, lab_alpha in rows:
        limits = (claim.ratios, claim.poissons, claim.depths)
        pairs = zip((ratio, nu, depth), limits, strict=True)
        if not all(_inside([value], limit) for value, limit in pairs):
            continue
        own = _unload(claim.law, Material(ratio, nu), depth, force, radius)
        if own is not None:
            rho.append(own[0] / lab_rho - 1.0)
            alpha.append(own[1] - lab_alpha)
    return {"rho": np.array(rho), "alpha": np.array(alpha)}


def _unload(
    law: str, material: Material, depth: float, force: float, radius: float
) -> tuple[float, float] | None:
    """Secant stiffness and exponent of a law from a peak of the lab."""
    from pestle.particle import Cycle
    from pestle.particle.law import Peak

    rule = make_law(law, material, {})
    down = depth * (1.0 - np.linspace(0.0, 1.0, _POINTS) ** 3)
    if isinstance(rule, Cycle):
        assert rule.unloading is not None
        peak = Peak(np.array(depth), np.array(force), np.array(radius), 1.0)
        forces = rule.unloading.curve(down, peak).force
    else:
        up = np.linspace(0.0, depth, 200)
        forces = rule.follow(np.concatenate([up, down[1:]]), radius=1.0).force[199:]
    found = branch_numbers(depth, down, np.asarray(forces))
    return None if found is None else (found.numbers.rho, found.numbers.alpha)


def _own_experiments(
    progress: Callable[[str], None] | None,
) -> Iterator[tuple[Claim, dict[str, Floats]]]:
    """Etsion's small depths, and power-law hardening."""
    if progress:
        progress("etsion2005")
    depths = (0.002, 0.004, 0.006, 0.008, 0.01)
    result = press(Material(300.0, 0.3), depths[-1], depths, mesh="medium")
    claim = Claim("shahin2021+etsion2005", (300.0, 300.0), (0.002, 0.01))
    rho, alpha = [], []
    for branch in result.branches:
        lab, start = unloading_numbers(branch), branch.start
        own = _unload(
            claim.law, Material(300.0, 0.3), start.depth, start.force, start.radius[0]
        )
        if own is not None:
            rho.append(own[0] / lab.rho - 1.0)
            alpha.append(own[1] - lab.alpha)
    yield claim, {"rho": np.array(rho), "alpha": np.array(alpha)}
    exponent, reference, ratio = 0.5, 1e-3, 100.0
    yield_ratio = ratio / reference**exponent
    hardening = Hardening(exponent, reference)
    hard = press(Material(yield_ratio, 0.3, hardening), 0.5)
    for law, deepest in (("biwa1995", 0.03), ("shahin2021_hardening", 0.5)):
        if progress:
            progress(f"{law}, h = {exponent:g}")
        points = [p for p in hard.loading if LEAST_DEPTH <= p.depth <= deepest]
        d, force, radius = np.array([(p.depth, p.force, p.radius) for p in points]).T
        rule = make_law(law, Material(ratio, 0.3), _parameters(law, ratio, exponent))
        claim = Claim(f"{law}, h = 0.5", (ratio, ratio), (LEAST_DEPTH, deepest))
        yield claim, _ratios(rule, d, force, pi * radius**2)
