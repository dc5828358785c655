"""The same sphere by CalculiX (G. Dhondt, K. Wittig): input file, run, forces.

Mesh and material are those of the lab; elements (four-node axisymmetric, or eight-node
bricks), plasticity and solver are CalculiX's.  A flat is one dummy node for each node
of the surface, with a gap element of fixed direction between the two: contact without
friction and, but for the spring of a closed gap, without penetration.  CalculiX yields
on the Kirchhoff stress, the lab on the Cauchy stress: they part where elastic changes
of volume are large, at small E/Y.
"""

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pestle.errors import InputError, SimulationError
from pestle.lab.assembly import Booleans
from pestle.lab.material import Material
from pestle.lab.mesh import Floats, Integers

PROGRAM = "ccx"
INSTALL = "Debian and Ubuntu: apt install calculix-ccx"
MODULUS = 1e5
"""Young's modulus in the input file: CalculiX takes residuals of 1e-6 for nothing."""
SPRING = 5000.0
"""Stiffness of a closed gap, as a pressure over a penetration [E/R]."""
_REST = 1e-12  # tension of an open gap, over the force of one closed by R
_STRAINS = (*np.geomspace(1e-4, 10.0, 60),)
_POINTS = 400  # of the table of a path
_CARE = "1e-6,1e-4,,,1e-6,1e-6"  # residuals and corrections of a converged step
_PATIENCE = "10,20,20,60,25,4,,20"  # iterations and cutbacks before CalculiX gives up


@dataclass(frozen=True, eq=False)
class Flat:
    """A flat and the nodes that it may touch.

    Parameters
    ----------
    nodes : array
        Nodes of the surface.
    axis : int
        The axis that it stands on.
    side : int
        1 or -1: the direction in which it pushes.
    clearances, areas : array
        Distance of each node from the flat before, area that belongs to it [R, R^2].
    moves : bool
        Whether it moves.
    """

    nodes: Integers
    axis: int
    side: int
    clearances: Floats
    areas: Floats
    moves: bool


@dataclass(frozen=True, eq=False)
class Model:
    """What CalculiX computes.

    Parameters
    ----------
    points : array (nodes, 2 or 3)
        Coordinates [R].
    cells : array
        Nodes of each element in the order of CalculiX.
    element : {"CAX4", "C3D8"}
        Kind of element.
    held : array (nodes, 2 or 3) of bool
        Displacements that are zero.
    flats : tuple of Flat
        All flats.
    share : float
        Part of a flat's force that the model has [-].
    """

    points: Floats
    cells: Integers
    element: str
    held: Booleans
    flats: tuple[Flat, ...]
    share: float


@dataclass(frozen=True, eq=False)
class Leg:
    """A part of the path: depths at equal times, and the longest step.

    Parameters
    ----------
    depths : array
        Depths of the moving flats, from the end of the leg before [R].
    longest : float
        Longest step as a part of the leg [-].
    """

    depths: Floats
    longest: float

    @classmethod
    def loading(cls, depth: float, growth: float) -> "Leg":
        """From nothing, sqrt(2 depth) growing by `growth` in a step."""
        t = np.linspace(0.0, 1.0, _POINTS + 1)
        return cls(depth * t**2, min(growth / float(np.sqrt(2.0 * depth)), 1.0))

    @classmethod
    def unloading(cls, start: float, end: float, steps: int) -> "Leg":
        """Equal steps back."""
        return cls(np.array([start, end]), 1.0 / steps)


@dataclass(frozen=True, eq=False)
class Answer:
    """What CalculiX found.

    Parameters
    ----------
    depths : tuple of array
        Depths of the steps, an array for each leg [R].
    forces : tuple of array
        Forces of the whole flats, a row a step and a column a flat [E R^2].
    heights : array
        Of the nodes of the first flat at the end, along its axis [R].
    stopped : str
        Why it ended early, empty if it did not.
    """

    depths: tuple[Floats, ...]
    forces: tuple[Floats, ...]
    heights: Floats
    stopped: str


def available() -> bool:
    """Whether CalculiX is installed."""
    return shutil.which(PROGRAM) is not None


def solve(model: Model, material: Material, legs: Sequence[Leg]) -> Answer:
    """Run CalculiX on one core.

    Parameters
    ----------
    model : Model
        Mesh and flats.
    material : Material
        The material.
    legs : sequence of Leg
        The path of the moving flats.

    Raises
    ------
    InputError
        If CalculiX is not installed.
    SimulationError
        If it cannot read its input or finds no first step.
    """
    program = shutil.which(PROGRAM)
    if program is None:
        raise InputError(
            "no-calculix",
            "CalculiX (ccx) is not installed",
            hint=INSTALL,
        )
    with tempfile.TemporaryDirectory() as folder:
        name = Path(folder) / "sphere"
        text = deck(model, material, legs)
        name.with_suffix(".inp").write_text(text, encoding="ascii")
        done = subprocess.run(
            [program, name.name],
            cwd=folder,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            check=False,
        )
        printed = name.with_suffix(".dat")
        found = printed.read_text() if printed.exists() else ""
    reason = re.search(r"\*ERROR[^:]*:?\s*(.+)", done.stdout)
    stopped = reason[1].strip() if reason else ""
    if done.returncode and not stopped:
        stopped = f"it ended with status {done.returncode}"
    if "total force" not in found:
        raise SimulationError("calculix-failed", f"CalculiX found nothing: {stopped}")
    return _answer(found, model, legs, stopped)


def deck(model: Model, material: Material, legs: Sequence[Leg]) -> str:
    """Input file."""
    count, size = model.points.shape
    lines = ["*NODE"]
    lines += [_line(i + 1, *x) for i, x in enumerate(model.points)]
    lines.append(f"*ELEMENT, TYPE={model.element}, ELSET=ALL")
    lines += [_line(i + 1, *(c + 1)) for i, c in enumerate(model.cells)]
    first, element = count + 1, len(model.cells) + 1
    for number, flat in enumerate(model.flats):
        lines += _flat(model, flat, number, first, element)
        first, element = first + len(flat.nodes), element + len(flat.nodes)
    lines.append("*NSET, NSET=SURFACE")
    lines += [f"{node + 1}," for node in model.flats[0].nodes]
    lines += ["*MATERIAL, NAME=POWDER", "*ELASTIC"]
    lines += [_line(MODULUS, material.poisson_ratio), "*PLASTIC"]
    strains = np.array([0.0, *_STRAINS])
    flow = MODULUS * material.flow_stress(strains) * (1.0 + 1e-5 * strains)
    lines += [_line(s, e) for e, s in zip(strains, flow, strict=True)]
    lines.append("*SOLID SECTION, ELSET=ALL, MATERIAL=POWDER")
    lines.append("*BOUNDARY")
    for axis in range(size):
        nodes = np.flatnonzero(model.held[:, axis])
        lines += [f"{node + 1},{axis + 1},{axis + 1}" for node in nodes]
    lines += [f"FLAT{k},1,3" for k in range(len(model.flats))]
    for k, leg in enumerate(legs):
        lines += [f"*AMPLITUDE, NAME=PATH{k}"]
        times = np.linspace(0.0, 1.0, len(leg.depths))
        lines += [_line(t, d) for t, d in zip(times, leg.depths, strict=True)]
    for k, leg in enumerate(legs):
        lines += _step(model, leg, k)
    return "\n".join(lines) + "\n"


def _flat(model: Model, flat: Flat, number: int, first: int, element: int) -> list[str]:
    """Dummy nodes and gap elements of a flat."""
    place = np.zeros((len(flat.nodes), 3))
    place[:, : model.points.shape[1]] = model.points[flat.nodes]
    place[:, flat.axis] -= flat.side * flat.clearances
    lines = [f"*NODE, NSET=FLAT{number}"]
    lines += [_line(first + k, *x) for k, x in enumerate(place)]
    normal = np.zeros(3)
    normal[flat.axis] = flat.side
    for k, node in enumerate(flat.nodes):
        spring = SPRING * MODULUS * model.share * flat.areas[k]
        name = f"GAP{element + k}"
        lines += [
            f"*ELEMENT, TYPE=GAPUNI, ELSET={name}",
            _line(element + k, first + k, node + 1),
            f"*GAP, ELSET={name}",
            f"{_line(flat.clearances[k], *normal)},,{_line(spring, _REST * spring)}",
        ]
    return lines


def _step(model: Model, leg: Leg, number: int) -> list[str]:
    lines = [
        "*STEP, NLGEOM, INC=100000",
        "*CONTROLS, PARAMETERS=TIME INCREMENTATION",
        _PATIENCE,
        "*CONTROLS, PARAMETERS=FIELD",
        _CARE,
        "*STATIC",
        _line(leg.longest, 1.0, 1e-6, leg.longest),
        f"*BOUNDARY, AMPLITUDE=PATH{number}",
    ]
    for k, flat in enumerate(model.flats):
        if flat.moves:
            lines.append(f"FLAT{k},{flat.axis + 1},{flat.axis + 1},{flat.side}")
    for k in range(len(model.flats)):
        lines += [f"*NODE PRINT, NSET=FLAT{k}, TOTALS=ONLY", "RF"]
    return [*lines, "*NODE PRINT, NSET=SURFACE", "U", "*END STEP"]


def _line(*values: float) -> str:
    return ",".join(f"{value:.12g}" for value in values)


def _answer(text: str, model: Model, legs: Sequence[Leg], stopped: str) -> Answer:
    """Read the forces of every step and the displacements at the end."""
    number = r"([-+.\dE]+)"
    total = rf"set FLAT(\d+) and time\s+{number}\s+{number}\s+{number}\s+{number}"
    steps: dict[float, Floats] = {}
    for match in re.finditer(total, text):
        row = steps.setdefault(float(match[2]), np.zeros(len(model.flats)))
        flat = model.flats[int(match[1])]
        force = float(match[3 + flat.axis]) * flat.side
        row[int(match[1])] = force / (model.share * MODULUS)
    times = np.array(list(steps))
    forces = np.array(list(steps.values()))
    depths, parts = [], []
    for k, leg in enumerate(legs):
        rows = (times > k + 1e-9) & (times <= k + 1 + 1e-9)
        at = np.linspace(0.0, 1.0, len(leg.depths))
        depths.append(np.interp(times[rows] - k, at, leg.depths))
        parts.append(forces[rows])
    flat = model.flats[0]
    block = text.rpartition("displacements (vx,vy,vz) for set SURFACE")[2]
    lines = block.split("\n")[2 : 2 + len(flat.nodes)]
    moved = {int(node) - 1: u for node, *u in map(str.split, lines)}
    along = np.array([float(moved[node][flat.axis]) for node in flat.nodes])
    heights = model.points[flat.nodes, flat.axis] + along
    return Answer(tuple(depths), tuple(parts), heights, stopped)
