"""pestle lab compare: laws of a particle against the finite elements."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pestle.cli.options import AsJson
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.lab.compare import Comparison
    from pestle.lab.press import Result


def compare(
    law: Annotated[
        list[str],
        typer.Argument(
            metavar="LAW...",
            help="Law of a particle (zunker2024), with a law of unloading behind a "
            "plus (shahin2021+edmans2020) or a parameter set that `pestle lab study "
            "edmans2020` wrote (shahin2021+mine.toml).",
        ),
    ],
    modulus_ratio: Annotated[
        float, typer.Option(help="Young's modulus over yield stress, E/Y.")
    ] = 200.0,
    poisson: Annotated[float, typer.Option(help="Poisson ratio.")] = 0.3,
    to: Annotated[
        float, typer.Option(help="Largest depth of the flat, in radii.")
    ] = 0.5,
    unload: Annotated[
        str,
        typer.Option(metavar="D1,D2,...", help="Depths to unload from, in radii."),
    ] = "0.1,0.3,0.5",
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="KEY=NUMBER",
            help="Another parameter of the laws, lengths in radii, stresses in moduli. "
            "May be repeated.",
            show_default=False,
        ),
    ] = None,
    mesh: Annotated[
        str, typer.Option(help="coarse, medium or fine, and a factor: coarse*0.8.")
    ] = "coarse",
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Folder for figure and table.", show_default=False
        ),
    ] = None,
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Compare laws of a particle with the lab: one figure and a table of errors.

    Curves are compared beyond 0.01 R. The lab's own force has a staircase of 1-2 %.
    """
    from pestle.cli.lab_options import ProgressLines, depths_of, mesh_of
    from pestle.lab.compare import compare as against
    from pestle.lab.compare import make_law, rows
    from pestle.lab.material import Material
    from pestle.lab.press import press

    parameters = dict(_setting(text) for text in settings or ())
    depths = depths_of(unload)
    material = Material(modulus_ratio, poisson)
    for name in law:
        make_law(name, material, parameters)
    report = None if quiet else ProgressLines()
    result = press(material, to, depths, mesh=mesh_of(mesh), progress=report)
    if result.stopped is not None:
        raise result.stopped
    found = [against(name, result, parameters) for name in law]
    table = rows(found, result)
    if out is not None:
        _write(out, found, result, table)
    _show(found, table, as_json=as_json)


def _setting(text: str) -> tuple[str, float]:
    key, _, value = text.partition("=")
    try:
        return key.strip(), float(value)
    except ValueError:
        raise InputError(
            "setting-without-number",
            f"{text!r} gives no number",
            "--set",
            "KEY=NUMBER; stresses are in moduli, lengths in radii",
        ) from None


def _write(
    out: Path,
    found: "list[Comparison]",
    result: "Result",
    table: list[dict[str, Any]],
) -> None:
    import csv

    from pestle.lab.figure import draw

    out.mkdir(parents=True, exist_ok=True)
    draw(found, result).savefig(out / "compare.svg")
    with (out / "compare.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(table[0]))
        writer.writeheader()
        writer.writerows(table)


def _show(
    found: "list[Comparison]", table: list[dict[str, Any]], *, as_json: bool
) -> None:
    from pestle.cli.printing import print_json, print_table

    if as_json:
        notes = {one.law: one.notes for one in found}
        print_json({"errors_of_laws": table, "notes": notes})
        return
    lines = [["law", "quantity", "mean", "rms", "largest", "points"]]
    for row in table:
        numbers = [row[key] for key in ("mean", "rms", "largest")]
        absolute = row["quantity"] == "alpha"
        shown = [f"{x:+.3f}" if absolute else f"{100 * x:+.1f} %" for x in numbers]
        lines.append([row["law"], row["quantity"], *shown, str(row["points"])])
    print_table(lines)
    for one in found:
        for note in one.notes:
            typer.echo(f"note: {note}")
