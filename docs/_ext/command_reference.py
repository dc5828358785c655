"""The commands of the command line, from the program itself."""

from collections.abc import Iterator
from typing import Any

from pieces import code, sentence, table


def page() -> str:
    """Return a section for every command."""
    import typer

    from pestle.cli.app import app

    group: Any = typer.main.get_command(app)
    parts = []
    for name, command in _commands(group):
        words = " ".join(word for word, _ in _arguments(command))
        parts.append(f"## {code(f'pestle {name} {words}'.rstrip())}\n")
        parts.append("\n\n".join(map(sentence, command.help.split("\n\n"))) + "\n")
        rows = [(code(word), text) for word, text in _arguments(command)]
        rows += list(_options(command))
        if rows:
            parts.append(table(("argument or option", "meaning"), rows))
    return "\n".join(parts)


def _commands(group: Any) -> Iterator[tuple[str, Any]]:
    """Commands and, behind the name of their group, those of groups."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from ((f"{name} {inner}", c) for inner, c in _commands(command))
        else:
            yield name, command


def _arguments(command: Any) -> Iterator[tuple[str, str]]:
    for parameter in command.params:
        if parameter.param_type_name == "argument":
            word = parameter.metavar or parameter.name.upper()
            yield word if parameter.required else f"[{word}]", sentence(parameter.help)


def _options(command: Any) -> Iterator[tuple[str, str]]:
    for parameter in command.params:
        if parameter.param_type_name != "argument" and "--help" not in parameter.opts:
            metavar = f" {parameter.metavar}" if parameter.metavar else ""
            words = ", ".join(parameter.opts) + metavar
            yield code(words), sentence(parameter.help or "")
