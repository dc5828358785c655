"""What the commands of the lab share: lists of numbers, meshes, progress."""

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.lab.mesh import Fineness
    from pestle.lab.press import Progress

SecondOpinion = Annotated[
    bool,
    typer.Option(
        "--second-opinion",
        help="Press it by CalculiX too and compare; skipped where ccx is not "
        "installed.",
    ),
]

SECONDS_BETWEEN_LINES = 5.0
"""Time between two lines of progress [s]."""


class ProgressLines:
    """A line of progress every few seconds."""

    def __init__(self) -> None:
        self._last = time.monotonic()

    def __call__(self, now: "Progress") -> None:
        """Print a line if it is time for one."""
        clock = time.monotonic()
        if clock - self._last > SECONDS_BETWEEN_LINES:
            self._last = clock
            words = f"{now.what}: depth {now.depth:.4g} of {now.end:g} R"
            typer.echo(f"{words}, {now.steps} steps", err=True)


def numbers_of(text: str, option: str, separator: str = ",") -> list[float]:
    """Read numbers with a separator between them."""
    try:
        return [float(word) for word in text.split(separator) if word.strip()]
    except ValueError:
        raise InputError(
            "not-a-list-of-numbers",
            f"{text!r} is not a list of numbers",
            option,
            "numbers separated by commas, such as 0.1,0.3,0.5",
        ) from None


def depths_of(text: str) -> list[float]:
    """Read depths [R], each once, sorted."""
    depths = numbers_of(text, "--unload")
    if len(set(depths)) < len(depths):
        raise InputError(
            "depth-twice", f"{text!r} names a depth twice", "--unload", "name it once"
        )
    return sorted(depths)


def mesh_of(text: str) -> "str | Fineness":
    """Read the name of a mesh, or a name and a factor on its edges."""
    from pestle.lab.mesh import named, scaled

    name, star, factor = text.partition("*")
    named(name)
    if not star:
        return name
    (number,) = numbers_of(factor, "--mesh") or [0.0]
    return scaled(name, number)


def second_opinion(ask: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Ask CalculiX; without it say so and go on."""
    from pestle.lab import calculix

    if not calculix.available():
        told = f"CalculiX is not installed ({calculix.INSTALL})"
        typer.echo(f"second opinion skipped: {told}", err=True)
        return {"skipped": told}
    return ask()


def show_second_opinion(numbers: dict[str, Any]) -> None:
    """Print what CalculiX found beside the lab's numbers."""
    from pestle.cli.printing import print_table

    rows = []
    for where, row in numbers.get("comparison", {}).items():
        for name, (lab, other) in row.items():
            off = f"{100.0 * (other / lab - 1.0):+.2f} %" if lab else ""
            rows.append([where, name, f"{lab:.5g}", f"{other:.5g}", off])
    if rows:
        typer.echo("")
        print_table([["", "", "lab", "CalculiX", "difference"], *rows])
    if numbers.get("stopped"):
        typer.echo(f"CalculiX stopped {numbers['stopped']}")
