"""pestle plan --large: a case with many more particles, on each engine."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.simulation import Plan
    from pestle.simulation.probing import Sample

SIZES = (10**6, 10**7, 10**8)
"""Numbers of particles that are looked at [-]."""


def estimates(case: "Case", planned: "Plan") -> list[dict[str, Any]]:
    """Memory and time with the steps of the plan; LAMMPS on one rank.

    Time and memory of a particle are those of the probes: our own on all cores of this
    machine, LAMMPS' on one rank.
    """
    from pestle.errors import PestleError
    from pestle.lammps.probe import probe as probe_lammps
    from pestle.lammps.support import LAWS
    from pestle.simulation.build import make_engine
    from pestle.simulation.probing import probe
    from pestle.simulation.threads import set_threads

    many = _many(case)
    set_threads(None, many.count)
    ours = probe(make_engine(case)[0], many)
    each = ours.cost / many.count * planned.steps
    rows = [_row("pestle", n, each, 2.0 * ours.memory / many.count) for n in SIZES]
    if case.law.name not in LAWS:
        note = f"LAMMPS does not have the law {case.law.name}"
        return [*rows, {"engine": "lammps", "note": note}]
    try:
        cost, size = probe_lammps(case, many)
    except PestleError as error:
        return [*rows, {"engine": "lammps", "note": error.what}]
    return rows + [_row("lammps", n, cost * planned.steps, size) for n in SIZES]


def _many(case: "Case") -> "Sample":
    """As many particles of the case's sizes as a probe takes."""
    import numpy as np

    from pestle.simulation.probing import LARGEST, Sample, sample_of

    few = sample_of(case)
    columns = (few.radius, few.density, few.material)
    return Sample(LARGEST, *(np.resize(column, LARGEST) for column in columns))


def _row(engine: str, count: int, each: float, size: float) -> dict[str, Any]:
    return {
        "engine": engine,
        "particles": count,
        "wall_time_s": count * each,
        "memory_bytes": count * size,
    }


def show(rows: list[dict[str, Any]]) -> None:
    """Print the estimates as a table."""
    import typer

    from pestle.cli.printing import duration, memory, print_table

    table = [["engine", "particles", "memory", "wall time"]]
    for row in rows:
        if "note" not in row:
            count, time = f"{row['particles']:.0e}", duration(row["wall_time_s"])
            table.append([row["engine"], count, memory(row["memory_bytes"]), time])
    print_table(table)
    typer.echo(
        "of a pressed powder, with as many steps as above; pestle on all cores of this "
        "machine, lammps on one rank"
    )
    for row in rows:
        if "note" in row:
            typer.echo(f"lammps: {row['note']}")
