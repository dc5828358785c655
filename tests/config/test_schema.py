"""The JSON Schema knows what a case file may hold."""

import json

import pytest

from pestle.config.schema import case_schema

SCHEMA = case_schema()


def test_it_is_json():
    assert json.loads(json.dumps(SCHEMA)) == SCHEMA


@pytest.mark.parametrize("name", sorted(SCHEMA["$defs"]))
def test_every_key_is_described(name):
    section = SCHEMA["$defs"][name]
    assert section["description"]
    for key, field in section.get("properties", {}).items():
        if name != "LawSettings":
            assert field.get("description"), key


def test_quantities_have_units():
    die = SCHEMA["$defs"]["DieSettings"]["properties"]
    assert die["radius"]["x-unit"] == "m"
    assert die["radius"]["anyOf"][1]["type"] == "string"


def test_keys_are_those_of_the_file():
    assert "for" in SCHEMA["$defs"]["Hold"]["properties"]
    assert "to" in SCHEMA["$defs"]["Press"]["properties"]
    assert "surface_energy" in SCHEMA["$defs"]["ContactSettings"]["properties"]


def test_laws_have_their_options():
    laws = {law.get("title"): law for law in SCHEMA["$defs"]["LawSettings"]["anyOf"]}
    assert laws["zunker2024"]["properties"]["radius_rule"]["enum"] == [
        "plastic",
        "eq37",
    ]


def test_quantities_in_a_unit_have_an_example():
    def quantities(node):
        if isinstance(node, dict):
            if "x-unit" in node and "anyOf" in node:
                yield node
            for child in node.values():
                yield from quantities(child)
        elif isinstance(node, list):
            for child in node:
                yield from quantities(child)

    found = list(quantities(SCHEMA))
    assert len(found) > 20
    for node in found:
        texts = [kind for kind in node["anyOf"] if kind.get("type") == "string"]
        assert all(text["examples"] for text in texts)
