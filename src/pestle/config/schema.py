"""JSON Schema of a case file, for editors and for the reference in the docs."""

import dataclasses
from typing import Any, get_type_hints


def case_schema() -> dict[str, Any]:
    """Return the JSON Schema of a case file.

    Quantities carry their SI unit as ``x-unit``. The section ``law`` lists the options
    of every law that is installed.
    """
    from pestle.config.case import Case

    schema = Case.model_json_schema(by_alias=True)
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    schema["title"] = "pestle case file"
    schema["description"] = "A case of pestle, format version 1."
    definitions = schema["$defs"]
    definitions["LawSettings"] = _law_schema()
    _accept_to(definitions["Press"])
    _accept_plain_radius(definitions)
    _accept_one_powder(schema["properties"]["particles"])
    _accept_adhesion_names(definitions)
    return schema


def _accept_to(press: dict[str, Any]) -> None:
    press["properties"]["to"] = {
        "type": "string",
        "description": "Stress, force or displacement at which the step ends; the unit "
        "tells which.",
        "examples": ["150 MPa", "30 N", "2 mm"],
    }


def _accept_plain_radius(definitions: dict[str, Any]) -> None:
    """A radius may be one quantity; minimum, maximum and mean may be left out."""
    sizes = definitions["SizeDistribution"]
    sizes["required"] = ["distribution"]
    radius = definitions["ParticleSettings"]["properties"]["radius"]
    radius["anyOf"] = [*sizes["properties"]["mean"]["anyOf"], *radius["anyOf"]]
    radius["x-unit"] = "m"


def _accept_one_powder(particles: dict[str, Any]) -> None:
    """One powder may be a table; several are an array of tables."""
    keys = ("type", "items", "minItems", "maxItems")
    array = {key: particles.pop(key) for key in keys if key in particles}
    particles["anyOf"] = [array["items"], array]


def _accept_adhesion_names(definitions: dict[str, Any]) -> None:
    from pestle.config.contacts import ADHESION_ALIASES

    for section in ("ContactSettings", "PairSettings"):
        properties = definitions[section]["properties"]
        for alias in ADHESION_ALIASES:
            properties[alias] = {
                **properties["work_of_adhesion"],
                "description": "Another name of work_of_adhesion.",
            }


def _law_schema() -> dict[str, Any]:
    from pestle import laws

    tables = [_one_law(name, laws.get(name)) for name in laws.names()]
    return {
        "description": "The contact law; its options stand beside its name.",
        "type": "object",
        "required": ["name"],
        "properties": {"name": {"type": "string", "examples": laws.names()}},
        "anyOf": [*tables, {"properties": {"name": {"not": {"enum": laws.names()}}}}],
    }


def _one_law(name: str, law: type) -> dict[str, Any]:
    hints = get_type_hints(law)
    kinds = {float: "number", int: "integer", bool: "boolean", str: "string"}
    properties: dict[str, Any] = {"name": {"const": name}}
    for field in dataclasses.fields(law):
        entry: dict[str, Any] = {"description": field.metadata.get("help", "")}
        if field.metadata.get("choices"):
            entry["enum"] = list(field.metadata["choices"])
        elif hints[field.name] in kinds:
            entry["type"] = kinds[hints[field.name]]
        if field.metadata.get("unit", "1") != "1":
            entry["x-unit"] = field.metadata["unit"]
            entry.pop("type", None)
            text = {"type": "string", "examples": [f"1 {field.metadata['unit']}"]}
            entry["anyOf"] = [{"type": "number"}, text]
        if field.default not in (dataclasses.MISSING, None):
            entry["default"] = field.default
        properties[field.name] = entry
    return {
        "title": name,
        "properties": properties,
        "required": ["name"],
        "additionalProperties": False,
    }
