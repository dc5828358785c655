"""Build the report of a run from its output folder alone."""

from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pestle.metrics import Metric, Summary, summarise, write_metrics
from pestle.metrics.flow_metrics import flow_curves
from pestle.metrics.heap import heap
from pestle.metrics.shear_cell import shear_curves
from pestle.metrics.tablet_metrics import key_frames
from pestle.report.inputs import input_tables
from pestle.report.numbers import duration, shown, with_unit
from pestle.report.pictures import album
from pestle.results.folder import REPORT, RunFolder

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_HERO = (
    "peak_relative_density",
    "heckel_yield_pressure",
    "residual_die_wall_stress",
    "ejection_stress",
    "axial_spring_back",
    "tensile_strength",
    "flow_energy",
    "internal_friction_angle",
    "cohesion",
    "flow_function_coefficient",
    "steady_friction",
    "angle_of_repose",
    "bulk_density",
    "radial_transmission",
    "coordination_pressed",
    "contact_area_fraction_pressed",
    "particles",
    "work_put_in",
    "ledger_residual",
)
_HERO_COUNT = 6


def build(
    folder: Path | str, *, references: Sequence[str] = (), pixels: int = 720
) -> Path:
    """Write ``report.html`` and ``metrics.json`` into an output folder.

    Parameters
    ----------
    folder : Path
        Output folder of a run.
    references : Sequence of str
        BibTeX entries to cite.
    pixels : int
        Width of the pictures [-].

    Returns
    -------
    Path
        The page: one file that opens without a server or a network.

    Raises
    ------
    InputError
        If the folder does not hold a run, or a part of it is damaged.
    """
    with RunFolder(Path(folder)) as run:
        summary = summarise(run)
        write_metrics(run.path, summary)
        page = _render(_context(run, summary, references, pixels))
        draft = run.path / (REPORT + ".new")
        draft.write_text(page, encoding="utf-8")
        return draft.replace(run.path / REPORT)


def _render(context: dict[str, Any]) -> str:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("pestle.report", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    folder = files("pestle.report") / "templates"
    context["css"] = (folder / "report.css").read_text(encoding="utf-8")
    context["script"] = (folder / "report.js").read_text(encoding="utf-8")
    return environment.get_template("report.html.j2").render(context)


def _context(
    run: RunFolder, summary: Summary, references: Sequence[str], pixels: int
) -> dict[str, Any]:
    case = run.case
    return {
        "title": (case.title if case and case.title else run.path.resolve().name),
        "sentence": _sentence(run, summary),
        "hero": _hero(summary),
        "warnings": summary.warnings,
        "unfinished": _unfinished(run),
        "ledger": _ledger(summary),
        "album": album(run, summary.curves, pixels=pixels),
        "figures": _figures(run, summary),
        "groups": _groups(summary),
        "inputs": input_tables(case) if case else [],
        "stages": _stages(run),
        "timing": _timing(run),
        "case_text": run.case_text,
        "references": references,
        "provenance": run.provenance,
    }


def _hero(summary: Summary) -> list[dict[str, str]]:
    by_key = {metric.key: metric for metric in summary.metrics}
    found = [by_key[key] for key in _HERO if key in by_key]
    return [_row(metric) for metric in found[:_HERO_COUNT]]


def _row(metric: Metric) -> dict[str, str]:
    value, unit = shown(metric)
    return {
        "key": metric.key,
        "label": metric.label,
        "value": value,
        "unit": unit,
        "definition": metric.definition,
    }


def _groups(summary: Summary) -> list[tuple[str, list[dict[str, str]]]]:
    groups: dict[str, list[dict[str, str]]] = {}
    for metric in summary.metrics:
        groups.setdefault(metric.group, []).append(_row(metric))
    return list(groups.items())


def _sentence(run: RunFolder, summary: Summary) -> str:
    """One or two sentences that say what happened."""
    count = summary.value("particles")
    who = f"{count:,.0f} particles" if count else "The powder"
    peak = summary.value("peak_axial_stress")
    density = summary.value("peak_relative_density")
    if peak is None or density is None:
        steps = ", ".join(dict.fromkeys(stage.step for stage in run.stages))
        return f"{who}: {steps}." if steps else f"{who}."
    text = (
        f"{who} were pressed to {with_unit(peak, 'Pa', 3)} and reached a relative "
        f"density of {density:.3f} in the die."
    )
    spring = summary.value("axial_spring_back")
    if spring is not None:
        text += f" The ejected tablet is {100 * spring:.1f} % thicker than it was"
        strength = summary.value("tensile_strength")
        if strength is not None:
            text += f" and has a tensile strength of {with_unit(strength, 'Pa', 3)}"
        text += "."
    return text


def _unfinished(run: RunFolder) -> str:
    if run.case is None or not run.stages:
        return ""
    begun = {stage.name for stage in run.stages}
    missing = [name for name in run.case.stage_names if name not in begun]
    return ", ".join(missing)


def _ledger(summary: Summary) -> str:
    residual = summary.value("ledger_residual")
    return "" if residual is None else f"{100 * residual:.2g} %"


def _figures(run: RunFolder, summary: Summary) -> dict[str, str]:
    """SVG of every figure that the run allows."""
    from pestle import plots

    drawn: dict[str, Figure | None] = {}
    curves = summary.curves
    if curves is not None:
        drawn["compaction"] = plots.compaction_curve(
            curves, summary.value("tablet_relative_density")
        )
        drawn["stress"] = plots.stress_paths(curves)
        drawn["heckel"] = plots.heckel_and_kawakita(curves)
    elif run.history is not None and len(run.history):
        drawn["walls"] = plots.wall_forces(run.history)
    if summary.value("flow_energy") is not None:
        drawn["flow"] = plots.flow_energy(flow_curves(run))
    drawn["shear"] = plots.shear_cell(shear_curves(run))
    pile = heap(run)
    if pile is not None:
        drawn["heap"] = plots.heap_profile(pile)
    if run.history is not None and summary.value("work_put_in") is not None:
        drawn["energy"] = plots.energy_ledger(run.history, _after_filling(run))
    frames = key_frames(run)
    if run.results is not None and frames:
        chosen = {key: run.results[number] for key, number in frames.items()}
        drawn["distributions"] = plots.sizes_and_forces(chosen)
    return {
        name: plots.to_svg(figure, name) for name, figure in drawn.items() if figure
    }


def _after_filling(run: RunFolder) -> int:
    """First row of the history after filling; 0 if nothing else happened."""
    assert run.history is not None
    kinds = [run.kind_of(stage) for stage in run.history.stages]
    later = [row for row, kind in enumerate(kinds) if kind != "fill"]
    return later[0] if later else 0


def _stages(run: RunFolder) -> list[dict[str, str]]:
    rows = []
    for stage in run.stages:
        wall = _number(stage.info.get("wall_time_s"))
        rows.append(
            {
                "name": stage.name,
                "kind": stage.step,
                "steps": f"{stage.end_step - stage.start_step:,}",
                "time": with_unit(stage.end_time - stage.start_time, "s", 3),
                "reason": stage.end_reason,
                "wall": duration(wall) if wall is not None else "",
            }
        )
    return rows


def _timing(run: RunFolder) -> list[tuple[str, str]]:
    """Rows about where and how long the run was computed."""
    record = run.provenance
    machine = record.get("machine")
    if not isinstance(machine, dict):
        machine = {}
    rows = []
    times = [_number(stage.info.get("wall_time_s")) for stage in run.stages]
    known = [seconds for seconds in times if seconds is not None]
    wall = _number(record.get("wall_time_s")) or sum(known)
    if wall:
        rows.append(("computing time", duration(wall)))
    if run.stages:
        last = run.stages[-1]
        particles = _number(record.get("particles"))
        if wall and particles:
            rate = particles * last.end_step / wall
            rows.append(
                ("speed", f"{rate / 1e6:.3g} million particle-steps per second")
            )
        rows.append(("simulated time", with_unit(last.end_time, "s", 3)))
        rows.append(("steps", f"{last.end_step:,}"))
    for label, value in (
        ("started", record.get("started")),
        ("threads", record.get("threads")),
        ("seed", record.get("seed")),
        ("processor", machine.get("processor")),
        ("cores", machine.get("cores")),
        ("system", machine.get("system")),
        ("pestle", record.get("pestle_version")),
        ("Python", machine.get("python")),
        ("case SHA-256", record.get("case_sha256")),
    ):
        if value is not None:
            rows.append((label, str(value)))
    return rows


def _number(value: object) -> float | None:
    """A time [s] or count from a file, None if it is none."""
    if isinstance(value, int | float) and 0.0 <= value < 1e12:
        return float(value)
    return None
