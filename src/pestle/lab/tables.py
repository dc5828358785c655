"""Small tables of a study, five digits each: what figures are drawn from."""

import csv
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from pestle.lab.first_yield import first_yield

Row = dict[str, float]
Results = Sequence[Mapping[str, Any]]

_GROWTH = 0.009
"""Least growth of the root of the depth between two rows of a loading [R^(1/2)]."""


def write(study: str, results: Results, folder: Path, note: str) -> list[Path]:
    """Write the tables of a study and return where they are.

    Parameters
    ----------
    study : str
        Name of the study, the first part of the file names.
    results : sequence of mapping
        What `run_study` returns.
    folder : Path
        Where to write; it is made.
    note : str
        Where the numbers come from, the first line of every file.
    """
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, rows in TABLES[study].items():
        path = folder / f"{study}_{name}.csv"
        if name != "first_yield" or not path.exists():  # does not rest on the results
            save(path, rows(results), note)
        written.append(path)
    return written


def save(path: Path, rows: Iterable[Row], note: str) -> None:
    """Write rows with equal keys below a note; the file appears in one piece."""
    found = list(rows)
    draft = path.with_name(path.name + ".new")
    with draft.open("w", newline="", encoding="utf-8") as file:
        file.write(f"# {note}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(found[0] if found else ())
        writer.writerows([f"{value:.5g}" for value in row.values()] for row in found)
    draft.replace(path)


def unloading(results: Results) -> Iterator[Row]:
    """One row for each unloading: the power law and the relaxed sphere."""
    names = ("dmax_R", "d0_R", "rho", "alpha", "R2", "Fmax_ER2", "amax_R")
    for result in results:
        for row in result["unloading"]:
            yield {
                **_material(result),
                **{name: row[name] for name in names},
                "r_peak_R": row["r_peak_R"],
                "dimple_R": row["dimple_R"],
            }


def loading(results: Results) -> Iterator[Row]:
    """Steps of the loadings, thinned."""
    names = ("d_R", "F_ER2", "A_piR2", "r_in", "r_out", "elastic_ER3", "plastic_ER3")
    for result in results:
        for row in _thinned(result.get("loading", ())):
            yield {**_material(result), **{name: row[name] for name in names}}


def hardened(results: Results) -> Iterator[Row]:
    """Steps of loadings that differ in hardening as well."""
    for result in results:
        for row in loading([result]):
            yield {"exponent": result["case"]["exponent"], **row}


def confined(configuration: str) -> Callable[[Results], Iterator[Row]]:
    """Steps of the compactions of a configuration, thinned."""

    def rows(results: Results) -> Iterator[Row]:
        for result in results:
            if result["case"].get("configuration") == configuration:
                for row in _thinned(result["confined"]):
                    yield {**_material(result), **row}

    return rows


def _thinned(rows: Sequence[Row]) -> Iterator[Row]:
    root = 0.0
    for row in rows:
        if row is rows[-1] or row["d_R"] ** 0.5 >= root + _GROWTH:
            root = row["d_R"] ** 0.5
            yield row


def paths(results: Results) -> Iterator[Row]:
    """Unloadings step by step: from the largest depth, and of E/Y = 10 from all."""
    for result in results:
        for row in result["unloading"]:
            end = row is result["unloading"][-1]
            if end or (result["modulus_ratio"] == 10.0 and row["dmax_R"] >= 0.1):
                for depth, force, radius, elastic in row["path"]:
                    yield {
                        **_material(result),
                        "dmax_R": row["dmax_R"],
                        "d_R": depth,
                        "F_ER2": force,
                        "a_R": radius,
                        "elastic_ER3": elastic,
                    }


def first_yields(results: Results) -> Iterator[Row]:
    """Depth of first yield for the materials of the study."""
    for nu in sorted({result["poisson_ratio"] for result in results}):
        ratios = {r["modulus_ratio"] for r in results if r["poisson_ratio"] == nu}
        for found in first_yield(nu, sorted(ratios)):
            yield {
                "modulus_ratio": found.modulus_ratio,
                "poisson_ratio": nu,
                "depth_R": found.depth,
                "height_a": found.height,
            }


def pressure(results: Results) -> Iterator[Row]:
    """Pressure at the nodes in contact before each unloading."""
    yield from _profiles(results, "pressure", "p_Y")


def relaxed(results: Results) -> Iterator[Row]:
    """Height of the relaxed surface at the nodes that were in contact."""
    yield from _profiles(results, "relaxed", "z_R")


def _profiles(results: Results, key: str, name: str) -> Iterator[Row]:
    for result in results:
        for row in result["unloading"]:
            for r, value in row[key]:
                if r <= row["amax_R"]:
                    yield {
                        **_material(result),
                        "dmax_R": row["dmax_R"],
                        "r_R": r,
                        name: value,
                    }


def _material(result: Mapping[str, Any]) -> Row:
    return {
        "modulus_ratio": result["modulus_ratio"],
        "poisson_ratio": result["poisson_ratio"],
    }


def _usual(rows: Callable[[Results], Iterator[Row]]) -> Callable[..., Iterator[Row]]:
    """Only the Poisson ratio of most figures, 0.3."""
    return lambda results: rows([r for r in results if r["poisson_ratio"] == 0.3])


TABLES: dict[str, dict[str, Callable[[Results], Iterator[Row]]]] = {
    "edmans2020": {
        "unloading": unloading,
        "loading": _usual(loading),
        "paths": _usual(paths),
        "first_yield": first_yields,
    },
    "zunker2024": {
        "unloading": unloading,
        "loading": loading,
        "pressure": _usual(pressure),
        "relaxed": _usual(relaxed),
    },
    "shahin2021": {"loading": hardened},
    "shahin2021-materials": {
        "simple": loading,
        "die": confined("die"),
        "hydrostatic": confined("hydrostatic"),
    },
}
"""Tables of a study, by the second part of their names."""
