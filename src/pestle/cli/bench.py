"""pestle bench: what a law does, before a simulation is made with it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pestle.cli.quantities import pair, quantity
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.bench.setup import Parameter
    from pestle.bench.subject import Subject

Laws = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="LAW...",
        help="Law of a pair (hertz) or of a particle, with a law of unloading behind a "
        "plus (shahin2021+edmans2020). Without one: list them.",
        show_default=False,
    ),
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help='Parameter of the laws: --set "yield_stress=20 MPa". May be repeated; '
        "LAW:KEY=VALUE is for one law only.",
        show_default=False,
    ),
]


def bench(
    context: typer.Context,
    law: Laws = None,
    settings: Settings = None,
    material: Annotated[
        str,
        typer.Option(help="Packaged set with what --set does not give, or none."),
    ] = "avicel_ph102_zunker2025",
    radius: Annotated[str, typer.Option(help="Radius of the particle.")] = "50 um",
    against: Annotated[
        str, typer.Option(help="Pair laws: a rigid wall, or a like particle.")
    ] = "wall",
    configuration: Annotated[
        str, typer.Option(help="Particle: simple, die or hydrostatic.")
    ] = "simple",
    flats: Annotated[
        str | None,
        typer.Option(
            metavar="1,F,F,...",
            help="zunker2024: any set of flats instead; how far each moves over the "
            "path, the first 1: 1,0,0 is one that moves and two that stand.",
            show_default=False,
        ),
    ] = None,
    path: Annotated[
        str,
        typer.Option(
            help="Waypoints, separated by commas: a number is a displacement over the "
            "radius, a length a displacement, a force is pressed until it is reached."
        ),
    ] = "0.1, 0",
    cycles: Annotated[int, typer.Option(min=1, help="Repeat the path.")] = 1,
    points: Annotated[int, typer.Option(min=2, help="Points a leg.")] = 500,
    impact: Annotated[
        str | None,
        typer.Option(
            metavar="V1,V2",
            help="Impacts between two velocities instead of the path.",
            show_default=False,
        ),
    ] = None,
    angle: Annotated[
        float, typer.Option(min=0.0, max=89.9, help="Impact angle [degree].")
    ] = 0.0,
    friction: Annotated[
        float, typer.Option(min=0.0, help="Coulomb's coefficient of oblique impacts.")
    ] = 0.3,
    damping: Annotated[
        float, typer.Option(min=0.0, help="Damping ratio of impacts, the engine's.")
    ] = 0.0,
    compare: Annotated[
        bool, typer.Option("--compare", help="Several laws in one table and figure.")
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Table: .csv, .parquet or .nc by suffix.", show_default=False
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(help="Figure: .svg, .png or .pdf.", show_default=False),
    ] = None,
    show_help: Annotated[
        bool, typer.Option("--help", "-h", help="Show this, and a law's parameters.")
    ] = False,
) -> None:
    """Drive one contact or one particle, or let it hit a wall, and show the curves."""
    if show_help or not law:
        _print_help(context, law or [], whole=show_help)
        return
    if len(law) > 1 and not compare:
        raise InputError(
            "several-laws", f"{len(law)} laws at once", "LAW", "add --compare"
        )
    from pestle.cli import bench_run

    with bench_run.plain_warnings():
        subjects = _subjects(
            law,
            settings or [],
            material,
            radius=quantity(radius, "m", "--radius"),
            against=against,
            configuration=configuration,
            flats=_flats(flats),
        )
        if impact is None:
            bench_run.drive_all(
                subjects,
                bench_run.waypoints(path, subjects) * cycles,
                points=points,
                files=(out, figure),
            )
        else:
            bench_run.impact_all(
                subjects,
                bench_run.velocities(impact),
                oblique=(angle, friction, damping),
                files=(out, figure),
            )


def _print_help(context: typer.Context, names: list[str], *, whole: bool) -> None:
    """Show the options, and laws in full or all of them in a line each."""
    from pestle.bench import setup
    from pestle.cli.printing import print_table

    if whole:
        text = context.get_help()
        if text:
            typer.echo(text)
    for name in names:
        for law in setup.parts_of(name):
            typer.echo(f"{law.name}: {law.summary}")
            valid = getattr(law, "validity", "")
            if valid:
                typer.echo(f"  valid: {valid}")
            typer.echo(f"  {law.citation}")
        typer.echo("parameters:")
        print_table(_row(key, each) for key, each in setup.parameters(name).items())
    if not names:
        for title, laws in setup.everything().items():
            typer.echo(f"{title}:")
            print_table([(f"  {law.name}", law.summary) for law in laws])
        typer.echo("`pestle bench LAW --help` explains a law and its parameters")


def _row(key: str, each: "Parameter") -> tuple[str, ...]:
    unit = "" if each.unit == "1" else f"[{each.unit}]"
    default = "required" if each.required else f"default {each.default}"
    if each.default is None and not each.required:
        default = "optional"
    choices = f" ({', '.join(each.choices)})" if each.choices else ""
    return f"  {key}", unit, default, each.text + choices


def _subjects(
    names: list[str],
    settings: list[str],
    material: str,
    *,
    radius: float,
    against: str,
    configuration: str,
    flats: tuple[float, ...],
) -> dict[str, "Subject"]:
    from pestle.bench import setup
    from pestle.errors import did_you_mean

    if against not in ("wall", "particle"):
        raise InputError(
            "unknown-choice",
            f"--against cannot be {against!r}",
            "--against",
            did_you_mean(against, ("wall", "particle")),
        )
    given = [_split(text) for text in settings]
    known = {name: setup.parameters(name) for name in names}
    _check_keys(given, known)
    packaged = _packaged(material)
    subjects: dict[str, Subject] = {}
    for name in names:
        values: dict[str, Any] = {
            key: value for key, value in packaged.items() if key in known[name]
        }
        for law, key, text in given:
            if law in ("", name) and key in known[name]:
                values[key] = _value(text, known[name][key], key)
        subjects[name] = setup.subject(
            name,
            values,
            radius=radius,
            configuration=configuration,
            other_radius=0.0 if against == "wall" else radius,
            flats=flats,
        )
    return subjects


def _flats(text: str | None) -> tuple[float, ...]:
    """Read a set of flats such as "1,0,0"."""
    if text is None:
        return ()
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise InputError(
            "not-a-number",
            f"{text!r} is not a list of numbers",
            "--flats",
            "how far each flat moves over the path, such as 1,0,0",
        ) from None


def _packaged(name: str) -> dict[str, float]:
    if name == "none":
        return {}
    from pestle import materials

    loaded = materials.load(name)
    return {**loaded.constants(), **loaded.contacts}


def _split(text: str) -> tuple[str, str, str]:
    """Law or nothing, key and value of a setting."""
    key, value = pair(text, "--set")
    law, _, last = key.rpartition(":")
    return law, last, value


def _check_keys(
    given: list[tuple[str, str, str]], known: dict[str, dict[str, "Parameter"]]
) -> None:
    """A key must mean something to at least one law."""
    from pestle.errors import did_you_mean

    for law, key, _ in given:
        if law and law not in known:
            raise InputError(
                "unknown-law",
                f"{law} is not on the bench",
                "--set",
                did_you_mean(law, known),
            )
        options = {k for name in known if law in ("", name) for k in known[name]}
        if key not in options:
            raise InputError(
                "unknown-law-parameter",
                f"no law on the bench has a parameter {key!r}",
                "--set",
                did_you_mean(key, options),
            )


def _value(text: str, each: "Parameter", key: str) -> Any:
    if each.choices or each.kind is str:
        return text
    if each.kind is bool:
        if text not in ("true", "false"):
            what = f"{key} is true or false, not {text!r}"
            raise InputError("wrong-type", what, "--set")
        return text == "true"
    return quantity(text, each.unit, f"--set {key}")
