"""pestle laws: which contact laws there are."""

import dataclasses
import inspect
from typing import Annotated, Any

import typer

from pestle.cli.options import AsJson

Name = Annotated[
    str | None, typer.Argument(help="Show one law in full.", show_default=False)
]

KINDS = {
    "pair": "laws of a pair, for runs",
    "loading": "laws of one particle between flats, pressed",
    "unloading": "laws of one particle between flats, released; behind a plus",
}


def laws(name: Name = None, as_json: AsJson = False) -> None:
    """List all contact laws, of pairs and of single particles; one law in full."""
    from pestle.cli.printing import print_json, print_table

    described = [_described(kind, law) for kind, law in _chosen(name)]
    if as_json:
        print_json(described)
    elif name:
        for law in described:
            _print_whole(law)
    else:
        for kind, title in KINDS.items():
            typer.echo(f"{title}:")
            rows = [law for law in described if law["kind"] == kind]
            print_table([(f"  {law['name']}", law["summary"]) for law in rows])
        typer.echo("`pestle laws NAME` shows one in full; `pestle bench NAME` tries it")


def _chosen(name: str | None) -> list[tuple[str, Any]]:
    """Kind and class of all laws, or of those that have a name."""
    from pestle import laws as pairs
    from pestle.errors import InputError, did_you_mean
    from pestle.particle.law import LOADING, UNLOADING

    every: list[tuple[str, Any]]
    every = [("pair", pairs.get(each)) for each in pairs.names()]
    every += [("loading", LOADING[each]) for each in sorted(LOADING)]
    every += [("unloading", UNLOADING[each]) for each in sorted(UNLOADING)]
    if name is None:
        return every
    known = {law.name for _, law in every}
    try:
        found: Any = None if name in known else pairs.get(name)  # by an alias
    except InputError:
        raise InputError(
            "unknown-law",
            f"there is no contact law {name!r}",
            hint=did_you_mean(name, known),
        ) from None
    wanted = found.name if found else name
    return [(kind, law) for kind, law in every if law.name == wanted]


def _print_whole(law: dict[str, Any]) -> None:
    typer.echo(f"{law['name']}: {law['summary']} ({law['kind']})")
    for option in law["options"]:
        default = option["default"]
        shown = "required" if default is None else f"default {default}"
        typer.echo(f"    {option['name']}: {option['help']} ({shown})")
    typer.echo(f"\n{law['text']}\n\n{law['citation']}\n")


def _described(kind: str, law: Any) -> dict[str, Any]:
    module = inspect.getmodule(law)
    return {
        "name": law.name,
        "kind": kind,
        "summary": getattr(law, "summary", inspect.getdoc(law) or "").split("\n")[0],
        "options": [_option(field) for field in dataclasses.fields(law)],
        "text": inspect.cleandoc((module and module.__doc__) or law.__doc__ or ""),
        "citation": getattr(law, "citation", ""),
    }


def _option(field: "dataclasses.Field[Any]") -> dict[str, Any]:
    words = field.metadata.get("help", "")
    choices = field.metadata.get("choices")
    if choices:
        words = f"{words}: {' or '.join(map(str, choices))}".lstrip(": ")
    missing = field.default is dataclasses.MISSING
    default = None if missing else field.default
    return {"name": field.name, "help": words, "default": default}
