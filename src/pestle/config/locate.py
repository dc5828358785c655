"""Find the line of a key in a TOML text, for error messages."""

import re

Path = tuple[str | int, ...]

_HEADER = re.compile(r"\s*(\[\[?)([^\[\]]+)\]\]?\s*(?:#.*)?$")
_KEY = re.compile(
    r"""\s*((?:[\w-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[\w-]+|"[^"]*"))*)\s*="""
)
_BRACKETS = {"[": 1, "{": 1, "]": -1, "}": -1}
_STRING = re.compile(r""""(?:\\.|[^"\\])*"|'[^']*'|#.*""")


def line_of(text: str, path: Path) -> int | None:
    r"""Return the line [-] of the longest known part of a path, from 1.

    Examples
    --------
    >>> text = 'seed = 1\n[die]\nradius = "1 mm"\n[[process]]\nstep = "fill"\n'
    >>> line_of(text, ("die", "radius")), line_of(text, ("process", 0, "at"))
    (3, 4)
    """
    lines = _lines(text)
    for length in range(len(path), 0, -1):
        if path[:length] in lines:
            return lines[path[:length]]
    return None


def _lines(text: str) -> dict[Path, int]:
    """Line of every table header and key; values are skipped, not read."""
    found: dict[Path, int] = {}
    table: Path = ()
    counts: dict[tuple[str | int, ...], int] = {}
    depth = 0
    for number, line in enumerate(text.splitlines(), start=1):
        bare = _STRING.sub("", line)
        header = _HEADER.match(line) if depth == 0 else None
        if header:
            table = _table(header, counts)
            found.setdefault(table, number)
            if header[1] == "[[":
                found.setdefault(table[:-1], number)  # the whole array
            continue
        key = _KEY.match(line) if depth == 0 else None
        if key:
            found.setdefault((*table, *_parts(key[1])), number)
        depth += sum(_BRACKETS.get(character, 0) for character in bare)
    return found


def _table(header: re.Match[str], counts: dict[Path, int]) -> Path:
    """Path of a table header; repeated tables are numbered."""
    *parents, last = _parts(header[2])
    path: Path = ()
    for name in parents:
        path = (*path, name)
        if path in counts:
            path = (*path, counts[path])
    path = (*path, last)
    if header[1] == "[[":
        counts[path] = counts.get(path, -1) + 1
        path = (*path, counts[path])
    return path


def _parts(dotted: str) -> list[str]:
    return [part.strip().strip("\"'") for part in dotted.split(".")]
