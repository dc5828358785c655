"""What a fit leaves behind: a figure of the residuals and a material set."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.bench.figure import unit_of
from pestle.fit.least_squares import Fit
from pestle.particle import library
from pestle.plots.style import BLUE, MUTED, ORANGE, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def draw_fit(fit: Fit) -> "Figure":
    """Measured and fitted curve above, residuals below."""
    x = fit.curve.displacement / fit.curve.radius
    factor, unit = unit_of(float(np.max(np.abs(fit.curve.force))), "N")
    with style():
        figure = new_figure(5.2, 4.6)
        top, bottom = figure.subplots(
            2, 1, sharex=True, gridspec_kw={"height_ratios": [2, 1]}
        )
        top.plot(
            x, fit.curve.force / factor, ".", color=BLUE, markersize=3, label="measured"
        )
        top.plot(x, fit.predicted / factor, color=ORANGE, label=fit.law)
        top.set_ylabel(f"force [{unit}]")
        top.legend(frameon=False, fontsize=8)
        bottom.plot(x, fit.residuals / factor, ".", color=BLUE, markersize=3)
        bottom.axhline(0.0, color=MUTED, linewidth=0.6)
        bottom.set_ylabel(f"residual [{unit}]")
        bottom.set_xlabel("approach / diameter [-]")
    return figure


def material_set(fit: Fit, *, source: str) -> str:
    """Material set of a fit as TOML, of the same form as the packaged ones.

    What belongs to the material alone stands in [material], what only the law knows in
    [suggested]; `low` and `high` are the 95 % interval.
    """
    from pestle.materials import CONSTANTS

    known = library.fields(fit.law)
    ends = dict(zip(fit.names, fit.interval(), strict=True))
    citations = [part.citation for part in library.find(fit.law) if part is not None]
    lines = [
        f"title = {json.dumps(f'{fit.law} fitted to {source}')}",
        "citation = '''",
        *dict.fromkeys(citations),
        "'''",
    ]
    for key, value in fit.parameters().items():
        if value is None:
            continue
        group = "material" if key in CONSTANTS else "suggested"
        unit = known[key].metadata.get("unit", "1")
        lines += ["", f"[{group}.{key}]", f"value = {_toml(value)}"]
        lines += [f"unit = {json.dumps(unit)}", f"source = {json.dumps(source)}"]
        if key in ends:
            low, high = ends[key]
            lines += [f"low = {float(low)!r}", f"high = {float(high)!r}"]
        note = "fitted; range: 95 % interval" if key in ends else "fixed in the fit"
        lines.append(f'note = "{note}"')
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    return json.dumps(value) if isinstance(value, str) else repr(float(value))


def save(fit: Fit, folder: Path, *, source: str) -> list[Path]:
    """Write material.toml, fit.json, residuals.csv and fit.svg; return their paths."""
    from pestle.bench.table import write_table

    folder.mkdir(parents=True, exist_ok=True)
    names = ("material.toml", "fit.json", "residuals.csv", "fit.svg")
    paths = [folder / name for name in names]
    paths[0].write_text(material_set(fit, source=source), encoding="utf-8")
    paths[1].write_text(json.dumps(summary(fit), indent=2) + "\n", encoding="utf-8")
    write_table(
        paths[2],
        {
            "approach [m]": fit.curve.approach,
            "force [N]": fit.curve.force,
            "fitted_force [N]": fit.predicted,
            "residual [N]": fit.residuals,
        },
    )
    draw_fit(fit).savefig(paths[3])
    return paths


def summary(fit: Fit) -> dict[str, Any]:
    """Everything about a fit as plain numbers."""
    return {
        "law": fit.law,
        "values": dict(zip(fit.names, fit.values.tolist(), strict=True)),
        "standard_errors": dict(zip(fit.names, fit.errors.tolist(), strict=True)),
        "interval_95": dict(zip(fit.names, fit.interval().tolist(), strict=True)),
        "correlation": fit.correlation.tolist(),
        "residual_standard_deviation [N]": fit.noise,
        "points": len(fit.residuals),
        "fixed": fit.fixed,
        "at_bound": list(fit.at_bound),
    }
