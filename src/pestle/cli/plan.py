"""pestle plan: what a case would take."""

from typing import Any

import typer

from pestle.cli.options import AsJson, CaseFile, Settings


def plan(case: CaseFile, settings: Settings = None, as_json: AsJson = False) -> None:
    """Say what a run would take: particles, time step, steps, memory, time."""
    from pestle.cli.printing import duration, memory, print_json, print_table, quantity
    from pestle.config import Case

    loaded = Case.from_file(case, settings)
    from pestle import simulation

    planned = simulation.plan(loaded)
    if as_json:
        print_json(planned)
        return
    rows = [
        ("law", loaded.law.name),
        ("particles", f"{planned.particles}"),
        ("time step", quantity(planned.time_step, "s")),
        ("  limited by", str(planned.time_step_reason)),
        ("steps", f"{planned.steps}"),
        ("memory", memory(planned.memory_bytes)),
        ("wall time", f"about {duration(planned.wall_time_s)}"),
    ]
    print_table(rows)
    typer.echo("stages")
    for name, stage in zip(loaded.stage_names, planned.stages, strict=False):
        typer.echo(f"  {name}: {_words(stage)}" if _words(stage) else f"  {name}")


def _words(stage: Any) -> str:
    """Words for a stage, whatever a plan says about it."""
    from pestle.cli.printing import plain

    described = plain(stage)
    if not isinstance(described, dict):
        return str(described)
    known = {key: value for key, value in described.items() if key != "name"}
    return ", ".join(f"{key} {_number(value)}" for key, value in known.items())


def _number(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
