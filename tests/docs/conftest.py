"""The documentation's own modules can be imported by its tests."""

import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parent.parent.parent / "docs"
sys.path[:0] = [str(DOCS / "_ext"), str(DOCS / "laws")]


@pytest.fixture(autouse=True)
def _registry_as_it_was():
    """Forget the laws that a test has registered: others ask for all laws."""
    from pestle.laws import _base

    before = dict(_base._REGISTRY)
    yield
    _base._REGISTRY.clear()
    _base._REGISTRY.update(before)


@pytest.fixture(scope="session")
def docs():
    """Folder of the pages."""
    return DOCS


@pytest.fixture(scope="session")
def history_columns(tmp_path_factory):
    """Columns of the history of a short run in a die; walls are written <wall>."""
    import pestle
    from pestle.results.history import read_columns

    folder = tmp_path_factory.mktemp("run")
    table = folder / "one.csv"
    table.write_text(
        "id,radius_m,density_kg_m3,x_m,y_m,z_m\n1,1e-3,1500,2e-4,0,1e-3\n",
        encoding="utf-8",
    )
    case = pestle.Case(
        law="hertz",
        materials={
            "powder": {"youngs_modulus": "5 MPa", "poisson_ratio": 0.3},
            "tool": {"rigid": True},
        },
        contacts={"restitution": 0.5},
        particles={"material": "powder", "file": str(table)},
        die={"radius": "2 mm", "height": "4 mm", "material": "tool"},
        process=[{"step": "relax", "for": "10 us"}],
    )
    pestle.run(case, out=folder / "out")
    columns = read_columns(folder / "out" / "history.csv")
    walls = sorted(case.all_walls, key=len, reverse=True)
    found = []
    for column in columns:
        for wall in walls:
            column = column.replace(f"{wall}.", "<wall>.")
        found.append(column)
    return set(found)
