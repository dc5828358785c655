"""Replace values of a case before it is validated: ``--set law.psi_b=0.4``."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args

from pydantic import BaseModel
from pydantic_core import PydanticCustomError

from pestle.config.contacts import ADHESION_ALIASES
from pestle.errors import InputError, nearest

Path = tuple[str | int, ...]

_ONE_OF = (
    ("to", "to_stress", "to_force", "to_displacement"),
    ("restitution", "damping_ratio"),
    ("stress", "force"),
    ("work_of_adhesion", *ADHESION_ALIASES),
    ("count", "mass", "file", "start_from"),
)
"""Keys of which a section holds one: setting it removes the others."""

_ANSWERS = ("step", "name", "material")
"""Keys whose value names an entry of an array, as in ``process.press.at``."""

_PLAIN = re.compile(r"[^\"'\[\]{}=#\n]+")


@dataclass(frozen=True, slots=True)
class _Place:
    """A key that can be set, and the words that each part of its path answers to."""

    path: Path
    words: tuple[frozenset[str], ...]
    is_in_file: bool

    def answers_to(self, parts: list[str]) -> bool:
        """Tell whether the path ends with these parts."""
        ends = self.words[len(self.words) - len(parts) :]
        return len(parts) <= len(self.words) and all(
            part in words for part, words in zip(parts, ends, strict=True)
        )

    @property
    def dotted(self) -> str:
        """Path as one writes it."""
        return ".".join(str(part) for part in self.path)


def apply(data: dict[str, Any], overrides: dict[str, Any] | list[str]) -> list[Path]:
    """Set values in the tables of a case file; return the paths that were set.

    Parameters
    ----------
    data : dict
        Tables as read from the file; changed in place.
    overrides : dict or list of str
        Values by dotted path, or texts such as ``"law.psi_b=0.4"``. The end of a path
        is enough where only one key has it. In [[process]] a step answers to its
        number, its name and its word, ``process.press.at``; in [[particles]] a powder
        to its number and its material.
    """
    pairs = (
        [(key, value) for key, value in overrides.items()]
        if isinstance(overrides, dict)
        else [parse(text) for text in overrides]
    )
    done = []
    for key, value in pairs:
        place = find(data, key)
        _put(data, place.path, value)
        done.append(place.path)
    return done


def parse(text: str) -> tuple[str, Any]:
    """Split ``key=value``; the value is TOML, or a text that needs no quotes.

    Examples
    --------
    >>> parse("particles.radius=150 um")
    ('particles.radius', '150 um')
    >>> parse("engine.gravity=[0, 0, 0]")
    ('engine.gravity', [0, 0, 0])
    """
    key, equals, raw = text.partition("=")
    key, raw = key.strip(), raw.strip()
    if not equals or not key or not raw:
        raise InputError(
            "bad-override",
            f'--set "{text[:80]}" is not key=value',
            "--set",
            "write it like --set law.psi_b=0.4",
        )
    try:
        parsed = tomllib.loads(f"value = {raw}")
        if parsed.keys() == {"value"}:
            return key, parsed["value"]
    except (ValueError, RecursionError):
        if _PLAIN.fullmatch(raw):
            return key, raw
    raise InputError(
        "bad-override",
        f'the value in --set "{text[:80]}" is not TOML',
        f"--set {key}",
        "numbers, true, false, [1, 2] or a text",
    )


def find(data: dict[str, Any], key: str) -> _Place:
    """Find the one place that a dotted path, or the end of one, means."""
    parts = [part.strip() for part in key.split(".")]
    if parts[-1] in ADHESION_ALIASES:
        parts[-1] = "work_of_adhesion"
    places = list(_places(data))
    matches = [place for place in places if place.answers_to(parts)]
    whole = [place for place in matches if len(place.path) == len(parts)]
    in_file = [place for place in matches if place.is_in_file]
    for candidates in (whole, in_file, matches):
        if len(candidates) == 1:
            return candidates[0]
        if candidates:
            raise InputError(
                "ambiguous-key",
                f'"{key}" means {len(candidates)} keys of this case',
                f"--set {key}",
                "one of " + ", ".join(place.dotted for place in candidates[:6]),
            )
    names = {place.dotted: place.dotted for place in places}
    names |= {str(place.path[-1]): place.dotted for place in places}
    close = nearest(key, names) or nearest(parts[-1], names)
    raise InputError(
        "unknown-key",
        f'"{key}" is no key of this case',
        f"--set {key}",
        f'did you mean "{names[close]}"?' if close else "see `pestle schema`",
    )


def _places(data: dict[str, Any]) -> Iterator[_Place]:
    from pestle.config.case import Case

    yield from _walk(Case, data, (), ())


def _walk(
    model: type[BaseModel], data: Any, path: Path, words: tuple[frozenset[str], ...]
) -> Iterator[_Place]:
    """All keys of a section and of the sections that stand in it."""
    table = data if isinstance(data, dict) else {}
    present = {("work_of_adhesion" if k in ADHESION_ALIASES else k) for k in table}
    keys = {field.alias or name: field for name, field in model.model_fields.items()}
    for key, field in keys.items():
        here, spelled = (*path, key), (*words, frozenset((key,)))
        yield _Place(here, spelled, key in present)
        if key == "to_stress":
            to = (*words, frozenset(("to",)))
            yield _Place((*path, "to"), to, "to" in present)
        if key == "law":
            for option in _law_options(table.get(key)):
                option_words = (*spelled, frozenset((option,)))
                is_given = isinstance(table.get(key), dict) and option in table[key]
                yield _Place((*here, option), option_words, is_given)
            continue
        sections = _sections(field.annotation)
        yield from _inside(sections, table.get(key), here, spelled)


def _inside(
    sections: list[type[BaseModel]],
    value: Any,
    path: Path,
    words: tuple[frozenset[str], ...],
) -> Iterator[_Place]:
    if not sections:
        return
    if isinstance(value, list):
        for number, item in enumerate(value):
            names = {str(number)}
            if isinstance(item, dict):
                names |= {str(item[k]) for k in _ANSWERS if k in item}
            chosen = _chosen(sections, item)
            spelled = (*words, frozenset(names))
            yield from _walk(chosen, item, (*path, number), spelled)
    elif path in (("materials",), ("walls",)):
        for name, item in (value if isinstance(value, dict) else {}).items():
            chosen = _chosen(sections, item)
            spelled = (*words, frozenset((name,)))
            yield from _walk(chosen, item, (*path, name), spelled)
    elif isinstance(value, dict) or path in (("engine",), ("output",), ("contacts",)):
        yield from _walk(sections[0], value, path, words)


def _sections(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [found for part in get_args(annotation) for found in _sections(part)]


def _chosen(sections: list[type[BaseModel]], item: Any) -> type[BaseModel]:
    """Section that the item's own step or kind names."""
    tag = item.get("step", item.get("kind")) if isinstance(item, dict) else None
    for section in sections:
        for key in ("step", "kind"):
            field = section.model_fields.get(key)
            if field is not None and field.default == tag:
                return section
    return sections[0]


def _law_options(law: Any) -> list[str]:
    from pestle.config.law import law_class, option_fields

    name: Any = law.get("name") if isinstance(law, dict) else law
    try:
        return ["name", *option_fields(law_class(name))]
    except (PydanticCustomError, TypeError, AttributeError):
        return ["name"]


def _put(data: dict[str, Any], path: Path, value: Any) -> None:
    table: Any = data
    for part in path[:-1]:
        if isinstance(table, dict):
            if not isinstance(table.get(part), dict | list):
                table[part] = {"name": table[part]} if part in table else {}
            table = table[part]
        else:
            table = table[part]
    last = path[-1]
    for group in _ONE_OF:
        if last in group:
            for other in group:
                table.pop(other, None)
    if last in ("file", "start_from"):
        table.pop("radius", None)
    table[last] = value
