"""The columns of the results file, from its own description."""

from collections.abc import Mapping

from pieces import code, sentence, table

from pestle.results import schema


def particles() -> str:
    """Return the table of the particles' columns."""
    return _table(schema.PARTICLE_FIELDS)


def contacts() -> str:
    """Return the table of the contacts' columns."""
    return _table(schema.CONTACT_FIELDS)


def meshes() -> str:
    """Return the table of the columns of walls' triangles."""
    return _table(schema.MESH_FIELDS)


def _table(fields: Mapping[str, schema.Field]) -> str:
    return table(
        ("column", "unit", "meaning"),
        [(code(n), f.unit, sentence(f.description)) for n, f in fields.items()],
    )
