"""The metrics with their definitions, read from the source that makes them."""

import ast
from collections.abc import Iterator

from error_ids import SOURCE, words_of
from pieces import code, table

Row = tuple[str, str, str, str]
_HEADER = ("key in `metrics.json`", "name in the report", "unit", "definition")


def page() -> str:
    """Return a table for every heading of the report."""
    parts = []
    groups: dict[str, list[Row]] = {}
    for path in sorted((SOURCE / "metrics").glob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = dict(_groups(tree))
        for function in ast.walk(tree):
            if isinstance(function, ast.FunctionDef):
                for group, row in _metrics(function, names):
                    rows = groups.setdefault(group, [])
                    rows += [row] if row not in rows else []
    for group, rows in groups.items():
        parts += [f"## {group}\n", table(_HEADER, rows)]
    return "\n".join(parts)


def _groups(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Variable and heading of every ``_NAME = Group("Heading")``."""
    for node in tree.body:
        if (
            isinstance(node, ast.Assign)
            and isinstance(node.value, ast.Call)
            and getattr(node.value.func, "id", "") == "Group"
        ):
            yield getattr(node.targets[0], "id", ""), words_of(node.value.args[0], {})


def _metrics(
    function: ast.FunctionDef, groups: dict[str, str]
) -> Iterator[tuple[str, Row]]:
    makers = dict(_makers(function, groups))
    for node in ast.walk(function):
        if not isinstance(node, ast.Call) or len(node.args) < 3:
            continue
        group = groups.get(_owner(node.func) or "") or makers.get(
            getattr(node.func, "id", "")
        )
        given = {keyword.arg: keyword.value for keyword in node.keywords}
        if group is None or "definition" not in given:
            continue
        key, label = (_named(part) for part in node.args[:2])
        unit = words_of(given.get("unit"), {})
        yield group, (code(key), label, unit, words_of(given["definition"], {}))


def _makers(
    function: ast.FunctionDef, groups: dict[str, str]
) -> Iterator[tuple[str, str]]:
    """Local names for a group's ``metric``, also from ``make, found = ..., []``."""
    for node in ast.walk(function):
        if not isinstance(node, ast.Assign):
            continue
        target, value = node.targets[0], node.value
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            target, value = target.elts[0], value.elts[0]
        owner = _owner(value)
        if isinstance(target, ast.Name) and owner in groups:
            yield target.id, groups[owner]


def _owner(node: ast.expr) -> str | None:
    """``_GROUP`` of an expression ``_GROUP.metric``."""
    if isinstance(node, ast.Attribute) and node.attr == "metric":
        return getattr(node.value, "id", None)
    return None


def _named(node: ast.expr) -> str:
    """Text of a key or label, with the names of what is filled in."""
    if isinstance(node, ast.JoinedStr):
        return "".join(
            str(part.value)
            if isinstance(part, ast.Constant)
            else f"{{{ast.unparse(part.value)}}}"
            for part in node.values
            if isinstance(part, ast.Constant | ast.FormattedValue)
        )
    return words_of(node, {})
