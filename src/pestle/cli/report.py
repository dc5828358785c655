"""pestle report: the page about a run."""

from pathlib import Path
from typing import Annotated

import typer


def report(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="DIR", help="Output folder of a run.", show_default=False
        ),
    ],
) -> None:
    """Write the report of a run again: one page, opens without a server."""
    from pestle.cli.printing import shortened

    typer.echo(shortened(build_report(folder)))


def build_report(folder: Path) -> Path:
    """Write report.html into the folder of a run and return its path."""
    from pestle.report import build

    return Path(build(folder))
