"""pestle cite: the references behind a case."""

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
    from pestle import __version__, citations, materials

    texts = [getattr(case.law.build(), "citation", "")]
    sets = {entry.set for entry in case.materials.values() if entry.set}
    texts += [materials.load(name).citation for name in sorted(sets)]
    methods = citations.cite("pestle", "cundall1979", "mindlin1953")
    texts.append(methods.replace("{VERSION}", f"{{{__version__}}}"))
    unique: dict[str, str] = {}
    for entry in citations.split("\n".join(texts)):
        unique.setdefault(citations.key_of(entry), entry)
    return list(unique.values())
