"""Write a case as TOML: the canonical copy that a run keeps of its case."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pestle.config.case import Case

_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def case_toml(case: "Case") -> str:
    """Return a case file with all values in SI units and absolute paths."""
    data = case.model_dump(mode="json", by_alias=True, exclude_none=True)
    data["law"] = {"name": data["law"]["name"], **data["law"]["options"]}
    for group in data["particles"]:
        for key in ("file", "start_from"):
            if key in group:
                group[key] = str(case.resolve(group[key]).resolve())
    for wall in data["walls"].values():
        if "file" in wall:
            wall["file"] = str(case.resolve(wall["file"]).resolve())
    if len(data["particles"]) == 1:
        data["particles"] = data["particles"][0]
    return "\n".join(["# All values in SI units.", *_table(data, ())]) + "\n"


def _table(data: dict[str, Any], path: tuple[str, ...]) -> list[str]:
    """Lines of a table: plain values first, then the tables in it."""
    lines, later = [], []
    for key, value in data.items():
        here = (*path, key)
        if isinstance(value, dict) and key != "radius":
            inner = _table(value, here)
            if any(not isinstance(item, dict) for item in value.values()):
                inner = ["", f"[{'.'.join(here)}]", *inner]
            later += inner
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for item in value:
                later += ["", f"[[{'.'.join(here)}]]", *_table(item, here)]
        else:
            lines.append(f"{key} = {_value(value)}")
    return lines + later


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, list):
        return f"[{', '.join(_value(item) for item in value)}]"
    if isinstance(value, dict):
        return (
            "{ " + ", ".join(f"{key} = {_value(v)}" for key, v in value.items()) + " }"
        )
    return '"' + "".join(_escaped(character) for character in str(value)) + '"'


def _escaped(character: str) -> str:
    if character in _ESCAPES:
        return _ESCAPES[character]
    code = ord(character)
    return f"\\u{code:04x}" if code < 0x20 or code == 0x7F else character
