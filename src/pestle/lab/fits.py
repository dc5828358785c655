"""Published forms fitted to a study: constants, errors, a named parameter set."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from pestle.errors import InputError
from pestle.lab.mesh import Floats

QUANTILES = (0.5, 0.75, 0.9, 1.0)
PAPER = {
    "edmans2020": (2.9932, 0.1206, 0.4865, 0.2563, 0.3429),
    "zunker2024": (1.75, 4.4),
}
"""Table 1 of Edmans and Sinka (2020); Eq. (16) of Zunker and Kamrin (2024)."""
_DRAWS, _SEED = 100, 1


@dataclass(frozen=True)
class Fit:
    """Constants of a form and how well it fits.

    Parameters
    ----------
    study, form : str
        Whose form, and its formula.
    names : tuple of str
        Names of the constants.
    constants : tuple of float
        The fitted ones.
    published : tuple of float, optional
        Those of the paper.
    errors, published_errors : tuple of float
        Quantiles 0.5, 0.75, 0.9 and 1 of the relative error, fitted and published.
    count : int
        Number of points.
    spread : tuple of float
        Standard errors of the constants: of `edmans2020` by drawing its loadings anew
        with replacement, otherwise of least squares.
    """

    study: str
    form: str
    names: tuple[str, ...]
    constants: tuple[float, ...]
    published: tuple[float, ...] | None
    errors: tuple[float, ...]
    published_errors: tuple[float, ...] | None
    count: int
    spread: tuple[float, ...]


def fit(study: str, results: Sequence[dict[str, Any]]) -> Fit:
    """Fit the form of a study's paper to its results.

    Parameters
    ----------
    study : {"edmans2020", "zunker2024", "shahin2021"}
        Whose form.
    results : sequence of dict
        What `run_study` returns.
    """
    return FORMS[study](results)


def secant_stiffness(
    gammas: Sequence[float] | Floats, depth: Floats, ratio: Floats, poisson: Floats
) -> Floats:
    """Edmans and Sinka, Eqs. (3)-(5), with constants of one's own [1/R]."""
    g1, g2, g3, g4, g5 = gammas
    first = (
        2.8 * pi * (0.454 + 0.41 * poisson) * (1.0 - poisson**2) / (2 * ratio)
    ) ** 2
    y = np.maximum(depth / first - 1.0, 0.0)
    phi = g5 * y / (1.0 + g5 * y)
    bracket = g1 * depth + g2 * depth**-g3 + g4 * poisson
    return np.asarray(1.0 / depth + phi * ratio * bracket)


def _edmans(results: Sequence[dict[str, Any]]) -> Fit:
    """Least total absolute error of rho, as in the paper."""
    from scipy.optimize import minimize

    rows = [
        (row["dmax_R"], result["modulus_ratio"], result["poisson_ratio"], row["rho"])
        for result in results
        for row in result["unloading"]
    ]
    depth, ratio, poisson, rho = _columns(rows, 5, "edmans2020")
    loading = np.repeat(np.arange(len(results)), [len(r["unloading"]) for r in results])

    def fitted(start: Floats, weights: Floats, times: int) -> Floats:
        def error(gammas: Floats) -> float:
            found = secant_stiffness(gammas, depth, ratio, poisson)
            return float(weights @ np.abs(found - rho))

        for _ in range(times):  # a simplex that has shrunk too early starts anew
            found = minimize(
                error,
                start,
                method="Nelder-Mead",
                options={"maxiter": 9999, "maxfev": 9999, "xatol": 1e-8, "fatol": 1e-8},
            )
            start = np.asarray(found.x)
        return start

    best = fitted(np.array(PAPER["edmans2020"]), np.ones(len(rho)), 4)
    draw = np.random.default_rng(_SEED)
    others = []
    for _ in range(_DRAWS):
        drawn = draw.integers(len(results), size=len(results))
        weights = np.bincount(drawn, minlength=len(results))[loading]
        others.append(fitted(best, weights.astype(float), 1))

    def relative(gammas: Sequence[float] | Floats) -> Floats:
        found = secant_stiffness(gammas, depth, ratio, poisson)
        return np.asarray(np.abs(found / rho - 1.0))

    return Fit(
        "edmans2020",
        "rho = 1/d + phi E (g1 d + g2 d^-g3 + g4 nu), Eqs. (3)-(5)",
        ("gamma_1", "gamma_2", "gamma_3", "gamma_4", "gamma_5"),
        tuple(float(x) for x in best),
        PAPER["edmans2020"],
        _quantiles(relative(best)),
        _quantiles(relative(PAPER["edmans2020"])),
        len(rho),
        tuple(float(x) for x in np.std(others, axis=0)),
    )


def _zunker(results: Sequence[dict[str, Any]]) -> Fit:
    """Mean pressure over 0.03 to 0.5 R at the largest E/Y, least squares."""
    from scipy.optimize import curve_fit

    hardest = max(
        results, key=lambda r: (r["modulus_ratio"], -abs(0.3 - r["poisson_ratio"]))
    )
    rows = [(s["d_R"], s["pbar_Y"]) for s in hardest["loading"] if s["d_R"] >= 0.03]
    depth, pressure = _columns(rows, 3, "zunker2024")

    def form(d: Floats, a: float, b: float) -> Floats:
        return np.asarray(a * np.exp(-b * d) + 1.0)

    best, spread = curve_fit(form, depth, pressure, p0=PAPER["zunker2024"])
    return Fit(
        "zunker2024",
        "p/Y = a exp(-b d) + 1, Eq. (16)",
        ("a", "b"),
        tuple(float(x) for x in best),
        PAPER["zunker2024"],
        _quantiles(np.abs(form(depth, *best) / pressure - 1.0)),
        _quantiles(np.abs(form(depth, *PAPER["zunker2024"]) / pressure - 1.0)),
        len(depth),
        tuple(float(x) for x in np.sqrt(np.diag(spread))),
    )


def _shahin(results: Sequence[dict[str, Any]]) -> Fit:
    """Contact radius of perfectly plastic spheres beyond 0.01 R, least squares."""
    rows = [
        (s["d_R"], s["A_piR2"] ** 0.5)
        for result in results
        if result["case"]["exponent"] == 0.0
        for s in result["loading"]
        if s["d_R"] >= 0.01
    ]
    x, radius = _columns(rows, 4, "shahin2021")
    powers = np.stack([x**0.5, -(x**1.5), x**2.5], axis=1)
    best, rest, *_ = np.linalg.lstsq(powers, radius, rcond=None)
    spread = np.linalg.inv(powers.T @ powers) * rest / (len(x) - 3)
    return Fit(
        "shahin2021",
        "a/R = D1 x^(1/2) - D3 x^(3/2) + D5 x^(5/2), simple compression",
        ("D_1", "D_3", "D_5"),
        tuple(float(d) for d in best),
        None,
        _quantiles(np.abs(powers @ best / radius - 1.0)),
        None,
        len(x),
        tuple(float(d) for d in np.sqrt(np.diag(spread))),
    )


FORMS: dict[str, Callable[[Sequence[dict[str, Any]]], Fit]] = {
    "edmans2020": _edmans,
    "zunker2024": _zunker,
    "shahin2021": _shahin,
}
"""Forms by the study they are fitted to."""


def _columns(rows: Sequence[tuple[float, ...]], least: int, study: str) -> Floats:
    """Columns of rows; enough of them for a fit."""
    if len(rows) < least:
        raise InputError(
            "too-few-results",
            f"{len(rows)} results are too few to fit the form of {study}",
            hint="run the whole study, or more of it",
        )
    return np.array(rows, dtype=float).T


def _quantiles(errors: Floats) -> tuple[float, ...]:
    return tuple(float(q) for q in np.quantile(errors, QUANTILES))


def save(found: Fit, name: str, path: Path) -> None:
    """Write a named parameter set: constants, errors, where they come from."""
    lines = [
        f'name = "{name}"',
        f'form = "{found.form}"',
        f'study = "{found.study}"',
        f"points = {found.count}",
        "",
        "[constants]",
        *(f"{k} = {v!r}" for k, v in zip(found.names, found.constants, strict=True)),
        "",
        "[standard_error]",
        *(f"{k} = {v!r}" for k, v in zip(found.names, found.spread, strict=True)),
        "",
        "[relative_error]  # at these quantiles",
        *(
            f"q{int(100 * q)} = {e!r}"
            for q, e in zip(QUANTILES, found.errors, strict=True)
        ),
    ]
    draft = path.with_name(path.name + ".new")
    draft.write_text("\n".join(lines) + "\n", encoding="utf-8")
    draft.replace(path)


def load(path: Path) -> tuple[str, dict[str, float]]:
    """Study and constants of a parameter set that `save` wrote."""
    import tomllib

    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        return str(data["study"]), {k: float(v) for k, v in data["constants"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(
            "parameter-set-unreadable",
            f"{path} is no parameter set of the lab: {error}",
            hint="`pestle lab study` writes them",
        ) from error
