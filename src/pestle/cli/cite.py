"""pestle cite: the references behind a case."""

import re
from importlib.resources import files
from typing import TYPE_CHECKING

import typer

from pestle.cli.options import CaseFile, Settings

if TYPE_CHECKING:
    from pestle.config import Case


def cite(case: CaseFile, settings: Settings = None) -> None:
    """Print BibTeX of the law, the materials and the methods that a case uses."""
    from pestle.config import Case

    loaded = Case.from_file(case, settings)
    typer.echo("\n\n".join(references(loaded)))


def references(case: "Case") -> list[str]:
    """BibTeX entries for a case, each once."""
    from pestle import __version__, materials

    texts = [getattr(case.law.build(), "citation", "")]
    sets = {entry.set for entry in case.materials.values() if entry.set}
    texts += [materials.load(name).citation for name in sorted(sets)]
    methods = (files("pestle.cli") / "methods.bib").read_text(encoding="utf-8")
    texts.append(methods.replace("{VERSION}", f"{{{__version__}}}"))
    unique: dict[str, str] = {}
    for text in texts:
        for entry in re.split(r"(?m)^(?=@)", text):
            key = re.match(r"@\w+\{\s*([^,\s]+)", entry)
            if key:
                unique.setdefault(key[1], entry.strip())
    return list(unique.values())
