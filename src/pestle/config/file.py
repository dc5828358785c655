"""Read a case file: bytes to text, text to tables, tables to a `Case`."""

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from pestle.config.locate import Path as Path_
from pestle.config.powders import CHECKPOINT
from pestle.config.translate import Origin, translated
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.config.case import Case

LARGEST_CASE = 4_000_000
"""Largest case file [bytes]."""

_DEEPEST = 12


def read_case(
    model: type["Case"], path: Path, overrides: dict[str, Any] | list[str] | None
) -> "Case":
    """Read and validate a case file; see `Case.from_file`."""
    text = read_text(path, LARGEST_CASE)
    data = parse_toml(text, path)
    changed: list[Path_] = []
    if overrides:
        from pestle.config.overrides import apply

        changed = apply(data, overrides)
    origin = Origin(text, str(path), tuple(changed))
    try:
        case = model.model_validate(data)
    except ValidationError as error:
        raise translated(error, model, origin) from None
    case._source = path
    _check_files(case, origin)
    return case


def _check_files(case: "Case", origin: Origin) -> None:
    """Read what the case names, so that a bad file is found before the run."""
    first = case.particles[0]
    if first.file is not None:
        case.read_particles()
    if first.start_from is not None:
        folder = case.resolve(first.start_from)
        if not (folder / CHECKPOINT).is_file():
            raise InputError(
                "no-such-run",
                f'start_from = "{first.start_from}": there is no run in {folder} '
                f"(no {CHECKPOINT})",
                origin.place(("particles", "start_from")),
                "the path is relative to the case file",
            )
        _ = case.powders
    for name, wall in case.walls.items():
        if wall.kind == "mesh":
            case.surface(name)


def read_text(path: Path, largest: int) -> str:
    """Read a text file of at most `largest` bytes."""
    try:
        if path.is_dir():
            raise InputError(
                "not-a-file", f"{path} is a directory", hint="name the file in it"
            )
        if not path.exists():
            raise InputError(
                "no-such-file", f"{path} does not exist", hint=_beside(path)
            )
        if not path.is_file():
            raise InputError("not-a-file", f"{path} is not a regular file")
        size = path.stat().st_size
        if size > largest:
            what = f"{path} has {size / 1e6:.1f} MB, more than {largest / 1e6:.0f} MB"
            raise InputError("file-too-large", what)
        data = path.read_bytes()
    except (OSError, ValueError) as error:  # ValueError: a null byte in the name
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError("unreadable", f"{path} cannot be read: {reason}") from None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        what = f"{path} is not a text file (byte {error.start} is not UTF-8)"
        raise InputError("not-text", what, str(path)) from None
    return text


def parse_toml(text: str, path: Path) -> dict[str, Any]:
    """Parse TOML, with the place of a mistake in the error."""
    try:
        data = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        reason = str(error) or "unreadable"
        if isinstance(error, RecursionError):
            reason = "nested too deeply"
        line = reason.rpartition("at line ")[2].partition(",")[0]
        where = f"{path}:{line}" if line.isdecimal() else str(path)
        is_bare = "newline" in reason or "Invalid value" in reason
        hint = 'a text or quantity stands in quotes: radius = "150 um"'
        what = f"the file is not TOML: {reason}"
        raise InputError("not-toml", what, where, hint if is_bare else None) from None
    if _depth(data, _DEEPEST) > _DEEPEST:
        raise InputError("not-toml", "tables are nested too deeply", str(path))
    return data


def _depth(data: Any, limit: int) -> int:
    children = (
        data.values()
        if isinstance(data, dict)
        else data
        if isinstance(data, list)
        else ()
    )
    if limit < 0:
        return 1
    return 1 + max((_depth(child, limit - 1) for child in children), default=0)


def _beside(path: Path) -> str | None:
    """Nearest file name in the same directory."""
    from pestle.errors import nearest

    try:
        names = [entry.name for entry in path.parent.glob("*.toml")]
    except OSError:
        return None
    match = nearest(path.name, names)
    return f'did you mean "{path.parent / match}"?' if match else None
