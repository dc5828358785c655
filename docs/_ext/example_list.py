"""All case files in ``examples`` with the comment that each begins with."""

import tomllib
from itertools import takewhile
from pathlib import Path

from pieces import code, sentence, table

EXAMPLES = Path(__file__).parent.parent.parent / "examples"


def page() -> str:
    """Return a table of the examples."""
    rows = []
    for path in sorted(EXAMPLES.glob("*.toml")):
        text = path.read_text(encoding="utf-8")
        title = tomllib.loads(text).get("title", "")
        comment = takewhile(lambda line: line.startswith("#"), text.splitlines())
        words = [line.lstrip("# ") for line in comment]
        told = " ".join(line for line in words if not line.startswith("Try:"))
        rows.append((code(path.name), title, sentence(told)))
    return table(("file", "title", "what it is for"), rows)
