"""The deck: data file and script of LAMMPS, equal for the run and the export."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from pestle.lammps.model import pair_model
from pestle.lammps.motion import Leg, legs
from pestle.lammps.support import check, walls_of

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.config.geometry import CylinderWall, PlaneWall
    from pestle.config.particle_file import ParticleTable

SCRIPT, DATA, LOG = "in.lammps", "data.lammps", "log.lammps"
PARTICLES, CONTACTS = "particles.dump", "contacts.dump"
SKIN = 0.5
"""Skin of the neighbour lists over the smallest radius [-]."""
PARTICLE_COLUMNS = "id type x y z radius vx vy vz omegax omegay omegaz"
"""Columns of the dump; the force of every wall follows, three for each powder."""
AXES = "xyz"


@dataclass(frozen=True)
class Deck:
    """What LAMMPS reads.

    Parameters
    ----------
    script, data : str
        Texts of the script and of the data file.
    legs : list of Leg
        Runs of the script.
    time_step : float
        Time step [s].
    """

    script: str = field(repr=False)
    data: str = field(repr=False)
    legs: list[Leg]
    time_step: float

    def write(self, folder: Path) -> list[Path]:
        """Write script and data file into a folder; return their paths."""
        folder.mkdir(parents=True, exist_ok=True)
        paths = [folder / SCRIPT, folder / DATA]
        paths[0].write_text(self.script, encoding="utf-8")
        paths[1].write_text(self.data, encoding="utf-8")
        return paths


def make_deck(case: "Case") -> Deck:
    """Translate a case.

    Raises
    ------
    InputError
        If LAMMPS cannot do it; every reason is named.
    """
    from pestle.simulation.planning import pressed_step
    from pestle.simulation.probing import sample_of

    check(case)
    table = case.read_particles()
    dt = float(pressed_step(case, sample_of(case)))
    parts = legs(case, table, dt)
    lines = _head(case, table)
    walls = [_wall(case, name) for name in case.all_walls]
    for name in case.all_walls:
        lines.append(f"variable d_{name} equal {parts[0].formula(name, dt)}")
    lines += [line for wall in walls for line in wall]
    lines += _output(case, dt)
    for number, leg in enumerate(parts):
        if number:
            for name in case.all_walls:
                lines.append(f"variable d_{name} equal {leg.formula(name, dt)}")
        lines += _run(case, leg, parts)
    return Deck("\n".join(lines) + "\n", _data(case, table), parts, dt)


def _head(case: "Case", table: "ParticleTable") -> list[str]:
    lines = [
        f"# {case.title or 'a case'}: written by pestle for LAMMPS",
        "units si",
        "atom_style sphere 1",
        "newton off",
        "comm_modify vel yes",
        "boundary m m m",
        f"read_data {DATA}",
        f"neighbor {SKIN * float(table.radius.min())!r} bin",
        "neigh_modify every 1 delay 0 check yes",
        "pair_style granular",
    ]
    if len(case.powders) == 1:
        model = pair_model(case, case.powders[0], case.powders[0])
        lines.append(f"pair_coeff * * {model}")
    else:
        for i, first in enumerate(case.powders, 1):
            for j, second in enumerate(case.powders[i - 1 :], i):
                lines.append(f"pair_coeff {i} {j} {pair_model(case, first, second)}")
    lines += [f"group powder_{i} type {i}" for i in range(1, len(case.powders) + 1)]
    lines.append("fix integrate all nve/sphere")
    if any(case.engine.gravity):
        x, y, z = case.engine.gravity
        size = (x * x + y * y + z * z) ** 0.5
        lines.append(f"fix weight all gravity {size!r} vector {x!r} {y!r} {z!r}")
    return lines


def _wall(case: "Case", name: str) -> list[str]:
    """Region, contact model and total force of a wall."""
    wall = walls_of(case)[name]
    if wall.kind == "plane":
        axis = wall.normal
        numbers = " ".join(map(repr, (*wall.point, *wall.normal)))
        shape = f"plane {numbers} side in"
        along = "+".join(
            f"({n!r})*v_f{c}_{name}" for c, n in zip(AXES, wall.normal, strict=True)
        )
    else:
        axis = wall.axis
        k = max(range(3), key=lambda c: abs(wall.axis[c]))
        a, b = (c for c in range(3) if c != k)
        ends = sorted(wall.point[k] + wall.axis[k] * x for x in (wall.bottom, wall.top))
        low, high = (wall.point[a], wall.point[b]), ends
        shape = (
            f"cylinder {AXES[k]} {low[0]!r} {low[1]!r} {wall.radius!r} "
            f"{high[0]!r} {high[1]!r} side in open 1 open 2"
        )
        along = ""
    moved = []
    for c in range(3):
        if axis[c] == 0.0:
            moved.append("NULL")
        else:
            moved.append(f"v_m{AXES[c]}_{name}")
    lines = [
        f"variable m{AXES[c]}_{name} equal ({axis[c]!r})*v_d_{name}"
        for c in range(3)
        if axis[c] != 0.0
    ]
    lines.append(f"region r_{name} {shape} move {' '.join(moved)} units box")
    fixes = []
    for i, powder in enumerate(case.powders, 1):
        model = pair_model(case, powder, wall.material)
        fix = f"w{i}_{name}"
        fixes.append(fix)
        lines.append(
            f"fix {fix} powder_{i} wall/gran/region granular {model} "
            f"region r_{name} contacts"
        )
    for c in range(3):
        parts = []
        for fix in fixes:
            lines.append(f"compute f{AXES[c]}_{fix} all reduce sum f_{fix}[{2 + c}]")
            parts.append(f"c_f{AXES[c]}_{fix}")
        lines.append(f"variable f{AXES[c]}_{name} equal {'+'.join(parts)}")
    return lines + _normal_force(name, along, wall, fixes)


def _normal_force(
    name: str, along: str, wall: "PlaneWall | CylinderWall", fixes: list[str]
) -> list[str]:
    """Sum of the forces normal to a wall."""
    if wall.kind == "plane":
        return [f"variable n_{name} equal {along}"]
    k = max(range(3), key=lambda c: abs(wall.axis[c]))
    a, b = (c for c in range(3) if c != k)
    x = f"({AXES[a]}-({wall.point[a]!r}))"
    y = f"({AXES[b]}-({wall.point[b]!r}))"
    lines, parts = [], []
    for fix in fixes:
        radial = f"f_{fix}[{2 + a}]*{x}+f_{fix}[{2 + b}]*{y}"
        lines += [
            f"variable r_{fix} atom -({radial})/(sqrt({x}*{x}+{y}*{y})+1e-300)",
            f"compute n_{fix} all reduce sum v_r_{fix}",
        ]
        parts.append(f"c_n_{fix}")
    return [*lines, f"variable n_{name} equal {'+'.join(parts)}"]


def _output(case: "Case", dt: float) -> list[str]:
    """Columns of the log: step, then five a wall, kinetic energy and contacts."""
    columns = ["step"]
    for name in case.all_walls:
        columns += [f"v_{part}_{name}" for part in ("d", "fx", "fy", "fz", "n")]
    powders = range(1, len(case.powders) + 1)
    touching = [f"f_w{i}_{name}[1]" for name in case.all_walls for i in powders]
    forces = [
        f"f_w{i}_{name}[{c}]"
        for name in case.all_walls
        for i in powders
        for c in (2, 3, 4)
    ]
    lines = [f"compute touch_{k} all reduce sum {f}" for k, f in enumerate(touching)]
    walls = "+".join(f"c_touch_{k}" for k in range(len(touching))) or "0"
    return [
        *lines,
        "compute near all contact/atom",
        "compute pairs all reduce sum c_near",
        "compute moving all ke",
        "compute turning all erotate/sphere",
        "variable kinetic equal c_moving+c_turning",
        f"variable coordination equal (c_pairs+{walls})/atoms",
        "compute ends all property/local patom1 patom2 cutoff radius",
        "compute forces all pair/local dist fx fy fz p1 p2 p3 cutoff radius",
        f"timestep {dt!r}",
        f"thermo {case.output.history_every}",
        f"thermo_style custom {' '.join(columns)} v_kinetic v_coordination",
        "thermo_modify norm no format float %.17g flush yes",
        f"dump particles all custom 1000000000 {PARTICLES} {PARTICLE_COLUMNS} "
        + " ".join(forces),
        f"dump contacts all local 1000000000 {CONTACTS} c_ends[1] c_ends[2] "
        + " ".join(f"c_forces[{k}]" for k in range(1, 8)),
        "dump_modify particles format float %.17g sort id",
        "dump_modify contacts format float %.17g",
    ]


def _run(case: "Case", leg: Leg, parts: list[Leg]) -> list[str]:
    """A run with frames spread over its stage."""
    whole = sum(other.steps for other in parts if other.stage == leg.stage)
    every = max(whole // case.output.frames, 1)
    return [
        f"dump_modify particles every {every} first yes",
        f"dump_modify contacts every {every} first yes",
        f"run {leg.steps}",
    ]


def _data(case: "Case", table: "ParticleTable") -> str:
    """Data file: particles with ids from 1 in the order of their ids in the case."""
    margin = 2.0 * float(table.radius.max())
    low = (table.position - table.radius[:, None]).min(axis=0) - margin
    high = (table.position + table.radius[:, None]).max(axis=0) + margin
    lines = ["particles of a case of pestle", "", f"{len(table.radius)} atoms"]
    lines += [f"{len(case.powders)} atom types", ""]
    for axis, a, b in zip(AXES, low, high, strict=True):
        lines.append(f"{float(a)!r} {float(b)!r} {axis}lo {axis}hi")
    lines += ["", "Atoms # sphere", ""]
    density = table.density * case.engine.mass_scaling
    for k in range(len(table.radius)):
        x, y, z = map(float, table.position[k])
        lines.append(
            f"{k + 1} {int(table.material[k]) + 1} {2.0 * float(table.radius[k])!r} "
            f"{float(density[k])!r} {x!r} {y!r} {z!r}"
        )
    return "\n".join(lines) + "\n"
