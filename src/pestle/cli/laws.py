"""pestle laws: which contact laws there are."""

import dataclasses
import inspect
from typing import Annotated, Any

import typer

from pestle.cli.options import AsJson

Name = Annotated[
    str | None, typer.Argument(help="Show one law in full.", show_default=False)
]


def laws(name: Name = None, as_json: AsJson = False) -> None:
    """List the contact laws and their options."""
    from pestle import laws as registry
    from pestle.cli.printing import print_json

    chosen = [registry.get(name)] if name else map(registry.get, registry.names())
    described = [_described(law) for law in chosen]
    if as_json:
        print_json(described)
        return
    for law in described:
        typer.echo(f"{law['name']}: {law['summary']}")
        for option in law["options"]:
            default = option["default"]
            shown = "required" if default is None else f"default {default}"
            typer.echo(f"    {option['name']}: {option['help']} ({shown})")
        if name:
            typer.echo(f"\n{law['text']}\n\n{law['citation']}")


def _described(law: Any) -> dict[str, Any]:
    module = inspect.getmodule(law)
    return {
        "name": law.name,
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
