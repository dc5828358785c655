"""pestle sweep: many runs of a case."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pestle.cli.options import AsJson

if TYPE_CHECKING:
    from pestle.sweep import StudyProgress, StudyResult

StudyFile = Annotated[
    Path,
    typer.Argument(metavar="STUDY", help="Study file (TOML).", show_default=False),
]
Workers = Annotated[
    int | None,
    typer.Option(
        "--workers",
        metavar="N",
        min=1,
        max=1024,
        help="Processes on this machine, by default as many as cores and memory allow; "
        "the results do not depend on it.",
        show_default=False,
    ),
]
Scheduler = Annotated[
    str | None,
    typer.Option(
        "--scheduler",
        metavar="ADDRESS",
        help="Running Dask scheduler, tcp://host:8786, whose workers see the same "
        "folders.",
        show_default=False,
    ),
]


def sweep(
    study: StudyFile,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="DIR",
            help="Folder of the study, by default runs/ and the name of the file; runs "
            "that are in it are not computed again.",
            show_default=False,
        ),
    ] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    retry_failed: Annotated[
        bool,
        typer.Option("--retry-failed", help="Try runs again that failed before."),
    ] = False,
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Run a case with many values and write one table of all results.

    Ctrl-C or a kill loses nothing that is finished: the same command goes on.
    """
    import signal

    from pestle.cli.printing import print_json
    from pestle.cli.run import _stop_like_ctrl_c
    from pestle.config.study import StudySettings, read_settings
    from pestle.sweep import run_study

    settings = read_settings(StudySettings, study)
    folder = out if out is not None else Path("runs") / study.stem
    signal.signal(signal.SIGTERM, _stop_like_ctrl_c)
    try:
        result = run_study(
            settings,
            folder,
            workers=workers,
            scheduler=scheduler,
            retry_failed=retry_failed,
            progress=None if quiet else line,
        )
    except KeyboardInterrupt:
        typer.echo(f"the same command goes on in {folder}", err=True)
        raise
    if as_json:
        print_json(_fields(result))
    else:
        _say(result)
    _refuse_stopped(result)


def line(now: "StudyProgress") -> None:
    """Print how far a study is."""
    from pestle.cli.printing import duration

    words = [f"{now.done + now.failed}/{now.total} runs"]
    words += [f"{now.failed} failed"] if now.failed else []
    if now.left and now.done + now.failed < now.total:
        words.append(f"about {duration(now.left)} left")
    typer.echo(", ".join(words), err=True)


def _fields(result: "StudyResult") -> dict[str, object]:
    states = ("done", "failed", "stopped")
    counts = {state: result.count(state) for state in states}
    return {"folder": result.folder, "table": result.table, **counts}


def _say(result: "StudyResult") -> None:
    from pestle.cli.printing import shortened

    typer.echo(f"{result.count('done')} of {len(result.rows)} runs are done")
    reasons: dict[str, int] = {}
    for row in result.rows:
        if row.outcome.status == "failed":
            reasons[row.outcome.reason] = reasons.get(row.outcome.reason, 0) + 1
    for reason, count in reasons.items():
        typer.echo(f"{count} failed: {reason}")
    typer.echo(f"table: {shortened(result.table)}")


def _refuse_stopped(result: "StudyResult") -> None:
    """End with an error if runs are missing for a reason outside their cases."""
    from pestle.errors import SimulationError

    stopped = [row for row in result.rows if row.outcome.status == "stopped"]
    if stopped:
        raise SimulationError(
            "runs-stopped",
            f"{len(stopped)} of {len(result.rows)} runs stopped before their end: "
            f"{stopped[0].outcome.reason}",
            stopped[0].link,
            "remove the cause, then give the same command: it goes on with them",
        )
