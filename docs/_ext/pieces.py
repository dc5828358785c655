"""Pieces of Markdown that the generated pages share."""

import re
from collections.abc import Iterable, Sequence


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table; line ends and bars in its cells are made harmless."""
    lines = [_row(header), "|" + "---|" * len(header)]
    return "\n".join([*lines, *map(_row, rows)]) + "\n"


def _row(cells: Sequence[str]) -> str:
    clean = (re.sub(r"[ \t\n]+", " ", cell).replace("|", "\\|") for cell in cells)
    return "| " + " | ".join(cell.strip(" ") for cell in clean) + " |"


def code(text: object) -> str:
    """Return a text as code."""
    return f"`{text}`"


def sentence(text: str) -> str:
    """Begin with a capital letter and end with a full stop."""
    clean = " ".join(text.split())
    if not clean:
        return ""
    return clean[0].upper() + clean[1:] + ("" if clean[-1] in ".:!?" else ".")
