"""BibTeX of what pestle builds on, from `references.bib` beside this file."""

import re
from functools import cache
from importlib.resources import files


@cache
def _entries() -> dict[str, str]:
    text = (files("pestle") / "references.bib").read_text(encoding="utf-8")
    return {key: entry for entry in split(text) for key in [key_of(entry)]}


def split(text: str) -> list[str]:
    """Entries of a BibTeX text."""
    return [part.strip() for part in re.split(r"(?m)^(?=@)", text) if part.strip()]


def key_of(entry: str) -> str:
    """Key of a BibTeX entry."""
    found = re.match(r"@\w+\{\s*([^,\s]+)", entry)
    return found[1] if found else ""


def cite(*keys: str) -> str:
    """BibTeX entries of some keys.

    Examples
    --------
    >>> print(cite("hertz1881").splitlines()[0])
    @article{hertz1881,
    """
    return "\n".join(_entries()[key] for key in keys)
