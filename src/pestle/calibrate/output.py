"""What a calibration leaves behind: material set, numbers, chain, report page."""

import json
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.calibrate import figures
from pestle.calibrate.posterior import Posterior, warnings
from pestle.materials import CONSTANTS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pestle.calibrate.bulk import BulkResult
    from pestle.config.calibration import CalibrationSettings
    from pestle.fit import Fit


def material_set(
    settings: "CalibrationSettings", found: Posterior, fixed: Mapping[str, Any]
) -> str:
    """Material set as TOML, of the same form as the packaged ones.

    Values are medians, `low` and `high` the 95 % credible interval.
    """
    from pestle import __version__

    where = str(settings.source)
    lines = [
        f"title = {json.dumps(settings.title or 'a calibration')}",
        f"citation = {json.dumps('calibrated by pestle ' + __version__)}",
    ]
    ends = found.interval()
    for k, name in enumerate(found.names):
        short = name.rpartition(".")[2]
        lines += ["", f"[{group_of(name)}.{short}]"]
        lines += [f"value = {float(found.median[k])!r}"]
        lines += [f"unit = {json.dumps(found.units[k])}"]
        lines += [f"low = {float(ends[k, 0])!r}", f"high = {float(ends[k, 1])!r}"]
        lines += [f"source = {json.dumps(where)}"]
        lines += ['note = "calibrated; range: 95 % credible interval"']
    for name, value in fixed.items():
        if isinstance(value, int | float):
            lines += ["", f"[{group_of(name)}.{name}]", f"value = {float(value)!r}"]
            lines += [f"source = {json.dumps(where)}", f'unit = "{_unit(name)}"']
            lines += ['note = "fixed in the calibration"']
    return "\n".join(lines) + "\n"


def group_of(name: str) -> str:
    """Group of a material set that a parameter belongs to."""
    short = name.rpartition(".")[2]
    if short in CONSTANTS:
        return "material"
    between = ("sliding_friction", "rolling_friction", "work_of_adhesion")
    if short not in between:
        return "suggested"
    return "walls" if name.startswith("contacts.pairs") else "between"


def _unit(name: str) -> str:
    return {"youngs_modulus": "Pa", "yield_stress": "Pa", "density": "kg/m^3"}.get(
        name, "1"
    )


def summary(
    settings: "CalibrationSettings", found: Posterior, extra: Mapping[str, Any]
) -> dict[str, Any]:
    """Everything about a calibration as plain numbers."""
    from pestle import __version__

    ends = found.interval()
    return {
        "title": settings.title,
        "source": settings.source,
        "pestle_version": __version__,
        "seed": settings.seed,
        "parameters": {
            name: {
                "value": float(found.median[k]),
                "unit": found.units[k],
                "interval_95": [float(v) for v in ends[k]],
                "narrowing": float(found.narrowing[k]),
            }
            for k, name in enumerate(found.names)
        },
        "correlation": found.correlation.tolist(),
        "independent_samples": found.effective,
        "warnings": [*warnings(found), *extra.get("warnings", [])],
        **{k: v for k, v in extra.items() if k != "warnings"},
    }


def of_fit(best: "Fit") -> dict[str, Any]:
    """Numbers of the least squares of one particle."""
    from pestle.fit import summary as fit_summary

    return {"least_squares": fit_summary(best)}


def of_bulk(result: "BulkResult") -> dict[str, Any]:
    """Numbers of a calibration with runs."""
    told = []
    if not result.converged:
        told.append(
            "The surrogate is not yet as certain as the measurements: its error is in "
            "the intervals; raise bulk.most to narrow them."
        )
    if result.failed:
        told.append(f"{result.failed} of {result.runs} runs could not be used.")
    if float(np.max(result.cross_validation)) > 1.0:
        told.append(
            "Left out one by one, runs are missed by up to "
            f"{np.max(result.cross_validation):.1f} deviations of the measurements."
        )
    return {
        "warnings": told,
        "runs": result.runs,
        "converged": result.converged,
        "targets": [
            {
                "label": m.label,
                "measured": m.value,
                "deviation": m.deviation,
                "unit": m.unit,
                "predicted": float(result.predicted[k]),
                "surrogate_deviation": float(result.error[k]),
                "left_out_error": float(result.cross_validation[k]),
            }
            for k, m in enumerate(result.measured)
        ],
        "sensitivity": result.sensitivity,
    }


def save(
    settings: "CalibrationSettings",
    folder: Path,
    found: Posterior,
    *,
    numbers: dict[str, Any],
    drawn: "dict[str, Figure]",
    fixed: Mapping[str, Any],
) -> list[Path]:
    """Write material.toml, calibration.json, chain.npz and report.html."""
    folder.mkdir(parents=True, exist_ok=True)
    names = ("material.toml", "calibration.json", "chain.npz", "report.html")
    paths = [folder / name for name in names]
    paths[0].write_text(material_set(settings, found, fixed), encoding="utf-8")
    text = json.dumps(numbers, indent=2, ensure_ascii=False)
    paths[1].write_text(text + "\n", encoding="utf-8")
    np.savez(paths[2], names=np.array(found.names), values=found.values)
    drawn = {"posterior": figures.draw_posterior(found), **drawn}
    paths[3].write_text(page(settings, numbers, drawn), encoding="utf-8")
    return paths


def shown(value: float, unit: str, digits: int = 4) -> str:
    """Text of a quantity in a unit that suits its size."""
    from pestle.report.numbers import quantity

    return " ".join(quantity(value, "-" if unit == "1" else unit, digits)).strip()


def page(
    settings: "CalibrationSettings",
    numbers: dict[str, Any],
    drawn: "dict[str, Figure]",
) -> str:
    """Report page: one file that opens without a server."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    from pestle.plots.style import to_svg

    environment = Environment(
        loader=PackageLoader("pestle.calibrate", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["shown"] = shown
    css = (files("pestle.report") / "templates" / "report.css").read_text("utf-8")
    template = environment.get_template("calibration.html.j2")
    return template.render(
        css=css,
        numbers=numbers,
        names=list(numbers["parameters"]),
        title=settings.title or "Calibration",
        figures={name: to_svg(figure, name) for name, figure in drawn.items()},
    )
