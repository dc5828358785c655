"""pestle calibrate: parameters from measured data."""

from pathlib import Path
from typing import Annotated, Any

import typer

from pestle.cli.options import AsJson
from pestle.cli.sweep import Scheduler, Workers


def calibrate(
    calibration: Annotated[
        Path,
        typer.Argument(
            metavar="CALIBRATION", help="Calibration file (TOML).", show_default=False
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="DIR",
            help="Folder of the results, by default runs/ and the name of the file; "
            "runs that are in it are not computed again.",
            show_default=False,
        ),
    ] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Find parameters that explain measured data, and how well they are known.

    Writes a material set, the samples of the posterior and a report page.
    """
    from pestle.calibrate import calibrate as run
    from pestle.cli.bench_run import plain_warnings
    from pestle.cli.printing import print_json, shortened
    from pestle.config.calibration import CalibrationSettings
    from pestle.config.study import read_settings

    settings = read_settings(CalibrationSettings, calibration)
    folder = out if out is not None else Path("runs") / calibration.stem

    def say(text: str) -> None:
        if not quiet:
            typer.echo(text, err=True)

    with plain_warnings():
        numbers = run(settings, folder, workers=workers, scheduler=scheduler, say=say)
    if as_json:
        print_json(numbers)
        return
    _print(numbers)
    typer.echo(f"material set: {shortened(folder / 'material.toml')}")
    typer.echo(f"report: {shortened(folder / 'report.html')}")


def _print(numbers: dict[str, Any]) -> None:
    from pestle.cli.printing import print_table, quantity

    rows = [("parameter", "median", "95 % credible interval")]
    for name, row in numbers["parameters"].items():
        low, high = (quantity(end, row["unit"]) for end in row["interval_95"])
        rows.append((name, quantity(row["value"], row["unit"]), f"{low} to {high}"))
    print_table(rows)
    for text in numbers["warnings"]:
        typer.echo(f"warning: {text}")
