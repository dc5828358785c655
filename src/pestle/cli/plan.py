"""pestle plan: what a case would take."""

from dataclasses import asdict
from typing import Annotated, Any

import typer

from pestle.cli.options import AsJson, CaseFile, Settings

_LOADED = 4.0  # below this, kernels were read from disk [s]


def plan(
    case: CaseFile,
    settings: Settings = None,
    large: Annotated[
        bool,
        typer.Option(
            "--large",
            help="Also 1e6 to 1e8 particles, on pestle and on LAMMPS if installed.",
        ),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Say what a run would take: particles, time step, steps, memory, time."""
    from pestle.cli.printing import duration, memory, print_json, print_table, quantity
    from pestle.config import Case

    loaded = Case.from_file(case, settings)
    from pestle import simulation

    planned = simulation.plan(loaded)
    more = []
    if large:
        from pestle.cli.estimates import estimates

        more = estimates(loaded, planned)
    if as_json:
        print_json({**asdict(planned), "large": more} if large else planned)
        return
    rows = [
        ("law", loaded.law.name),
        ("particles", f"{planned.particles}"),
        ("time step", quantity(float(f"{planned.time_step:.4g}"), "s")),
        ("  limited by", str(planned.time_step_reason)),
        ("steps", f"{planned.steps}"),
        ("memory", memory(planned.memory_bytes)),
        ("wall time", f"about {duration(planned.wall_time_s)}, without compiling"),
        ("  compiling", _compiling(planned.compile_time_s)),
    ]
    print_table(rows)
    typer.echo("")
    print_table(_stage_rows(planned.stages))
    if large:
        from pestle.cli.estimates import show

        typer.echo("")
        show(more)


def _compiling(seconds: float) -> str:
    """Say what is left to compile: nothing, for the probe ran the run's own kernels."""
    from pestle.cli.printing import duration

    if seconds < _LOADED:
        return "none: the compiled laws are on disk"
    return f"none left: took {duration(seconds)} just now, kept for the run"


def _stage_rows(stages: list[dict[str, Any]]) -> list[list[str]]:
    """Rows of a table of the stages; the keys are the columns, their unit in [ ]."""
    header = list(stages[0])
    rows = [[key.partition(" [")[0] for key in header]]
    for stage in stages:
        rows.append([_cell(key, stage.get(key)) for key in header])
    return rows


def _cell(key: str, value: Any) -> str:
    if value is None:
        return ""
    from pestle.cli.printing import quantity

    if isinstance(value, float):
        return quantity(float(f"{value:.3g}"), key.partition("[")[2].rstrip("]"))
    return str(value)
