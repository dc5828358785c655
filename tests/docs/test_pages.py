"""What the pages show works: examples in Python and TOML, names of functions, links."""

import doctest
import importlib
import re
import shlex
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest

from pestle.config import Case

ROOT = Path(__file__).parent.parent.parent
PAGES = sorted(
    path
    for path in (ROOT / "docs").rglob("*.md")
    if not {"_build", "_generated"} & set(path.parts)
)
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)


def blocks(page, language):
    text = page.read_text(encoding="utf-8")
    return [body for kind, body in FENCE.findall(text) if kind == language]


def of(language, needle=""):
    return [
        pytest.param(body, id=f"{page.stem}-{number}")
        for page in PAGES
        for number, body in enumerate(blocks(page, language))
        if needle in body
    ]


@pytest.mark.parametrize("text", of("python", ">>>"))
def test_examples_in_python(text):
    test = doctest.DocTestParser().get_doctest(text, {}, "page", None, 0)
    runner = doctest.DocTestRunner(verbose=False)
    report = []
    runner.run(test, out=report.append)
    assert runner.failures == 0, "".join(report)


def merged(base, part):
    """Tables of a case with those of a fragment put over them."""
    result = dict(base)
    for key, value in part.items():
        old = result.get(key)
        both = isinstance(old, dict) and isinstance(value, dict)
        result[key] = merged(old, value) if both else value
    return result


def base(docs_text):
    """The case of the quick start, with what fragments refer to."""
    case = tomllib.loads(docs_text)
    case["materials"]["sphere"] = {"youngs_modulus": 1e9, "poisson_ratio": 0.3}
    case["materials"]["flat"] = {"rigid": True}
    return case


@pytest.mark.parametrize("text", of("toml"))
def test_cases_in_toml(text, docs, tmp_path, monkeypatch):
    part = tomllib.loads(text)
    if "project" in part:
        return  # a piece of somebody's pyproject.toml
    whole = blocks(docs / "quick-start.md", "toml")[0]
    case = merged(base(whole), part)
    if "start_from" in part.get("particles", {}):
        for key in ("count", "radius"):
            case["particles"].pop(key)
        case["process"] = case["process"][1:]
    elif "process" in part and part["process"][0]["step"] != "fill":
        case["process"] = [{"step": "fill"}, *part["process"]]
    Case(**case)


def shown_functions():
    """Names such as `mdr.overlap` in the table of equations of the page on MDR."""
    text = (ROOT / "docs" / "theory" / "mdr.md").read_text(encoding="utf-8")
    homes = "abel ellipse hertz mdr peeling validity volume zunker2024 particle"
    pattern = rf"`({'|'.join(homes.split())}|_mdr_\w+)\.(\w+)`"
    return sorted(set(re.findall(pattern, text)))


@pytest.mark.parametrize(("module", "name"), shown_functions())
def test_functions_of_equations_exist(module, name):
    in_laws = module == "zunker2024" or module.startswith("_mdr_")
    home = f"pestle.{'laws' if in_laws else 'reference'}.{module}"
    if module == "particle":
        importlib.import_module(f"pestle.particle.{name}")
    else:
        assert callable(getattr(importlib.import_module(home), name))


def test_tags_in_the_source_are_reading_notes():
    text = (ROOT / "docs" / "theory" / "reading-notes.md").read_text(encoding="utf-8")
    labels = {label.upper() for label in re.findall(r"(?m)^\((\w+)\)=$", text)}
    used = set()
    for path in (ROOT / "src" / "pestle").rglob("*.py"):
        used |= set(re.findall(r"\[([DST]\d+b?)\]", path.read_text(encoding="utf-8")))
    assert used
    assert {tag.upper() for tag in used} <= labels


def runs_with_set():
    """File and settings of the `pestle run` commands that the pages show."""
    found = []
    for page in PAGES:
        for body in blocks(page, "sh"):
            for line in body.replace("\\\n", " ").splitlines():
                words = shlex.split(line, comments=True)
                if words[:2] == ["pestle", "run"] and "--set" in words:
                    settings = [b for a, b in pairwise(words) if a == "--set"]
                    found.append((words[2], settings))
    return found


@pytest.mark.parametrize(("case", "settings"), runs_with_set())
def test_settings_in_pages_can_be_set(case, settings, docs, tmp_path):
    path = next(iter(ROOT.glob(f"**/examples/{Path(case).name}")), None)
    if path is None:
        path = tmp_path / case
        text = blocks(docs / "quick-start.md", "toml")[0]
        path.write_text(text, encoding="utf-8")
    settings = [text.replace("$w", "200") for text in settings]
    changed = Case.from_file(path, settings)
    assert changed.canonical() != Case.from_file(path).canonical()


def test_commands_in_pages_exist():
    from typer.main import get_command

    from pestle.cli.app import app

    known = set(get_command(app).commands)
    for page in PAGES:
        for body in blocks(page, "sh"):
            for command in re.findall(r"(?m)^\s*pestle (\w+)", body):
                assert command in known, (page, command)
