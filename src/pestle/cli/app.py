"""All commands; each imports what it needs when it runs."""

from typing import Annotated

import typer

from pestle.cli.bench import bench
from pestle.cli.calibrate import calibrate
from pestle.cli.cite import cite
from pestle.cli.export import export
from pestle.cli.fit import fit
from pestle.cli.lab import lab
from pestle.cli.laws import laws
from pestle.cli.materials import materials
from pestle.cli.plan import plan
from pestle.cli.report import report
from pestle.cli.reproduce import reproduce
from pestle.cli.run import run
from pestle.cli.schema import schema
from pestle.cli.sweep import sweep

app = typer.Typer(
    name="pestle",
    help="Powder compaction with elastic-plastic adhesive particles.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

for _command in (
    *(
        run,
        plan,
        report,
        sweep,
        calibrate,
        laws,
        materials,
        fit,
        reproduce,
        cite,
        schema,
    ),
):
    app.command()(_command)
# these explain the law that they are given, so that they see --help themselves
app.command(context_settings={"help_option_names": []})(bench)

app.add_typer(lab, name="lab")
app.add_typer(export, name="export")


def _version(value: bool) -> None:
    if value:
        from pestle import __version__

        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """Powder compaction with elastic-plastic adhesive particles."""
