"""A card for each contact law, and the table to choose from.

Equations, parameters, validity and references come from the source, reference values
from the files of the tests, cost from `laws/cost.json` (nanoseconds a contact or point,
written from `benchmarks/bench.py`), the words from `laws/cards.toml`.
"""

import dataclasses
import importlib
import inspect
import json
import re
import textwrap
import tomllib
import warnings
from functools import cache
from pathlib import Path
from typing import Any

from formulas import braced, is_formula
from pieces import code, table

DOCS = Path(__file__).parent.parent
LAWS = DOCS / "laws"
REFERENCE = DOCS.parent / "tests" / "data" / "reference"
KINDS = {
    "pair": "law of a pair, for runs",
    "loading": "law of one particle between flats",
    "unloading": "law of unloading of one particle",
}
MATURITY = {
    "closed_form": "closed form",
    "reference": "reference values",
    "finite_elements": "finite elements",
    "experiment": "experiment",
}
PLOTTED = {
    "youngs_modulus": 5e9,
    "poisson_ratio": 0.3,
    "yield_stress": 2e7,
    "work_of_adhesion": 0.0,
    "strength": 3e7,
    "hardening_exponent": 0.4,
    "stiffness_ratio": 20.0,
    "transition": 0.1,
    "stiffening": 5e5,
}
"""Parameters of the figures of particle laws."""
STIFFNESSES = {
    "luding2008": {
        "loading_stiffness": 3e3,
        "unloading_stiffness": 2e4,
        "cohesive_stiffness": 3e3,
    },
    "walton_braun1986": {"loading_stiffness": 3e3, "unloading_stiffness": 2e4},
    "pasha2014": {
        "elastic_stiffness": 2e4,
        "plastic_stiffness": 5e3,
        "yield_force": 5e-5,
    },
    "pasha2014_simplified": {
        "plastic_stiffness": 3e3,
        "elastic_stiffness": 2e4,
        "cohesive_stiffness": 3e2,
        "pull_off_force": 2e-5,
    },
}
"""Options of pair laws that have no default, for their figures."""
PEAKS = {"jkr": (0.0002,), "dmt": (0.0002,), "storakers1997": (0.005, 0.01, 0.02)}
"""Overlaps over the radius at which pair laws unload, where the usual show little."""


@cache
def words() -> dict[str, Any]:
    """What `cards.toml` says."""
    return tomllib.loads((LAWS / "cards.toml").read_text(encoding="utf-8"))


@cache
def costs() -> dict[str, float]:
    """Nanoseconds a contact or curve point."""
    return dict(json.loads((LAWS / "cost.json").read_text(encoding="utf-8")))


def laws_of(name: str) -> dict[str, Any]:
    """Classes of a name by kind."""
    from pestle import laws
    from pestle.particle.law import LOADING, UNLOADING

    found = {"pair": laws.get(name)} if name in laws.names() else {}
    if name in LOADING:
        found["loading"] = LOADING[name]
    if name in UNLOADING:
        found["unloading"] = UNLOADING[name]
    return found


def names() -> list[str]:
    """Names of all built-in laws."""
    from pestle import laws
    from pestle.particle.law import LOADING, UNLOADING

    every = {*laws.names(), *LOADING, *UNLOADING}
    ours = {
        name
        for name in every
        for law in laws_of(name).values()
        if law.__module__.startswith("pestle.")
    }
    return sorted(ours)


def page(name: str) -> str:
    """Card of a law."""
    card, kinds = words()[name], laws_of(name)
    first = next(iter(kinds.values()))
    parts = [f"(law-{name})=\n# {code(name)}\n"]
    parts += [
        f"{_sentence(law.summary)} ({KINDS[kind]})\n" for kind, law in kinds.items()
    ]
    parts.append(f"**For** {card['good']}.\n")
    if "page" in card:
        parts.append(f"How its paper is read: {{doc}}`{card['page']}`.\n")
    parts.append(f"![Loading and unloading]({name}.svg)\n")
    parts.append("## Equations\n")
    if "equations" in card:
        parts.append(f"Every equation is on {{doc}}`{card['equations']}`.\n")
    for module in _modules(card, kinds):
        parts.append(markdown(inspect.cleandoc(module.__doc__ or "")) + "\n")
    parts.append("## Parameters\n")
    for kind, law in kinds.items():
        if len(kinds) > 1:
            parts.append(f"As {KINDS[kind]}:\n")
        parts.append(_parameters(kind, law))
    parts.append("## Where it holds\n")
    valid = [law.validity for law in kinds.values() if getattr(law, "validity", "")]
    texts = [card["valid"]] if card.get("valid") else valid
    parts.append("\n\n".join(_sentence(_plain(text)) for text in texts) + "\n")
    parts.append("## Known defects\n")
    parts.append("\n".join(f"- {_plain(text)}" for text in card["defects"]) + "\n")
    parts.append("## Checked against\n")
    parts.append(_maturity(card))
    parts.append("## Tests\n")
    rows = [(code(test), _plain(tolerance)) for test, tolerance in card["tests"]]
    parts.append(table(("test", "tolerance"), rows))
    if card["features"]:
        parts.append(
            table(("reference values", "cases", "tolerance"), _reference(card))
        )
    parts.append("## Cost\n")
    parts.append(_cost(name, kinds) + "\n")
    parts.append("## Reference\n")
    parts.append("\n\n".join(_cited(first.citation)) + "\n")
    return "\n".join(parts)


def overview() -> str:
    """Table of all laws to choose from."""
    rows = []
    for name in names():
        card = words()[name]
        known = ", ".join(
            short
            for key, short in MATURITY.items()
            if (key == "reference" and card["features"]) or key in card
        )
        kinds = " and ".join(laws_of(name))
        cost = _cost_of(name)
        rows.append(
            (
                f"{{doc}}`{name} <cards/{name}>`",
                kinds,
                _plain(card["good"]),
                known,
                "" if cost is None else f"{cost:g}",
            )
        )
    return table(("law", "kind", "good for", "checked against", "ns"), rows)


def figure(name: str) -> Any:
    """Loading and unloading of a law."""
    from pestle.particle import build, fields

    kinds = laws_of(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if "pair" in kinds and "loading" not in kinds:
            options = {"peaks": PEAKS[name]} if name in PEAKS else {}
            return kinds["pair"](**STIFFNESSES.get(name, {})).plot(**options)
        whole = (
            name if name in ("zunker2024", "cylinders2020") else f"{name}+edmans2020"
        )
        if "loading" not in kinds:
            whole = f"shahin2021+{name}"
        if name == "cylinders2020":
            whole = f"{name}+{name}"
        known = fields(whole)
        law = build(whole, {k: v for k, v in PLOTTED.items() if k in known})
        return law.plot()


def _modules(card: dict[str, Any], kinds: dict[str, Any]) -> list[Any]:
    """Modules whose words hold the equations of a law."""
    if "modules" in card:
        return [
            importlib.import_module(f"pestle.particle.{m}") for m in card["modules"]
        ]
    return list(dict.fromkeys(inspect.getmodule(law) for law in kinds.values()))


def _parameters(kind: str, law: Any) -> str:
    from pestle.bench.setup import DENSITY, SOLID, Parameter, _of_field

    own = {f.name: _of_field(f) for f in dataclasses.fields(law)}
    known: dict[str, Parameter] = own
    if kind == "pair":
        known = {**SOLID, "density": DENSITY, **own}
    where = words()["where"]
    rows = []
    for name, each in known.items():
        default = "required" if each.required else f"{each.default}"
        text = each.text or name.replace("_", " ")
        unit = "-" if each.unit == "1" else each.unit
        rows.append((code(name), text, unit, default, where[name]))
    header = ("parameter", "meaning", "unit", "default", "where to get it")
    return table(header, rows)


def _maturity(card: dict[str, Any]) -> str:
    rows = []
    for key, title in MATURITY.items():
        text = card.get(key, "")
        if key == "reference" and card["features"]:
            count = sum(number for _, number, _ in _cases(card))
            text = f"{count} cases from outside this package"
        rows.append((title, _plain(text) or "not checked"))
    return table(("against", "how"), rows)


@cache
def _file(name: str) -> list[dict[str, Any]]:
    text = (REFERENCE / f"{name}.json").read_text(encoding="utf-8")
    return list(json.loads(text)["cases"])


def _cases(card: dict[str, Any]) -> list[tuple[str, int, float]]:
    found = []
    for file, feature in card["features"]:
        cases = [case for case in _file(file) if case["feature"] == feature]
        found.append((f"{file}: {feature}", len(cases), max(c["rtol"] for c in cases)))
    return found


def _reference(card: dict[str, Any]) -> list[tuple[str, str, str]]:
    return [(code(name), str(n), f"{rtol:g}") for name, n, rtol in _cases(card)]


def _cost_of(name: str) -> float | None:
    known = costs()
    return known.get(name, known.get(f"shahin2021+{name}"))


def _cost(name: str, kinds: dict[str, Any]) -> str:
    cost = _cost_of(name)
    assert cost is not None
    what = "a contact" if name in costs() and "pair" in kinds else "a point of a curve"
    if name == "zunker2024":
        what = "a point of the exact solver; the engine's law: `benchmarks/engine.py`"
    return f"{cost:g} ns {what}, one core, `python benchmarks/bench.py`."


def _cited(text: str) -> list[str]:
    """Entries of BibTeX as sentences."""
    found = []
    for entry in re.split(r"\n(?=@)", text):
        field = dict(re.findall(r"(\w+)\s*=\s*\{((?:[^{}]|\{[^{}]*\})*)\}", entry))
        authors = field.get("author", "").replace(" and ", "; ")
        where = field.get("journal", field.get("school", ""))
        numbers = ", ".join(field[k] for k in ("volume", "pages") if k in field)
        doi = f" [doi](https://doi.org/{field['doi']})" if "doi" in field else ""
        parts = [f"{authors} ({field['year']})", field["title"], f"{where} {numbers}"]
        found.append(". ".join(part.strip() for part in parts) + f".{doi}")
    return found


def _plain(text: str) -> str:
    """Text in which an asterisk is one."""
    return re.sub(r"(?<!\\)\*", r"\\*", text)


def _sentence(text: str) -> str:
    clean = " ".join(text.split())
    return clean[:1].upper() + clean[1:] + ("" if clean.endswith((".", "!")) else ".")


def markdown(text: str) -> str:
    """Docstring in reST as Markdown; formulas that cannot be set stay as code."""
    blocks, lines = [], text.split("\n")
    while lines:
        line = lines.pop(0)
        match = re.match(r"^\.\. math::\s*(.*)$", line.strip())
        if not match:
            blocks.append(_inline(line))
            continue
        body = [match[1]]
        while lines and (not lines[0].strip() or lines[0].startswith("    ")):
            body.append(lines.pop(0))
        blocks.append("\n" + formula(textwrap.dedent("\n".join(body)).strip()) + "\n")
    return "\n".join(blocks)


def _inline(line: str) -> str:
    line = re.sub(r":math:`([^`]*)`", r"$\1$", line)
    line = re.sub(r"``([^`]*)``", r"`\1`", line)
    pieces = re.split(r"(\$[^$]*\$|`[^`]*`)", line)
    return "".join(p if p[:1] in ("$", "`") else _plain(p) for p in pieces)


def formula(tex: str) -> str:
    """Displayed formula, a line for each of its own."""
    shown = []
    for line in _lines(tex):
        number = re.search(r"\\tag\{([^}]*)\}", line)
        clean = re.sub(r"\\tag\{[^}]*\}", "", line)
        clean = " ".join(clean.replace("&", " ").split()).rstrip(",")
        clean = re.sub(r"\\,|\\;", r"\\ ", clean)
        label = rf"\quad \mathrm{{({number[1]})}}" if number else ""
        label = label.replace(" ", r"\ ").replace(r"\quad\ ", r"\quad ")
        if is_formula(braced(clean + label)):
            shown.append(f"$$ {clean}{label} $$")
        else:
            shown.append(f"```latex\n{line.strip()}\n```")
    return "\n\n".join(shown)


def _lines(tex: str) -> list[str]:
    """Lines of a formula; cases become a line each."""
    match = re.search(r"^(.*?)\\begin\{cases\}(.*?)\\end\{cases\}(.*)$", tex, re.DOTALL)
    if match is None:
        return [line for line in re.split(r"\\\\", tex) if line.strip()]
    before, inner, after = match.groups()
    rows = [row.partition("&") for row in re.split(r"\\\\", inner)]
    lines = [
        f"{before.strip()} {value.strip()} \\quad ({condition.strip()})"
        for value, _, condition in rows
    ]
    tag = re.search(r"\\tag\{[^}]*\}", after)
    rest = re.sub(r"\\tag\{[^}]*\}", "", after).strip().lstrip(",")
    lines[-1] += tag[0] if tag else ""
    return [*lines, *([rest] if rest.strip() else [])]


def write(folder: Path) -> None:
    """Write every card and figure that has changed."""
    folder.mkdir(exist_ok=True)
    for name in names():
        path, text = folder / f"{name}.md", page(name)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            figure(name).savefig(folder / f"{name}.svg")
