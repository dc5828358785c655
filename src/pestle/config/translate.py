"""From pydantic's errors to ours: the key, the value, the reason and a hint."""

from dataclasses import dataclass
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from pestle.config.locate import Path, line_of
from pestle.config.process import STEPS
from pestle.errors import InputError, did_you_mean
from pestle.units import shown

_UNION_NOISE = ("constrained-", "function-", "literal[", "tuple[")
_MOST = 8


@dataclass(frozen=True, slots=True)
class Origin:
    """Where the values of a case come from.

    Parameters
    ----------
    text, source : str
        The case file and its name.
    changed : tuple of paths
        Keys that were set from outside the file.
    """

    text: str
    source: str
    changed: tuple[Path, ...] = ()

    def place(self, path: Path) -> str:
        """Name the place of a key: file and line, or the option that set it."""
        dotted = ".".join(str(part) for part in path)
        if any(path[: len(key)] == key for key in self.changed):
            return f"--set {dotted}"
        line = line_of(self.text, path)
        return f"{self.source}:{line}  {dotted}" if line else f"{self.source}  {dotted}"


def translated(
    error: ValidationError, model: type[BaseModel], origin: Origin | None = None
) -> InputError:
    """Translate what pydantic found into one `InputError`, the others attached.

    Parameters
    ----------
    error : ValidationError
        What pydantic raised.
    model : type
        The section that was validated.
    origin : Origin, optional
        The case file, to point to lines.
    """
    errors: dict[Path, InputError] = {}
    for details in error.errors(include_url=False):
        if details["type"] == "too_short" and details["input"] and errors:
            continue  # what is wrong with the entries is reported itself
        id, path, what, hint = _translate(details, model)
        dotted = ".".join(str(part) for part in path)
        where = origin.place(path) if origin else dotted
        if path in errors and hint and errors[path].id == "unknown-choice":
            hint = f"{hint}, or {errors[path].hint}"  # an alternative: the other's hint
        errors[path] = InputError(id, what, where or None, hint)
    first, *others = errors.values()
    first.others = tuple(others[: _MOST - 1])
    return first


def _translate(
    details: Any, model: type[BaseModel]
) -> tuple[str, Path, str, str | None]:
    """Id, path, text and hint of one of pydantic's errors."""
    kind, context = details["type"], details.get("ctx", {})
    path = _clean(details["loc"])
    value = details["input"]
    if kind == "pestle":
        path = (*path, *context["key"])
        if context["key"]:
            value = _value_at(value, context["key"])
        return context["id"], path, _with_value(context, path, value), context["hint"]
    name = str(path[-1]) if path else "the case"
    section = _section(model, details["loc"][:-1])
    if kind == "extra_forbidden":
        known = _keys(section)
        return "unknown-key", path, f'unknown key "{name}"', did_you_mean(name, known)
    if kind == "missing" and path and isinstance(path[-1], int):
        what = f"{path[-2]} = {shown(value)} has too few entries"
        return "wrong-type", path[:-1], what, None
    if kind == "missing":
        what = f"{name} is missing"
        return "missing-key", path, what, _missing_hint(section, name)
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        return _tag(kind, context, path, value)
    if kind == "literal_error":
        hint = f"allowed: {context['expected']}"
        what = f"{name} = {shown(value)} is not possible"
        return "unknown-choice", path, what, hint
    reason = _REASONS.get(kind, details["msg"][:1].lower() + details["msg"][1:])
    return "wrong-type", path, f"{name} = {shown(value)}: {reason}", None


_REASONS = {
    "bool_type": "must be true or false",
    "string_type": "must be a text in quotes",
    "string_too_long": "the text is too long",
    "string_too_short": "must not be empty",
    "string_pattern_mismatch": "a name has letters, digits, _ and -, a letter first",
    "model_type": "must be a table",
    "model_attributes_type": "must be a table",
    "dict_type": "must be a table of tables",
    "tuple_type": "must be an array [...]",
    "too_long": "has too many entries",
    "too_short": "has too few entries",
}


def _with_value(context: Any, path: Path, value: Any) -> str:
    """Put key and value in front of a reason that does not name them itself."""
    what: str = context["what"]
    name = next((part for part in reversed(path) if isinstance(part, str)), "")
    if value is not None and what.startswith(shown(value)):
        return f"{name} = {what}"
    if value is None or isinstance(value, dict | BaseModel):
        return what
    if what.startswith("must"):
        return f"{name} = {shown(value)} {what}"
    return what if name in what else f"{name} = {shown(value)}: {what}"


def _tag(
    kind: str, context: Any, path: Path, value: Any
) -> tuple[str, Path, str, str | None]:
    tag = context["discriminator"].strip("'")
    if kind == "union_tag_not_found":
        if not isinstance(value, dict):
            what = f"{path[-1]} = {shown(value)}: must be a table"
            return "wrong-type", path, what, None
        return "missing-key", (*path, tag), f"{tag} is missing", f"add {tag} = ..."
    known = [name.strip(" '") for name in context["expected_tags"].split(",")]
    given = context["tag"]
    what = f'unknown {tag} "{given}"'
    return f"unknown-{tag}", (*path, tag), what, did_you_mean(given, known)


def _value_at(value: Any, key: Path) -> Any:
    for part in key:
        if isinstance(value, BaseModel):
            value = getattr(value, str(part), None)
        elif isinstance(value, dict):
            value = value.get(part)
        elif isinstance(value, list | tuple) and isinstance(part, int):
            value = value[part] if part < len(value) else None
        else:
            return None
    return value


def _clean(location: Path) -> Path:
    """Drop what pydantic adds for unions; it stands in no case file."""
    path: list[str | int] = []
    for part in location:
        if isinstance(part, str) and (
            part.startswith(_UNION_NOISE) or part in ("float", "[key]")
        ):
            continue
        follows = path and (
            (isinstance(path[-1], int) and path[0] == "process")
            or (len(path) == 2 and path[0] == "walls")
        )
        if follows and part in _TAGS:
            continue
        path.append(part)
    return tuple(path)


_TAGS = frozenset((*STEPS, "plane", "cylinder"))


def _section(model: type[BaseModel], path: Path) -> list[type[BaseModel]]:
    """Sections that a path can lead to (several where a tag decides)."""
    sections = [model]
    for part in path:
        tagged = [section for section in sections if part in _tag_of(section)]
        if tagged:
            sections = tagged
            continue
        following: list[type[BaseModel]] = []
        for section in sections:
            field = _field(section, part)
            if field is not None:
                following += _models(field.annotation)
            elif len(sections) and isinstance(part, int | str):
                following.append(section)  # an index or a free name inside a table
        sections = following or sections
    return sections


def _tag_of(section: type[BaseModel]) -> tuple[Any, ...]:
    """Word that chooses this section among others: its step or its kind."""
    fields = section.model_fields
    return tuple(fields[key].default for key in ("step", "kind") if key in fields)


def _field(section: type[BaseModel], name: str | int) -> FieldInfo | None:
    for key, field in section.model_fields.items():
        if name in (key, field.alias):
            return field
    return None


def _models(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models(part)]


def _keys(sections: list[type[BaseModel]]) -> set[str]:
    """Names that may stand in a section, as the file writes them."""
    keys: set[str] = set()
    for section in sections:
        for name, field in section.model_fields.items():
            keys.add(field.alias or name)
            if field.validation_alias and hasattr(field.validation_alias, "choices"):
                keys |= {str(choice) for choice in field.validation_alias.choices}
            if name == "to_stress":
                keys.add("to")
    return keys


def _missing_hint(sections: list[type[BaseModel]], name: str) -> str | None:
    for section in sections:
        field = _field(section, name)
        if field is not None and field.description:
            first = field.description.split(";")[0].split("\n")[0].rstrip(".")
            return f"add {name}: {first}"
    return None
