"""pestle export: a case for another program."""

from pathlib import Path
from typing import Annotated

import typer

from pestle.cli.options import CaseFile, Settings

export = typer.Typer(help="Write a case for another program.", no_args_is_help=True)


@export.command()
def lammps(
    case: CaseFile,
    settings: Settings = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="DIR",
            help="Folder of the deck, by default lammps/ and the name of the case.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Write the deck of a case for LAMMPS, to run it on a cluster.

    What LAMMPS cannot do is refused with a sentence that names it.
    """
    from pestle.cli.printing import shortened
    from pestle.config import Case
    from pestle.lammps import make_deck
    from pestle.lammps.model import notes

    loaded = Case.from_file(case, settings)
    folder = out if out is not None else Path("lammps") / case.stem
    for path in make_deck(loaded).write(folder):
        typer.echo(f"wrote {shortened(path)}")
    for note in notes(loaded):
        typer.echo(f"note: {note}", err=True)


@export.callback()
def _group() -> None:
    """Write a case for another program."""
