"""Write the pages that come from the source before Sphinx reads the others.

They go to ``_generated`` and are included by the pages in ``reference``; so a key, an
error or a column that changes in the source changes here with the next build.
"""

from pathlib import Path
from typing import Any

import case_reference
import command_reference
import error_ids
import example_list
import law_cards
import metric_reference
import reproduced
import result_columns
from sphinx.application import Sphinx

PAGES = {
    "case-file.md": case_reference.page,
    "commands.md": command_reference.page,
    "errors.md": error_ids.page,
    "examples.md": example_list.page,
    "laws.md": law_cards.overview,
    "metrics.md": metric_reference.page,
    "particles.md": result_columns.particles,
    "contacts.md": result_columns.contacts,
    "meshes.md": result_columns.meshes,
    "reproduced.md": reproduced.page,
}


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the pages when the builder is ready."""
    app.connect("builder-inited", lambda app: write(Path(app.srcdir) / "_generated"))
    app.connect(
        "builder-inited",
        lambda app: law_cards.write(Path(app.srcdir) / "laws" / "cards"),
        priority=400,  # before the pages are looked for
    )
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def write(folder: Path) -> None:
    """Write every page whose text has changed."""
    folder.mkdir(exist_ok=True)
    for name, page in PAGES.items():
        path, text = folder / name, page()
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
