"""The generated reference pages hold everything that they are made from."""

import re

import case_reference
import command_reference
import error_ids
import example_list
import metric_reference
import pytest
import result_columns

from broken_cases import ADDED, REPLACED, WHOLE
from broken_cases import CASE as GOOD
from pestle.config import Case
from pestle.config.schema import case_schema
from pestle.errors import InputError
from pestle.results import schema

SCHEMA = case_schema()
PAGE = case_reference.page()
ERRORS = error_ids.page()


@pytest.mark.parametrize("name", sorted(SCHEMA["$defs"]))
def test_every_key_of_the_schema_is_in_the_reference(name):
    for key in SCHEMA["$defs"][name].get("properties", {}):
        assert f"`{key}`" in PAGE or key in ("step", "kind"), key


def test_options_of_the_laws_are_in_the_reference():
    assert "`psi_b`" in PAGE
    assert '`"plastic"` or `"eq37"`' in PAGE


def test_every_row_says_what_it_means():
    for line in PAGE.splitlines():
        if line.startswith("| `"):
            assert len(line.split("|")[-2].strip()) > 3, line


def test_aliases_stand_beside_their_name():
    (line, _) = [x for x in PAGE.splitlines() if x.startswith("| `work_of_adhesion`")]
    assert "`surface_energy`, `effective_surface_energy`" in line


def test_ids_of_broken_cases_are_on_the_page(tmp_path):
    known = {place.id for place in error_ids.places()}
    broken = [GOOD.replace(old, new, 1).encode() for _, old, new, *_ in REPLACED]
    broken += [(GOOD + text).encode() for _, text, *_ in ADDED]
    broken += [data for _, data, *_ in WHOLE]
    path = tmp_path / "case.toml"
    for data in broken:
        path.write_bytes(data)
        with pytest.raises(InputError) as error:
            Case.from_file(path)
        for found in (error.value, *error.value.others):
            assert found.id in known


def test_ids_are_labels_on_the_page():
    for place in error_ids.places():
        assert error_ids.ID.fullmatch(place.id)
        assert f"(error-{place.id})=" in ERRORS


def test_most_errors_say_what_to_do():
    found = error_ids.places()
    assert len(found) > 100
    assert sum(bool(place.hint) for place in found) > 0.7 * len(found)


@pytest.mark.parametrize("name", ["run", "plan", "report", "laws", "materials", "cite"])
def test_commands_are_on_the_page(name):
    assert re.search(rf"(?m)^## `pestle {name}\b", command_reference.page())


@pytest.mark.parametrize(
    "key", ["peak_axial_stress", "tensile_strength", "d{percent}", "ledger_residual"]
)
def test_metrics_have_unit_and_definition(key):
    (line,) = [
        x for x in metric_reference.page().splitlines() if x.startswith(f"| `{key}`")
    ]
    _, _, label, unit, definition, _ = line.split("|")
    assert label.strip()
    assert unit.strip()
    assert len(definition) > 20


def test_columns_of_the_results_are_on_the_page():
    assert all(
        f"`{name}`" in result_columns.particles() for name in schema.PARTICLE_FIELDS
    )
    assert all(
        f"`{name}`" in result_columns.contacts() for name in schema.CONTACT_FIELDS
    )
    assert all(f"`{name}`" in result_columns.meshes() for name in schema.MESH_FIELDS)


def test_examples_say_what_they_are_for():
    rows = example_list.page().splitlines()[2:]
    assert len(rows) >= 3
    for row in rows:
        _, name, title, purpose, _ = row.split("|")
        assert title.strip(), name
        assert len(purpose) > 30, name
