"""Pages of papers: every function and test that stands beside an equation exists."""

import importlib
import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
PAPERS = {
    "shahin2021": ("pestle.particle", "particle", "semimech"),
    "edmans2020": ("pestle.particle", "particle", "edmans"),
    "nan2022": ("pestle.reference", "reference", "nan"),
    "zunker2024": ("pestle.reference", "reference", "mdr"),
}


def rows(name):
    """Cells of the table of equations of a page."""
    text = (ROOT / "docs" / "papers" / f"{name}.md").read_text(encoding="utf-8")
    table = text.split("| equation | function | test |\n")[1].split("\n\n")[0]
    return [
        [c.strip() for c in row.strip("|").split("|")] for row in table.split("\n")
    ][1:]


CELLS = [
    pytest.param(name, *row, id=f"{name}-{row[0][:24]}")
    for name in PAPERS
    for row in rows(name)
]


@pytest.mark.parametrize(("name", "equation", "functions", "tests"), CELLS)
def test_functions_and_tests_exist(name, equation, functions, tests):
    package, folder, _ = PAPERS[name]
    named = re.findall(r"`(\w+)\.(\w+)`", functions)
    assert named or "no function" in functions
    for module, function in named:
        home = importlib.import_module(f"{package}.{module}")
        assert callable(getattr(home, function))
    for module, test in re.findall(r"`(\w+)\.(\w+)`", tests):
        text = (ROOT / "tests" / folder / f"{module}.py").read_text(encoding="utf-8")
        assert re.search(rf"^(class|def) {test}\b", text, flags=re.MULTILINE)


@pytest.mark.parametrize("name", PAPERS)
def test_features_exist(name):
    file = ROOT / "tests" / "data" / "reference" / f"{PAPERS[name][2]}.json"
    features = {c["feature"] for c in json.loads(file.read_text())["cases"]}
    for _, _, tests in rows(name):
        assert set(re.findall(r"feature `(\w+)`", tests)) <= features


def numbers(text):
    """Equations that a cell names, (2.4) and (2.7)-(2.9) as single numbers."""
    found = set()
    for first, last in re.findall(r"\((\w+\.\d+)\)(?:-\((\w+\.\d+)\))?", text):
        chapter, start = first.split(".")
        end = int(last.split(".")[1]) if last else int(start)
        found |= {f"{chapter}.{n}" for n in range(int(start), end + 1)}
    return found


def test_every_equation_of_nan_2022_is_there():
    named = set()
    for cells in rows("nan2022"):
        for first, last in re.findall(r"\((\d+)\)(?:-\((\d+)\))?", " ".join(cells[:2])):
            named |= set(range(int(first), int(last or first) + 1))
    assert named >= set(range(1, 82))


def test_every_equation_of_zunker_2024_is_there():
    text = (ROOT / "docs" / "papers" / "zunker2024.md").read_text(encoding="utf-8")
    left = text.split("nothing is computed")[0].rpartition("\n\n")[2]
    said = " ".join(row[0] for row in rows("zunker2024")) + left
    plain = set()
    for first, last in re.findall(r"\((\d+)\)(?:-\((\d+)\))?", said):
        plain |= set(range(int(first), int(last or first) + 1))
    assert plain == set(range(1, 50))
    wanted = {f"A.{n}" for n in range(1, 37)} | {f"C.{n}" for n in range(1, 8)}
    wanted |= {f"F.{n}" for n in range(1, 19)}
    assert wanted - numbers(said) == set()


def test_every_equation_of_the_thesis_is_there():
    """Numbers run without a gap: 2.1 to 2.52, 3.1 to 3.59, and the appendices."""
    text = (ROOT / "docs" / "papers" / "shahin2021.md").read_text(encoding="utf-8")
    named = {
        n for _, e, *_ in [("", *row) for row in rows("shahin2021")] for n in numbers(e)
    }
    named |= numbers(text.split("nothing is computed")[0].rpartition("\n\n")[2])
    wanted = {f"2.{n}" for n in range(1, 53)} | {f"3.{n}" for n in range(1, 60)}
    wanted |= {f"B.{n}" for n in range(1, 26)} | {f"C.{n}" for n in range(1, 11)}
    wanted |= {f"D.{n}" for n in range(1, 7)}
    assert wanted - named == set()
