"""reference/names.md against the schema of the case file and the columns of a run."""

import re

import pytest
from case_reference import branches, unit_of

from pestle.config.schema import case_schema

SCHEMA = case_schema()
ADHESION = {"surface_energy", "effective_surface_energy"}
BOOKKEEPING = {"schema_version", "seed", "history_every", "frames", "checkpoint_every"}
NUMBERS = {"number", "integer"}


def sections():
    """Label, as the page writes it, and definition of every section."""
    definitions = SCHEMA["$defs"]
    law = SCHEMA["$defs"]["LawSettings"]["anyOf"]
    for part in law:
        if "title" in part:
            yield "law", part
    for label, name in {
        "materials": "MaterialSettings",
        "contacts": "ContactSettings",
        "contacts.pairs": "PairSettings",
        "particles": "ParticleSettings",
        "particles.radius": "SizeDistribution",
        "die": "DieSettings",
        "walls.plane": "PlaneWall",
        "walls.cylinder": "CylinderWall",
        "walls.mesh": "MeshWall",
        "walls.blade": "BladeWall",
        "walls.shear_head": "ShearHead",
        "box": "BoxSettings",
        "engine": "EngineSettings",
        "output": "OutputSettings",
    }.items():
        yield label, definitions[name]
    for step, reference in SCHEMA["properties"]["process"]["items"]["discriminator"][
        "mapping"
    ].items():
        yield f"process.{step}", definitions[reference.rpartition("/")[2]]


def is_number(entry):
    """Whether numbers, alone or in an array, may stand behind a key."""
    for branch in branches(entry):
        inner = branch.get("prefixItems") or [branch.get("items", {})]
        if branch.get("type") in NUMBERS:
            return True
        if branch.get("type") == "array" and any(map(is_number, inner)):
            return True
    return False


def in_schema():
    """(name, unit, section) of every quantity of a case file."""
    found = set()
    for label, definition in sections():
        for key, entry in definition["properties"].items():
            if key in ADHESION | BOOKKEEPING or not is_number(entry):
                continue
            unit = "s, m/s" if key == "program" else unit_of(entry) or "-"
            found.add((key, "-" if unit == "1" else unit, label))
    return found


def rows(text, heading):
    """Cells of the table below a heading."""
    part = text.partition(f"## {heading}\n")[2].partition("\n## ")[0]
    lines = [line for line in part.splitlines() if line.startswith("|")][2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


@pytest.fixture(scope="module")
def page(docs):
    return (docs / "reference" / "names.md").read_text(encoding="utf-8")


def test_quantities_are_those_of_the_schema(page):
    on_page = {
        (name.strip("`"), unit, section.strip())
        for name, _, unit, _, where in rows(page, "Quantities of a case")
        for section in where.split(",")
    }
    assert on_page == in_schema()


def test_a_name_has_one_row_for_each_unit(page):
    names = [(row[0], row[2]) for row in rows(page, "Quantities of a case")]
    assert len(names) == len(set(names))


def test_a_symbol_means_one_thing(page):
    symbols = {}
    for row in rows(page, "Quantities of a case"):
        if row[1]:
            symbols.setdefault(row[1], set()).add(row[0])
    assert all(len(names) == 1 for names in symbols.values()), symbols


def test_columns_are_those_of_a_run(page, history_columns):
    on_page = {row[0].strip("`") for row in rows(page, "Columns of history.csv")}
    assert on_page == history_columns


def test_names_of_columns_carry_their_unit(page):
    for row in rows(page, "Columns of history.csv"):
        name = row[0].strip("`")
        assert name in ("step", "stage") or re.fullmatch(r".+ \[[^\]]+\]", name)
