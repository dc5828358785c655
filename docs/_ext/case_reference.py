"""The case-file reference, from the JSON Schema that `pestle schema` prints."""

import json
from collections.abc import Iterator
from typing import Any

from pieces import code, sentence, table

from pestle.config.schema import case_schema
from pestle.units import DIMENSIONS

Schema = dict[str, Any]

SECTIONS = {
    "[law]": "law",
    "[materials.NAME]": "MaterialSettings",
    "[contacts]": "ContactSettings",
    "[[contacts.pairs]]": "PairSettings",
    "[particles] or [[particles]]": "ParticleSettings",
    "[particles.radius]": "SizeDistribution",
    "[die]": "DieSettings",
    "[walls.NAME], a plane": "PlaneWall",
    "[walls.NAME], a cylinder": "CylinderWall",
    "[walls.NAME], a mesh": "MeshWall",
    "[walls.NAME], a blade": "BladeWall",
    "[walls.NAME], a shear head": "ShearHead",
    "[box]": "BoxSettings",
    "[engine]": "EngineSettings",
    "[[process]]": "process",
    "[output]": "OutputSettings",
}
"""Headings of the page and the definition in the schema that each shows."""

ALIAS = "Another name of "
_TAGS = ("step", "kind")  # the heading says them
_NOTABLE = 100.0  # larger upper bounds only catch wrong units
_HEADER = ("key", "value", "default", "meaning")


def page() -> str:
    """Return the page below its introduction."""
    schema = case_schema()
    parts = ["## Top of the file\n", table(_HEADER, _top(schema))]
    for heading, name in SECTIONS.items():
        parts.append(f"({anchor(heading)})=\n\n## {code(heading)}\n")
        if name == "law":
            parts += _laws(schema)
        elif name == "process":
            parts += _steps(schema)
        else:
            parts += _section(schema["$defs"][name])
    return "\n".join(parts)


def anchor(heading: str) -> str:
    """Return the label of a heading: ``case-materials-name``."""
    words = "".join(c if c.isalnum() else " " for c in heading.lower()).split()
    kept = dict.fromkeys(word for word in words if word not in ("a", "or"))
    return "-".join(["case", *kept])


def _top(schema: Schema) -> Iterator[tuple[str, ...]]:
    for row in _rows(schema):
        if not any(f"[{row[0].strip('`')}" in heading for heading in SECTIONS):
            yield row


def _section(definition: Schema) -> list[str]:
    return [definition["description"] + "\n", table(_HEADER, _rows(definition))]


def _laws(schema: Schema) -> list[str]:
    from pestle.laws import _base

    section = schema["$defs"]["LawSettings"]
    parts = [sentence(section["description"]) + "\n"]
    for law in section["anyOf"]:
        if "title" not in law:
            continue
        name = law["title"]
        known: dict[str, Any] = {a: p.law for a, p in _base._REGISTRY.items()}
        aliases = [a for a, law_ in known.items() if law_.name == name != a]
        also = f" (also {', '.join(map(code, aliases))})" if aliases else ""
        parts.append(f"### {code(f'name = {json.dumps(name)}')}{also}\n")
        parts.append(sentence(getattr(known[name], "summary", "")) + "\n")
        options = [row for row in _rows(law) if row[0] != "`name`"]
        parts.append(table(_HEADER, options) if options else "It has no options.\n")
    return parts


def _steps(schema: Schema) -> list[str]:
    process = schema["properties"]["process"]
    parts = [
        sentence(process["description"])
        + f" At least {process['minItems']}, at most {process['maxItems']}.\n"
    ]
    steps = [
        reference["$ref"].rpartition("/")[2] for reference in process["items"]["oneOf"]
    ]
    common = {"name": schema["$defs"][steps[0]]["properties"]["name"]}
    parts += ["Every step may have:\n", table(_HEADER, _rows({"properties": common}))]
    for step in steps:
        definition = schema["$defs"][step]
        word = definition["properties"]["step"]["const"]
        parts.append(
            f"(case-step-{word})=\n\n### {code(f'step = {json.dumps(word)}')}\n"
        )
        parts.append(definition["description"] + "\n")
        rows = [row for row in _rows(definition) if row[0] != "`name`"]
        if rows:
            rows.sort(key=lambda row: row[0] != "`to`")
            parts.append(table(_HEADER, rows))
    return parts


def _rows(definition: Schema) -> Iterator[tuple[str, ...]]:
    """Key, value, default and meaning of every key of a section."""
    needed = definition.get("required", ())
    aliases = _aliases(definition)
    for key, entry in definition["properties"].items():
        meaning = entry.get("description", "")
        if key in _TAGS or meaning.startswith(ALIAS):
            continue
        unit = unit_of(entry)
        if unit:
            meaning = meaning.replace(f" [{unit}]", "")
        meaning = sentence(meaning.replace(" [-]", ""))
        if key in aliases:
            meaning += f" Other names: {', '.join(map(code, aliases[key]))}."
        yield code(key), value(entry), _default(entry, key in needed), meaning


def _aliases(definition: Schema) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for key, entry in definition["properties"].items():
        meaning = entry.get("description", "")
        if meaning.startswith(ALIAS):
            found.setdefault(meaning[len(ALIAS) :].rstrip("."), []).append(key)
    return found


def branches(entry: Schema) -> Iterator[Schema]:
    """All alternatives of a value, without null."""
    if "anyOf" in entry:
        for branch in entry["anyOf"]:
            inherited = {k: v for k, v in entry.items() if k == "x-unit"}
            yield from branches({**inherited, **branch})
    elif entry.get("type") != "null":
        yield entry


def unit_of(entry: Schema) -> str | None:
    """SI unit of a quantity, or of the numbers of an array."""
    if "x-unit" in entry:
        return str(entry["x-unit"])
    items = [entry["items"]] if isinstance(entry.get("items"), dict) else []
    inner = [*entry.get("anyOf", ()), *entry.get("prefixItems", ()), *items]
    return next((unit for part in inner if (unit := unit_of(part))), None)


def value(entry: Schema) -> str:
    """Say what may stand behind a key."""
    texts = [_one(branch) for branch in branches(entry)]
    return " or ".join(dict.fromkeys(text for text in texts if text))


def _one(entry: Schema) -> str:
    if "const" in entry:
        return code(json.dumps(entry["const"]))
    if "enum" in entry:
        return " or ".join(code(json.dumps(choice)) for choice in entry["enum"])
    if "$ref" in entry:
        return "a table"
    if "prefixItems" in entry:
        inner = list(dict.fromkeys(value(part) for part in entry["prefixItems"]))
        count = len(entry["prefixItems"])
        return f"{count} × {inner[0]}" if len(inner) == 1 else f"[{', '.join(inner)}]"
    kind = entry.get("type")
    if kind == "array":
        inner_text = value(entry.get("items", {})) or "tables"
        return f"a list of {inner_text.replace('a table', 'tables')}"
    if "x-unit" in entry:
        if kind == "string":
            return ""  # a text with a unit: said once in the introduction
        unit = entry["x-unit"]
        return f"{DIMENSIONS[unit]} [{unit}]{_range(entry)}"
    words = {
        "integer": "whole number",
        "number": "number",
        "string": "text",
        "boolean": "`true` or `false`",
        "object": "tables by name",
    }
    return words.get(str(kind), "a table" if kind is None else str(kind)) + _range(
        entry
    )


def _range(entry: Schema) -> str:
    signs = {
        "exclusiveMinimum": ">",
        "minimum": "≥",
        "exclusiveMaximum": "<",
        "maximum": "≤",
    }
    found = [
        f"{sign}\N{NO-BREAK SPACE}{entry[key]:g}"
        for key, sign in signs.items()
        if key in entry and abs(entry[key]) <= _NOTABLE
    ]
    return f", {' and '.join(found)}" if found else ""


def _default(entry: Schema, needed: bool) -> str:
    if needed:
        return "**needed**"
    default = entry.get("default")
    if default is None or default in ("", [], {}):
        return "–"
    return code(json.dumps(default))
