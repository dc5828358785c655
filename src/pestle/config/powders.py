"""What the particles of a case are made of, and what they are read from."""

import hashlib
import json
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic_core import PydanticCustomError

from pestle.config.checks import check_powder
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.config.case import Case
    from pestle.config.particle_file import ParticleTable

CHECKPOINT = "checkpoint.npz"
"""File of a run that holds its last state."""

_LARGEST_RECORD = 50_000_000  # [bytes]


def powder_names(case: "Case") -> tuple[str, ...]:
    """Names of the particles' materials, each once, in the order of their numbers."""
    given = tuple(dict.fromkeys(g.material for g in case.particles if g.material))
    if given:
        return given
    if case.particles[0].file is not None:
        return case.read_particles().materials
    assert case.particles[0].start_from is not None
    names = names_of_run(case.resolve(case.particles[0].start_from))
    for name in names:
        _check(case, name, "particles.start_from")
    return names


def particle_table(case: "Case") -> "ParticleTable":
    """Read and check the particle file of a case."""
    from pestle.config.particle_file import check_inside, read_particles

    group = case.particles[0]
    if group.file is None:
        raise InputError("no-particle-file", "the case reads no particles")
    path = case.resolve(group.file)
    table = read_particles(path, case.materials)
    if bool(group.material) == bool(table.materials):
        what = "both in the file and in the case" if group.material else "nowhere"
        raise InputError(
            "contradiction" if group.material else "missing-key",
            f"the material of the particles is given {what}",
            f"{path}:1",
            "keep the column material, or particles.material for all of them",
        )
    for name in table.materials:
        _check(case, name, str(path))
    check_inside(table, case.all_walls, path)
    return table


def names_of_run(folder: Path) -> tuple[str, ...]:
    """Names of the particles' materials in an earlier run."""
    from pestle.config.file import read_text

    path = folder / "provenance.json"
    try:
        names = json.loads(read_text(path, _LARGEST_RECORD))["particle_materials"]
    except (ValueError, RecursionError, KeyError, TypeError):
        names = None
    if not isinstance(names, list) or not all(isinstance(n, str) for n in names):
        raise InputError(
            "provenance-damaged",
            f"{path.name} does not name the materials of the particles",
            str(path),
            'give it in the case: material = "powder"',
        )
    return tuple(names)


def content_hash(case: "Case") -> dict[str, str]:
    """SHA-256 of what the particles are read from, by the key that names it."""
    found = {}
    for key, inside in (("file", ""), ("start_from", CHECKPOINT)):
        name = getattr(case.particles[0], key)
        if name is not None:
            path = case.resolve(name) / inside
            try:
                with path.open("rb") as file:
                    found[key] = hashlib.file_digest(file, "sha256").hexdigest()
            except OSError as error:
                what = f"{path} cannot be read: {error.strerror}"
                raise InputError("unreadable", what, f"particles.{key}") from None
    return found


def _check(case: "Case", name: str, where: str) -> None:
    try:
        check_powder(case, name, ())
    except PydanticCustomError as error:
        context = error.context or {}
        hint = context.get("hint")
        raise InputError(context["id"], context["what"], where, hint) from None
