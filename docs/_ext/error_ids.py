"""The page of error ids: every place in the source that raises one is found and shown.

The syntax tree is read, nothing is run: an id is the first argument of one of the error
classes or of `problem`, or stands in one of the few helpers named below.
"""

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pieces import code

import pestle

SOURCE = Path(pestle.__file__).parent
ID = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
EXIT_CODES = {"InputError": 2, "problem": 2, "SimulationError": 1, "PestleError": 1}
_KINDS = ("step", "kind")  # what translate.py writes behind "unknown-"


@dataclass(frozen=True)
class Place:
    """Where an id is raised, and with which words."""

    id: str
    exit_code: int
    module: str
    what: str
    hint: str


def places() -> list[Place]:
    """Return every place, in the order of the files."""
    found = []
    for path in sorted(SOURCE.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        module = path.relative_to(SOURCE).as_posix()
        for scope in ast.walk(tree):
            if isinstance(scope, ast.FunctionDef):
                found += list(_in_function(scope, module))
    return sorted(set(found), key=lambda place: (place.module, place.id, place.what))


def _in_function(function: ast.FunctionDef, module: str) -> Iterator[Place]:
    assigned = [
        (node.lineno, target.id, node.value)
        for node in ast.walk(function)
        if isinstance(node, ast.Assign)
        for target in node.targets
        if isinstance(target, ast.Name)
    ]
    assigned.sort(key=lambda entry: entry[0])
    for node in ast.walk(function):
        line = getattr(node, "lineno", 0)
        local = {name: value for at, name, value in assigned if at < line}
        if isinstance(node, ast.Call):
            yield from _call(node, module, local)
        elif isinstance(node, ast.Return) and module == "config/translate.py":
            yield from _translation(node, module, local)


def _call(node: ast.Call, module: str, local: dict[str, ast.expr]) -> Iterator[Place]:
    name = getattr(node.func, "id", getattr(node.func, "attr", ""))
    if name == "read_json_object" and len(node.args) == 2:
        for text in _ids(node.args[1]):
            yield Place(text, 2, module, "the file cannot be read", "")
    if name not in EXIT_CODES or len(node.args) < 2:
        return
    given = {keyword.arg: keyword.value for keyword in node.keywords}
    hint_at = 2 if name == "problem" else 3
    hint = given.get("hint", node.args[hint_at] if len(node.args) > hint_at else None)
    for text in _ids(node.args[0]):
        words = words_of(node.args[1], local), words_of(hint, local)
        yield Place(text, EXIT_CODES[name], module, *words)


def _translation(
    node: ast.Return, module: str, local: dict[str, ast.expr]
) -> Iterator[Place]:
    if not isinstance(node.value, ast.Tuple) or len(node.value.elts) != 4:
        return
    first, _, what, hint = node.value.elts
    for text in _ids(first):
        yield Place(text, 2, module, words_of(what, local), words_of(hint, local))


def _ids(node: ast.expr) -> list[str]:
    """Ids that an expression can be."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value] if ID.fullmatch(node.value) else []
    if isinstance(node, ast.IfExp):
        return _ids(node.body) + _ids(node.orelse)
    if isinstance(node, ast.JoinedStr) and isinstance(node.values[0], ast.Constant):
        return [str(node.values[0].value) + kind for kind in _KINDS]
    return []


def words_of(node: ast.expr | None, local: dict[str, ast.expr]) -> str:
    """Text of an expression, with an ellipsis for what is filled in."""
    if isinstance(node, ast.Constant):
        return str(node.value) if isinstance(node.value, str) else ""
    if isinstance(node, ast.JoinedStr):
        return "".join(
            str(part.value) if isinstance(part, ast.Constant) else "…"
            for part in node.values
        )
    if isinstance(node, ast.Name) and node.id in local:
        rest = {name: value for name, value in local.items() if name != node.id}
        return words_of(local[node.id], rest)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return words_of(node.left, local) + words_of(node.right, local)
    if isinstance(node, ast.IfExp):
        options = words_of(node.body, local), words_of(node.orelse, local)
        return max(options, key=len)
    return "…" if node is not None and not isinstance(node, ast.Constant) else ""


def page() -> str:
    """Return a definition list of all ids, those of the input first."""
    by_id: dict[str, list[Place]] = defaultdict(list)
    for place in places():
        by_id[place.id].append(place)
    parts = []
    for exit_code, heading in (
        (2, "## Wrong input (exit code 2)\n"),
        (1, "## The run had to stop (exit code 1)\n"),
    ):
        chosen = {i: p for i, p in by_id.items() if p[0].exit_code == exit_code}
        parts.append(heading)
        parts += [_entry(name, chosen[name]) for name in sorted(chosen)]
    return "\n".join(parts)


def _entry(name: str, found: list[Place]) -> str:
    lines = [f"(error-{name})=\n\n{code(name)}"]
    for what, hint in dict.fromkeys((place.what, place.hint) for place in found):
        text = _plain(what) or "…"
        advice = f" *Hint: {_plain(hint)}*" if _plain(hint).strip("… ") else ""
        lines.append(f": {text}{advice}\n")
    modules = ", ".join(dict.fromkeys(code(place.module) for place in found))
    return "\n".join([*lines, f": Raised in {modules}.\n"])


def _plain(text: str) -> str:
    """Make Markdown's signs harmless and join neighbouring ellipses."""
    text = re.sub(r"(… ?)+…", "…", " ".join(text.split()))
    return re.sub(r"([\\*_`<\[\]#$])", r"\\\1", text)
