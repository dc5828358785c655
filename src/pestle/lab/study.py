"""Grids of experiments that published laws rest on: run on all cores, resumed at will.

Every case is a loading with several unloadings and one file, written in one piece: a
study that was killed goes on with what is missing.
"""

import json
import os
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pestle.errors import InputError, did_you_mean
from pestle.lab.confined import Confined, ConfinedStop
from pestle.lab.material import Hardening, Material
from pestle.lab.measure import pressure_profile, profile
from pestle.lab.press import Result, press

EDMANS_DEPTHS = (
    *(0.01, 0.02, 0.03, 0.04, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5),
)
EDMANS_RATIOS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
POISSONS = (0.0, 0.15, 0.3, 0.45)
ZUNKER_RATIOS = (6.25, 12.5, 25.0, 50.0, 100.0, 200.0)
ZUNKER_DEPTHS = tuple(round(0.05 * k, 2) for k in range(1, 11))
SHAHIN_RATIOS = (100.0, 300.0, 1000.0, 3000.0)
SHAHIN_EXPONENTS = (0.0, 0.25, 0.5, 0.75, 1.0)
SHAHIN_REFERENCE = 0.001
"""Plastic strain of the first yield stress, for sigma = kappa strain^(1/m)."""
SHAHIN_MATERIALS: dict[str, list[tuple[float, float]]] = {
    "simple": [
        (102.36, 0.413),
        (301.48, 0.4739),
        (1099.3, 0.427),
        (2104.2, 0.4709),
        (4946.3, 0.4078),
    ],
    "die": [
        (154.82, 0.2251),
        (530.61, 0.2001),
        (922.0, 0.344),
        (2643.8, 0.2933),
        (4712.9, 0.2204),
    ],
    "hydrostatic": [
        (112.09, 0.2099),
        (469.22, 0.2418),
        (1287.1, 0.337),
        (2839.9, 0.2976),
        (4628.9, 0.4576),
    ],
}
"""E/Y and nu of five materials of his Table A.1: the smallest E/(1 - nu^2)Y, the
largest, and three between them by rank."""
SHAHIN_ENDS = {"die": 0.46, "hydrostatic": 0.185}
"""Ends of the compactions [R]."""


@dataclass(frozen=True)
class Case:
    """One experiment of a study.

    Parameters
    ----------
    modulus_ratio, poisson_ratio : float
        E/Y and nu [-].
    unload : tuple of float
        Depths to unload from; the last one is the end of the loading [R].
    exponent : float
        Exponent of power-law hardening [-].
    reference : float, optional
        Its reference strain [-].
    mesh : str
        Name of the mesh.
    """

    modulus_ratio: float
    poisson_ratio: float
    unload: tuple[float, ...]
    exponent: float = 0.0
    reference: float | None = None
    mesh: str = "coarse"

    @property
    def name(self) -> str:
        """Name of its file, without the ending."""
        hard = f"_n{self.exponent:g}" if self.exponent else ""
        return f"E{self.modulus_ratio:g}_nu{self.poisson_ratio:g}{hard}_{self.mesh}"

    @property
    def cost(self) -> float:
        """Estimate of the processor time, for the order and the time left [s]."""
        return 4.0 + 0.9 * len(self.unload) + 0.03 * self.modulus_ratio

    def run(self) -> Result:
        """Press and unload the sphere."""
        hardening = Hardening(self.exponent, self.reference)
        material = Material(self.modulus_ratio, self.poisson_ratio, hardening)
        return press(material, self.unload[-1], self.unload, mesh=self.mesh)

    def compute(self) -> dict[str, Any]:
        """Compute it: what its file holds."""
        return describe(self.run())


@dataclass(frozen=True)
class ConfinedCase:
    """One compaction between six flats.

    Parameters
    ----------
    configuration : str
        "die" or "hydrostatic".
    modulus_ratio, poisson_ratio : float
        E/Y and nu [-].
    depth : float
        Displacement of the moving flats at the end [R].
    edges : int
        See `octant`.
    """

    configuration: str
    modulus_ratio: float
    poisson_ratio: float
    depth: float
    edges: int = 8

    @property
    def name(self) -> str:
        """Name of its file, without the ending."""
        material = f"E{self.modulus_ratio:g}_nu{self.poisson_ratio:g}"
        return f"{self.configuration}_{material}_{self.edges}"

    @property
    def cost(self) -> float:
        """Estimate of the processor time, for the order and the time left [s]."""
        return 8.0 * (self.edges / 6.0) ** 6

    def compute(self) -> dict[str, Any]:
        """Compute it: what its file holds."""
        start, stopped = time.process_time(), None
        material = Material(self.modulus_ratio, self.poisson_ratio)
        case = Confined(
            material, self.configuration, edges=self.edges, layers=self.edges
        )
        try:
            points = case.load(self.depth)
        except ConfinedStop as error:
            points, stopped = error.points, str(error)
        rows = [
            {
                "d_R": point.depth,
                **{f"F1_{k}": v for k, v in point.primary._asdict().items()},
                **{f"F2_{k}": v for k, v in point.secondary._asdict().items()},
            }
            for point in points
        ]
        return {
            "modulus_ratio": self.modulus_ratio,
            "poisson_ratio": self.poisson_ratio,
            "elements": len(case.mesh.cells),
            "reached_R": points[-1].depth if points else 0.0,
            "stopped": stopped,
            "cpu_s": time.process_time() - start,
            "confined": rows,
        }


AnyCase = Case | ConfinedCase


def cases(study: str, *, subset: bool = False, mesh: str = "coarse") -> list[AnyCase]:
    """Cases of a study, those that take longest first.

    Parameters
    ----------
    study : {"edmans2020", "zunker2024", "shahin2021", "shahin2021-materials"}
        Whose grid.
    subset : bool
        Only a few cases, for a first look in a minute or two.
    mesh : str
        Name of the mesh.

    Examples
    --------
    >>> sum(len(case.unload) for case in cases("edmans2020"))
    560
    """
    if study not in STUDIES:
        raise InputError(
            "unknown-study",
            f'there is no study "{study}"',
            "STUDY",
            did_you_mean(study, STUDIES),
        )
    return sorted(STUDIES[study](subset, mesh), key=lambda case: -case.cost)


def _edmans(subset: bool, mesh: str) -> list[AnyCase]:
    ratios = (2.0, 20.0, 200.0) if subset else EDMANS_RATIOS
    poissons = (0.0, 0.3) if subset else POISSONS
    depths = (0.02, 0.1, 0.3, 0.5) if subset else EDMANS_DEPTHS
    return [Case(e, nu, depths, mesh=mesh) for e in ratios for nu in poissons]


def _zunker(subset: bool, mesh: str) -> list[AnyCase]:
    ratios = (12.5, 200.0) if subset else ZUNKER_RATIOS
    depths = (0.1, 0.3, 0.5) if subset else ZUNKER_DEPTHS
    poissons = () if subset else (0.0, 0.15, 0.45)
    grid: list[AnyCase] = [Case(e, 0.3, depths, mesh=mesh) for e in ratios]
    return grid + [Case(50.0, nu, depths, mesh=mesh) for nu in poissons]


def _shahin(subset: bool, mesh: str) -> list[AnyCase]:
    ratios = (300.0,) if subset else SHAHIN_RATIOS
    exponents = (0.0, 0.5) if subset else SHAHIN_EXPONENTS
    return [
        Case(e, 0.3, (0.5,), h, SHAHIN_REFERENCE if h else None, mesh)
        for e in ratios
        for h in exponents
        if h == 0.0 or e <= 1000.0
    ]


def _materials(subset: bool, mesh: str) -> list[AnyCase]:
    """Five materials of Table A.1 for each configuration; 864 bricks, or 2048."""
    some = slice(None, 1) if subset else slice(None)
    edges = {"coarse": 6, "medium": 8}.get(mesh, 10)
    simple: list[AnyCase] = [
        Case(e, nu, (0.5,), mesh=mesh) for e, nu in SHAHIN_MATERIALS["simple"][some]
    ]
    return simple + [
        ConfinedCase(kind, e, nu, depth, edges)
        for kind, depth in SHAHIN_ENDS.items()
        for e, nu in SHAHIN_MATERIALS[kind][some]
    ]


STUDIES: dict[str, Callable[[bool, str], list[AnyCase]]] = {
    "edmans2020": _edmans,
    "zunker2024": _zunker,
    "shahin2021": _shahin,
    "shahin2021-materials": _materials,
}


@dataclass(frozen=True)
class StudyProgress:
    """How far a study is.

    Parameters
    ----------
    done, total : int
        Cases.
    name : str
        The one that ended last.
    left : float
        Estimate of the time left [s].
    """

    done: int
    total: int
    name: str
    left: float


def run_study(
    grid: list[AnyCase],
    folder: Path,
    *,
    workers: int | None = None,
    progress: Callable[[StudyProgress], None] | None = None,
) -> list[dict[str, Any]]:
    """Compute what is missing of a grid and return all its cases.

    Parameters
    ----------
    grid : list of Case or ConfinedCase
        The cases.
    folder : Path
        Where their files are, or will be.
    workers : int, optional
        Number of processes, by default one for each core.
    progress : callable, optional
        Called after every case.

    Returns
    -------
    list of dict
        What `describe` says about every case, in the order of the grid.
    """
    place = folder / "cases"
    place.mkdir(parents=True, exist_ok=True)
    found = {case: stored(case, place) for case in grid}
    missing = [case for case in grid if found[case] is None]
    cost = sum(case.cost for case in missing)
    start, spent = time.monotonic(), 0.0
    for case in _computed(missing, place, workers or os.cpu_count() or 1):
        found[case] = stored(case, place)
        spent += case.cost
        left = (time.monotonic() - start) * (cost / spent - 1.0)
        done = sum(entry is not None for entry in found.values())
        if progress:
            progress(StudyProgress(done, len(grid), case.name, left))
    return [entry for entry in found.values() if entry is not None]


def _computed(missing: list[AnyCase], place: Path, workers: int) -> Iterator[AnyCase]:
    """Compute cases and write their files; yields each when it is there."""
    if workers == 1:
        for case in missing:
            yield _compute((case, place))
        return
    import multiprocessing

    # each process has one thread: small systems gain nothing from more
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    context = multiprocessing.get_context("spawn")
    with context.Pool(min(workers, max(len(missing), 1)), _leave_ctrl_c) as pool:
        jobs = [(case, place) for case in missing]
        yield from pool.imap_unordered(_compute, jobs)


def _leave_ctrl_c() -> None:
    """Ctrl-C is for the process that writes to the screen; it ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _compute(job: tuple[AnyCase, Path]) -> AnyCase:
    case, place = job
    text = json.dumps({"case": asdict(case), **case.compute()})
    draft = place / f"{case.name}.json.{os.getpid()}"
    draft.write_text(text, encoding="utf-8")
    draft.replace(place / f"{case.name}.json")
    return case


def stored(case: AnyCase, place: Path) -> dict[str, Any] | None:
    """What is stored of a case, unless it was another one or the file is broken."""
    path = place / f"{case.name}.json"
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):
        return None
    same = json.loads(json.dumps(asdict(case))) == data.get("case")
    return data if same else None


def describe(result: Result) -> dict[str, Any]:
    """Numbers of an experiment with pressure and relaxed profiles of each branch."""
    numbers = result.to_dict()
    mesh = result.sphere.mesh
    for row, branch in zip(numbers["unloading"], result.branches, strict=True):
        top = branch.start.equilibrium
        r, p = pressure_profile(mesh, top.u, top.pushes, top.active)
        radius, height = profile(mesh, branch.relaxed.equilibrium.u)
        row["amax_R"] = branch.start.radius[0]
        row["amax_in_R"] = branch.start.radius[1]
        row["path"] = [[q.depth, q.force, q.radius, q.elastic] for q in branch.points]
        row["pressure"] = np.column_stack(
            [r, p * result.sphere.material.modulus_ratio]
        ).tolist()
        row["relaxed"] = np.column_stack([radius, height - height.min()]).tolist()
    return numbers
