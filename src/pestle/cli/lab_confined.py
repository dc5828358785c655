"""pestle lab confined: one sphere in a die or under hydrostatic compression."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from pestle.cli.lab_options import (
    SecondOpinion,
    second_opinion,
    show_second_opinion,
)
from pestle.cli.options import AsJson

if TYPE_CHECKING:
    from pestle.lab.confined import ConfinedPoint, Flat


def confined(
    configuration: Annotated[
        str, typer.Argument(metavar="KIND", help="die, hydrostatic or simple.")
    ],
    modulus_ratio: Annotated[
        float, typer.Option(help="Young's modulus over yield stress, E/Y.")
    ],
    poisson: Annotated[float, typer.Option(help="Poisson ratio.")] = 0.3,
    to: Annotated[
        float, typer.Option(help="Displacement of the moving flats, in radii.")
    ] = 0.15,
    hardening_exponent: Annotated[
        float, typer.Option(help="n of the flow stress Y (1 + strain/reference)^n.")
    ] = 0.0,
    reference_strain: Annotated[
        float | None,
        typer.Option(
            help="Reference strain of that law, by default Y/E.", show_default=False
        ),
    ] = None,
    edges: Annotated[
        int,
        typer.Option(min=3, max=16, help="Edges from a pole to the diagonal: 6 or 8."),
    ] = 6,
    ask_calculix: SecondOpinion = False,
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Press one sphere between six flats, in three dimensions on an octant.

    In a die two flats move and four stand (secondary contacts); hydrostatically all
    move. The numbers are in radii and E R^2.
    """
    from pestle.lab.confined import Confined, ConfinedStop
    from pestle.lab.material import Hardening, Material

    hardening = Hardening(hardening_exponent, reference_strain)
    material = Material(modulus_ratio, poisson, hardening)
    sphere = Confined(material, configuration, edges=edges, layers=edges)
    stopped = None
    try:
        points = sphere.load(to, None if quiet else _line)
    except ConfinedStop as stop:
        points, stopped = stop.points, stop
    other = None
    if ask_calculix and points:
        from pestle.lab.second_opinion import of_confined

        other = second_opinion(lambda: of_confined(sphere, points))
    _show(points, other, as_json=as_json)
    if stopped is not None:
        raise stopped


def _line(point: "ConfinedPoint") -> None:
    typer.echo(f"depth {point.depth:.4g} R", err=True)


def _show(
    points: "list[ConfinedPoint]", other: dict[str, Any] | None, *, as_json: bool
) -> None:
    import json

    from pestle.cli.printing import print_table

    rows = [
        {
            "d_R": point.depth,
            **_flat("primary", point.primary),
            **_flat("secondary", point.secondary),
        }
        for point in points
    ]
    if as_json:
        asked = {} if other is None else {"second_opinion": other}
        typer.echo(json.dumps({"steps": rows} | asked))
        return
    if rows:
        shown = [[f"{value:.4g}" for value in row.values()] for row in rows]
        print_table([list(rows[0]), *shown])
    show_second_opinion(other or {})


def _flat(name: str, flat: "Flat") -> dict[str, Any]:
    from math import pi

    return {
        f"{name}_F_ER2": flat.force,
        f"{name}_A_piR2": flat.area / pi,
        f"{name}_A_in": flat.inner_area / pi,
        f"{name}_A_out": flat.outer_area / pi,
    }
