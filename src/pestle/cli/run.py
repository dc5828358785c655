"""pestle run: compute a case."""

import signal
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from pestle.cli.options import AsJson, CaseFile, Settings, Threads
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.simulation import RunResult

_WRITTEN = (
    "case.toml",
    "checkpoint.npz",
    "data.lammps",
    "history.csv",
    "in.lammps",
    "log.lammps",
    "metrics.json",
    "provenance.json",
    "report.html",
    "results.vtkhdf",
    "stages.json",
)


def run(
    case: CaseFile,
    settings: Settings = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="DIR",
            help="Output folder; by default runs/ and the name of the case.",
            show_default=False,
        ),
    ] = None,
    threads: Threads = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue from the last checkpoint.")
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace an earlier run in DIR.")
    ] = False,
    engine: Annotated[
        Literal["pestle", "lammps"],
        typer.Option(help="What computes it; lammps refuses what it does not have."),
    ] = "pestle",
    ranks: Annotated[
        int,
        typer.Option(metavar="N", min=1, max=100_000, help="MPI ranks of LAMMPS."),
    ] = 1,
    as_json: AsJson = False,
    quiet: Annotated[
        bool, typer.Option("--quiet", "-q", help="No progress, no summary.")
    ] = False,
) -> None:
    """Compute a case and write its results and report.

    Ctrl-C stops at once and loses nothing: --resume goes on from there.
    """
    from pestle.cli.progress import progress
    from pestle.config import Case

    loaded = Case.from_file(case, settings)
    folder = out if out is not None else Path("runs") / case.stem
    on_lammps = engine == "lammps"
    _refuse_mixed(on_lammps, ranks=ranks, threads=threads, resume=resume)
    _prepare(folder, resume=resume, overwrite=overwrite)
    signal.signal(signal.SIGTERM, _stop_like_ctrl_c)
    from pestle import lammps, simulation

    try:
        with progress(quiet=quiet) as report:
            if on_lammps:
                result = lammps.run(loaded, folder, ranks=ranks, progress=report)
            else:
                result = simulation.run(
                    loaded, out=folder, threads=threads, resume=resume, progress=report
                )
        if str(result.stop_reason) == "interrupted":
            raise KeyboardInterrupt
    except KeyboardInterrupt:
        if not on_lammps:
            _say_how_to_go_on(case, folder, threads, settings)
        raise
    _finish(result, as_json=as_json, quiet=quiet)


def _refuse_mixed(
    on_lammps: bool, *, ranks: int, threads: int | None, resume: bool
) -> None:
    """Refuse options of one engine with the other."""
    if on_lammps and (resume or threads is not None):
        option = "--resume" if resume else "--threads"
        hint = "LAMMPS runs from its beginning" if resume else "use --ranks"
        what = f"{option} belongs to pestle's own engine"
        raise InputError("contradiction", what, option, hint)
    if not on_lammps and ranks != 1:
        what = "--ranks belongs to --engine lammps"
        hint = "pestle's own engine has --threads"
        raise InputError("contradiction", what, "--ranks", hint)


def _finish(result: "RunResult", *, as_json: bool, quiet: bool) -> None:
    """Write the report and print the summary."""
    from pestle.cli.printing import duration, print_json, shortened
    from pestle.cli.report import build_report

    page = build_report(Path(result.out))
    if as_json:
        print_json({**_fields(result), "report": page})
    elif not quiet:
        typer.echo(f"{result.steps} steps in {duration(result.wall_time)}")
        for warning in result.metrics.get("warnings", ()):
            typer.echo(f"warning: {warning}")
        typer.echo(f"report: {shortened(page)}")


def _fields(result: "RunResult") -> dict[str, object]:
    keys = ("out", "stop_reason", "metrics", "steps", "wall_time")
    return {key: getattr(result, key) for key in keys}


def _prepare(folder: Path, *, resume: bool, overwrite: bool) -> None:
    """Refuse to mix two runs in one folder."""
    if folder.exists() and not folder.is_dir():
        raise InputError("not-a-folder", f"{folder} is a file", "--out")
    if resume and overwrite:
        what = "--resume and --overwrite contradict each other"
        raise InputError("contradiction", what, "--resume", "keep one")
    present = [name for name in _WRITTEN if (folder / name).exists()]
    if resume or not present:
        return
    if not overwrite:
        raise InputError(
            "folder-in-use",
            f"{folder} holds an earlier run",
            "--out",
            "--resume goes on with it, --overwrite replaces it, or name another --out",
        )
    for name in present:
        (folder / name).unlink()


def _stop_like_ctrl_c(number: int, frame: FrameType | None) -> None:
    """Handle SIGTERM as whatever Ctrl-C does at this moment."""
    signal.raise_signal(signal.SIGINT)


def _say_how_to_go_on(
    case: Path, folder: Path, threads: int | None, settings: list[str] | None
) -> None:
    import shlex

    words = ["pestle", "run", str(case), "--out", str(folder)]
    words += ["--threads", str(threads)] if threads is not None else []
    for setting in settings or ():
        words += ["--set", setting]
    typer.echo(f"continue with: {shlex.join([*words, '--resume'])}", err=True)
