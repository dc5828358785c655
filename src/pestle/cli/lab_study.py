"""pestle lab study: the grids of published studies, resumed and fitted."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pestle.cli.options import AsJson

if TYPE_CHECKING:
    from pestle.lab.fits import Fit
    from pestle.lab.study import StudyProgress


def study(
    name: Annotated[
        str,
        typer.Argument(
            metavar="STUDY",
            help="edmans2020, zunker2024, shahin2021 or shahin2021-materials.",
        ),
    ],
    subset: Annotated[
        bool, typer.Option("--subset", help="A few cases only: a minute or two.")
    ] = False,
    mesh: Annotated[str, typer.Option(help="coarse, medium or fine.")] = "coarse",
    workers: Annotated[
        int | None,
        typer.Option(
            min=1,
            max=1024,
            help="Number of processes, by default one for each core.",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder of the study, by default runs/lab/STUDY; cases that are in it "
            "are not computed again.",
            show_default=False,
        ),
    ] = None,
    set_name: Annotated[
        str | None,
        typer.Option(
            "--name",
            help="Name of the fitted parameter set, by default STUDY-lab.",
            show_default=False,
        ),
    ] = None,
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Compute a published grid on all cores and fit the paper's form to it.

    The folder `tables` has what `pestle reproduce --lab` draws figures from. Ctrl-C or
    a kill loses the cases at work only: the same command goes on.
    """
    import signal
    import time

    from pestle.cli.printing import print_json
    from pestle.cli.run import _stop_like_ctrl_c
    from pestle.errors import SimulationError
    from pestle.lab import fits, tables
    from pestle.lab.mesh import named
    from pestle.lab.study import cases, run_study

    named(mesh)
    grid = cases(name, subset=subset, mesh=mesh)
    folder = out if out is not None else Path("runs") / "lab" / name
    signal.signal(signal.SIGTERM, _stop_like_ctrl_c)
    start = time.monotonic()
    try:
        results = run_study(
            grid, folder, workers=workers, progress=None if quiet else _line
        )
    except KeyboardInterrupt:
        typer.echo(f"the same command goes on in {folder}", err=True)
        raise
    label = set_name or f"{name}-lab"
    found = fits.fit(name, results) if name in fits.FORMS else None
    if found is not None:
        fits.save(found, label, folder / f"{label}.toml")
    cpu = sum(result["cpu_s"] for result in results)
    tables.write(name, results, folder / "tables", _note(name, mesh, subset, cpu))
    if as_json:
        print_json({"cases": len(results), "cpu_s": cpu, "fit": found})
    else:
        wall = time.monotonic() - start
        typer.echo(f"{len(results)} cases, {cpu:.0f} s of processor time, {wall:.0f} s")
        if found is not None:
            show_fit(found, folder / f"{label}.toml")
    stopped = [result for result in results if result["stopped"]]
    if stopped:
        raise SimulationError(
            "cases-stopped-early",
            f"{len(stopped)} of {len(results)} cases stopped before their end",
            where=_name(stopped[0]),
            hint="their files say how far they came and why",
        )


def _note(name: str, mesh: str, subset: bool, cpu: float) -> str:
    """First line of the tables: where their numbers come from."""
    from pestle import __version__

    command = f"pestle lab study {name}" + (" --subset" if subset else "")
    cost = f"{cpu:.0f} s of processor time"
    return f"pestle {__version__}: `{command} --mesh {mesh}`; {cost}"


def _name(result: dict[str, Any]) -> str:
    return f"E/Y {result['modulus_ratio']:g}, nu {result['poisson_ratio']:g}"


def _line(now: "StudyProgress") -> None:
    from pestle.cli.printing import duration

    left = f", about {duration(now.left)} left" if now.done < now.total else ""
    typer.echo(f"{now.done}/{now.total} {now.name}{left}", err=True)


def show_fit(found: "Fit", path: Path) -> None:
    """Print constants, their errors and those of the form, beside the paper's."""
    from pestle.cli.printing import print_table, shortened
    from pestle.lab.fits import QUANTILES

    typer.echo(f"{found.form}, {found.count} points")
    rows = [["", "lab", "error", "paper"]]
    published = found.published or (None,) * len(found.names)
    columns = found.names, found.constants, found.spread, published
    for name, value, error, old in zip(*columns, strict=True):
        paper = "" if old is None else f"{old:.5g}"
        rows.append([name, f"{value:.5g}", f"{error:.2g}", paper])
    before = found.published_errors or (None,) * len(QUANTILES)
    for q, error, old in zip(QUANTILES, found.errors, before, strict=True):
        words = "largest error" if q == 1.0 else f"error, {100 * q:.0f} % below"
        shown = "" if old is None else f"{100 * old:.3g} %"
        rows.append([words, f"{100 * error:.3g} %", "", shown])
    print_table(rows)
    typer.echo(f"parameter set: {shortened(path)}")
