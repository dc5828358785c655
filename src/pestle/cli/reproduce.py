"""pestle reproduce: figures and tables of the papers, recomputed."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.reproduce import Item, Paper, Result

PaperName = Annotated[
    str | None,
    typer.Argument(
        metavar="PAPER",
        help="zunker2024, shahin2021, edmans2020 or nan2022. Without one: list them.",
        show_default=False,
    ),
]
ItemName = Annotated[
    str | None,
    typer.Argument(
        metavar="FIGURE|TABLE",
        help='Such as 8, "figure 8" or "table 2.4". Without one: all of the paper.',
        show_default=False,
    ),
]


def reproduce(
    paper: PaperName = None,
    item: ItemName = None,
    out: Annotated[Path, typer.Option(help="Folder for the images and tables.")] = Path(
        "reproduced"
    ),
    kind: Annotated[
        str, typer.Option("--format", help="Of images: png, svg or pdf.")
    ] = "png",
    lab: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder of a study of `pestle lab study` to draw from, instead of the "
            "packaged results.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Recompute figures and tables of a paper, an image or table each.

    With each comes a sentence on how it agrees with print. Where our reading of an
    equation differs from the printed one, the figure shows both.
    """
    from pestle.errors import did_you_mean
    from pestle.lab import packaged
    from pestle.reproduce import PAPERS

    packaged.use(lab)
    if paper is None:
        _list(list(PAPERS.values()))
        return
    if paper not in PAPERS:
        raise InputError(
            "unknown-paper",
            f"{paper!r} is none of the papers that are recomputed",
            "PAPER",
            did_you_mean(paper, PAPERS),
        )
    if kind not in ("png", "svg", "pdf"):
        what = f"images cannot be {kind!r}"
        raise InputError("unknown-figure-format", what, "--format", "png, svg or pdf")
    chosen = PAPERS[paper]
    items = chosen.find(item) if item else chosen.ordered()
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError("unwritable", f"{out}: {error.strerror}", "--out") from None
    typer.echo(chosen.reference)
    for each in items:
        _make(chosen, each, out, kind)


def _list(papers: "list[Paper]") -> None:
    from pestle.cli.printing import print_table

    for paper in papers:
        typer.echo(f"{paper.name}: {paper.reference}")
        print_table([(f"  {each.key}", each.title) for each in paper.ordered()])
    typer.echo("`pestle reproduce PAPER [FIGURE|TABLE]` makes them")


def _make(paper: "Paper", item: "Item", out: Path, kind: str) -> None:
    from pestle.bench.table import write_table
    from pestle.cli.printing import shortened

    result = item.make()
    stem = f"{paper.name}-{item.key}".lower()
    if result.panels:
        from pestle.reproduce.draw import draw

        path = out / f"{stem}.{kind}"
        try:
            draw(result).savefig(path, dpi=200)
        except OSError as error:
            raise InputError(
                "unwritable", f"{path}: {error.strerror}", "--out"
            ) from None
    else:
        path = out / f"{stem}.csv"
        write_table(path, result.columns)
    typer.echo(f"\n{item.key}, {item.title}: {shortened(path)}")
    if result.columns:
        _print_columns(result)
    typer.echo(f"  {result.said}")


def _print_columns(result: "Result") -> None:
    from pestle.cli.printing import print_table

    rows = zip(*result.columns.values(), strict=True)
    shown = [[f"  {_cell(cell)}" for cell in row] for row in rows]
    print_table([[f"  {name}" for name in result.columns], *shown])


def _cell(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
