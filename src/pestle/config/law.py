"""[law]: which contact law acts and its options."""

import dataclasses
from typing import Any, Literal, get_args, get_origin, get_type_hints

from pydantic import Field, PrivateAttr, model_validator

from pestle.config.base import Section, problem
from pestle.errors import InputError, PestleError, did_you_mean
from pestle.units import to_si


class LawSettings(Section):
    """The contact law; its options stand beside `name` in the file."""

    name: str
    """Name or alias of a law, see `pestle laws`."""
    options: dict[str, Any] = Field(default_factory=dict)
    """The law's own options; in the file they stand directly in [law]."""
    _law: Any = PrivateAttr(default=None)

    @model_validator(mode="wrap")
    @classmethod
    def _read(cls, value: Any, handler: Any) -> "LawSettings":
        if isinstance(value, cls):
            return value
        law: Any = value if dataclasses.is_dataclass(value) else _built(value)
        settings: LawSettings = handler(
            {"name": law.name, "options": dataclasses.asdict(law)}
        )
        settings._law = law
        return settings

    def build(self) -> Any:
        """Return the law as the object that the engine takes."""
        return self._law


def law_class(name: str) -> type:
    """Find a law by name or alias."""
    from pestle import laws

    try:
        return laws.get(name)
    except InputError as error:
        raise problem(error.id, error.what, error.hint, key=("name",)) from None


def option_fields(law: type) -> dict[str, dataclasses.Field[Any]]:
    """Options of a law by name."""
    return {field.name: field for field in dataclasses.fields(law)}


def _built(value: Any) -> Any:
    if isinstance(value, str):
        value = {"name": value}
    if not isinstance(value, dict):
        raise problem("not-a-table", "must be a table with a name", 'name = "mdr"')
    given = {**value, **value.get("options", {})}
    given.pop("options", None)
    name = given.pop("name", None)
    if not isinstance(name, str):
        raise problem(
            "missing-key", "the law has no name", 'add name = "zunker2024"', ("name",)
        )
    law = law_class(name)
    fields = option_fields(law)
    hints = get_type_hints(law)
    options = {}
    for key, raw in given.items():
        if key not in fields:
            hint = did_you_mean(key, fields) if fields else "this law has no options"
            what = f'unknown key "{key}" of the law {name}'
            raise problem("unknown-key", what, hint, key=(key,))
        options[key] = _option(key, raw, fields[key], hints[key])
    return _constructed(law, options)


def _constructed(law: type, options: dict[str, Any]) -> Any:
    try:
        return law(**options)
    except PestleError as error:
        last = (error.where or "").rpartition(".")[2]
        key = (last,) if last in options else ()
        raise problem(error.id, error.what, error.hint, key=key) from None
    except TypeError as error:
        missing = [
            field.name
            for field in dataclasses.fields(law)
            if field.name not in options
            and field.default is dataclasses.MISSING
            and field.default_factory is dataclasses.MISSING
        ]
        what = f"the law needs {', '.join(missing)}" if missing else str(error)
        raise problem("missing-key", what) from None
    except ValueError as error:
        raise problem("bad-law-option", str(error)) from None


def _option(key: str, raw: Any, field: dataclasses.Field[Any], hint: Any) -> Any:
    """Check one option against the type and the metadata of its field."""
    choices = field.metadata.get("choices")
    if get_origin(hint) is Literal:
        choices = get_args(hint)
    if choices:
        if raw not in choices:
            known = ", ".join(f'"{choice}"' for choice in choices)
            close = did_you_mean(raw, choices) if isinstance(raw, str) else None
            what = f"{key} must be one of {known}"
            raise problem("unknown-choice", what, close, key=(key,))
        return raw
    optional = type(None) in get_args(hint)
    if raw is None and optional:
        return None
    kinds = [kind for kind in get_args(hint) or (hint,) if kind is not type(None)]
    if kinds == [float]:
        try:
            return to_si(raw, field.metadata.get("unit", "1"))
        except InputError as error:
            raise problem(error.id, error.what, error.hint, key=(key,)) from None
    if not isinstance(raw, tuple(kinds)) or (
        isinstance(raw, bool) != (kinds == [bool])
    ):
        words = {bool: "true or false", int: "a whole number", str: "a text"}
        wanted = words.get(kinds[0], kinds[0].__name__)
        raise problem("wrong-type", f"{key} must be {wanted}", key=(key,))
    return raw
