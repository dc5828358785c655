"""pestle materials: which material sets come with the package."""

from typing import TYPE_CHECKING, Annotated

import typer

from pestle.cli.options import AsJson

if TYPE_CHECKING:
    from pestle.materials import Material

Name = Annotated[
    str | None, typer.Argument(help="Show one set in full.", show_default=False)
]


def materials(name: Name = None, as_json: AsJson = False) -> None:
    """List the material sets, with the source of every value."""
    from pestle import materials as sets
    from pestle.cli.printing import print_json

    chosen = [sets.load(each) for each in ([name] if name else sets.names())]
    if as_json:
        print_json(chosen)
        return
    for material in chosen:
        typer.echo(f"{material.name}: {material.title}")
        if name:
            _print_values(material)
    if not name:
        typer.echo("\n`pestle materials NAME` shows values and sources")


def _print_values(material: "Material") -> None:
    from pestle.cli.printing import print_table, quantity

    rows = [("value", "", "range", "source (DOI)", "note")]
    for key, entry in material.values().items():
        limits = ""
        if entry.low is not None and entry.high is not None:
            low, high = (quantity(v, entry.unit) for v in (entry.low, entry.high))
            limits = f"{low} to {high}"
        shown = quantity(entry.value, entry.unit)
        rows.append((key, shown, limits, entry.source, entry.note))
    print_table(rows)
