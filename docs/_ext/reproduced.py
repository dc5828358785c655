"""Figures and tables of papers that `pestle reproduce` recomputes."""

from pieces import code, table


def page() -> str:
    """Return a table of all items of all papers."""
    from pestle.reproduce import PAPERS

    rows = [
        (paper.name, item.key.replace("-", " "), item.title)
        for paper in PAPERS.values()
        for item in paper.ordered()
    ]
    return table(
        ("paper", "figure or table", "what"), [(code(p), k, t) for p, k, t in rows]
    )
