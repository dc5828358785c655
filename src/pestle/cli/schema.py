"""pestle schema: the JSON Schema of a case file, for editors."""

from pathlib import Path
from typing import Annotated

import typer


def schema(
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="FILE", help="Write to a file.", show_default=False
        ),
    ] = None,
) -> None:
    """Print the JSON Schema of a case file; editors complete and check with it."""
    import json

    from pestle.config.schema import case_schema
    from pestle.errors import InputError

    text = json.dumps(case_schema(), indent=2)
    if out is None:
        typer.echo(text)
        return
    try:
        out.write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise InputError("unwritable", f"{out}: {error.strerror}", "--out") from None
