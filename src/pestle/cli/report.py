"""pestle report: the page about a run."""

from pathlib import Path
from typing import Annotated

import typer

from pestle.errors import InputError


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

    return build(folder, references=_references(folder))


def _references(folder: Path) -> list[str]:
    """BibTeX for the run's own copy of its case; none if that cannot be read."""
    from pestle.cli.cite import references
    from pestle.config import Case

    try:
        return references(Case.from_file(folder / "case.toml"))
    except InputError:
        return []
