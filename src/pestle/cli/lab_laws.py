"""pestle lab laws: every law of one particle against the finite elements."""

from typing import TYPE_CHECKING, Annotated

import typer

from pestle.cli.options import AsJson

if TYPE_CHECKING:
    from pestle.lab.law_table import Deviation


def laws(
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Deviation of every law of one particle from the lab, over the range it claims.

    Reads the packaged grid of Edmans and Sinka; a minute or two.
    """
    from pestle.cli.printing import print_json, print_table
    from pestle.lab.law_table import law_table

    found = law_table(None if quiet else lambda name: typer.echo(name, err=True))
    if as_json:
        print_json({"deviations": found})
        return
    head = ["law", "quantity", "E/Y", "depth [R]", "mean", "rms", "largest", "points"]
    print_table([head, *(_row(one) for one in found)])


def _row(one: "Deviation") -> list[str]:
    absolute = one.quantity == "alpha"
    numbers = [
        f"{x:+.3f}" if absolute else f"{100 * x:+.1f} %"
        for x in (one.mean, one.rms, one.largest)
    ]
    ratios, depths = (
        f"{low:g}" if low == high else f"{low:g} to {high:g}"
        for low, high in (one.ratios, one.depths)
    )
    return [one.law, one.quantity, ratios, depths, *numbers, str(one.points)]
