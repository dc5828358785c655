"""Arguments and options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

CaseFile = Annotated[
    Path, typer.Argument(metavar="CASE", help="Case file (TOML).", show_default=False)
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Replace a value of the case: --set law.psi_b=0.4; the end of the key is "
        "enough where only one has it. May be repeated.",
        show_default=False,
    ),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Threads = Annotated[
    int | None,
    typer.Option(
        "--threads",
        metavar="N",
        min=1,
        max=1024,
        help="Number of threads, by default one for few particles and otherwise all "
        "cores; the result does not depend on it.",
        show_default=False,
    ),
]
