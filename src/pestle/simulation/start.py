"""How a run begins: particles placed, filled soft, hardened; or read."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.errors import InputError
from pestle.packing import draw_radii, place_in_die
from pestle.simulation import checkpoint
from pestle.simulation.build import make_engine

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.simulation.runner import Runner

SOFTENING = 1000.0
"""Modulus of the particles over that of the filling stage, unless the case says."""


def start(run: "Runner") -> None:
    """Place the particles of a fresh run."""
    case = run.case
    filling = case.process[0].step == "fill"
    if case.particles.start_from is not None:
        continue_from(run, case.resolve(case.particles.start_from))
        return
    run.engine, run.walls = make_engine(
        case, filling=filling, softening=softening(case)
    )
    if case.particles.file is not None:
        table = case.read_particles()
        place, radius, density = table.position, table.radius, table.density
    elif case.die is not None and filling:
        random = np.random.default_rng(case.seed)
        assert case.particles.radius is not None
        assert case.particles.count is not None
        radius = draw_radii(case.particles.radius, case.particles.count, random)
        place, column = place_in_die(radius, case.die.radius, random)
        run.memory["column"] = column
        solid = case.materials[case.particles.material].density
        density = np.full(len(radius), solid)
    else:
        raise InputError(
            "no-start",
            "generated particles need a die and a first step 'fill'",
            "process.0.step",
            'add [[process]] step = "fill" as the first step, or read a file',
        )
    run.engine.set_particles(
        place,
        radius,
        np.zeros(len(radius), int),
        density * case.engine.mass_scaling,
    )
    if filling:
        run.memory.setdefault("column", float(place[:, 2].max()))
        _open_for_filling(run)
    run.engine.start()
    _initial_energy(run)


def softening(case: "Case") -> float:
    """Modulus over that of the filling stage [-]."""
    for step in case.process:
        if step.step == "fill":
            return float(getattr(step, "softening", SOFTENING))
    return 1.0


def harden(run: "Runner") -> None:
    """Replace the soft engine of the filling stage by that of the case."""
    soft, case = run.engine, run.case
    time_, ids = soft.time, soft.ids
    order = np.argsort(ids)
    run.before += soft.steps
    engine, _ = make_engine(case)
    radius = soft.pos[order, 3]
    density = soft.vel[order, 3] / (4.0 / 3.0 * np.pi * radius**3)
    top = float((soft.pos[:, 2] + soft.pos[:, 3]).max())
    if case.die is not None and top > case.die.height:
        raise InputError(
            "die-too-low",
            f"the filled powder reaches {top:.4g} m, above the die of "
            f"{case.die.height:.4g} m",
            "die.height",
            f"raise die.height above {1.05 * top:.3g} m or use fewer particles",
        )
    engine.wall[:, wl.ACTIVE] = soft.wall[:, wl.ACTIVE]
    engine.clock[st.TIME] = time_
    engine.set_particles(soft.pos[order, :3], radius, soft.mat[order], density)
    engine.ids = np.sort(ids)[engine.ids - 1]
    engine.vel[:, [0, 1, 2, 4, 5, 6]] = soft.vel[order][:, [0, 1, 2, 4, 5, 6]][
        np.searchsorted(np.sort(ids), engine.ids)
    ]
    engine.start()
    run.engine = engine
    _initial_energy(run)


def continue_from(run: "Runner", folder: Path) -> None:
    """Start from the last state of an earlier run."""
    arrays, facts = checkpoint.read(folder)
    run.engine, run.walls = make_engine(run.case)
    engine = run.engine
    order = np.argsort(arrays["ids"])
    multi = engine.layout.fields and arrays["field"].shape[1] > 1
    radius = arrays["field"][order, 0] if multi else arrays["pos"][order, 3]
    mass = arrays["vel"][order, 3]
    density = mass / (4.0 / 3.0 * np.pi * radius**3)
    engine.set_particles(
        arrays["pos"][order, :3], radius, np.zeros(len(order), int), density
    )
    engine.vel[:, :3] = arrays["vel"][order][engine.ids - 1, :3]
    same_law = facts.get("law") == run.case.canonical_law()
    if same_law and facts.get("walls") == run.walls:
        gravity = engine.gravity
        engine.restore(arrays)
        engine.gravity = gravity
        engine.report[0] = 0
        engine.clock[st.TIME] = 0.0
    engine.start()
    _initial_energy(run)


def _open_for_filling(run: "Runner") -> None:
    """Take the upper punch away and let the die reach above the column."""
    engine = run.engine
    for w, name in enumerate(run.walls):
        if name == "upper_punch":
            engine.wall[w, wl.ACTIVE] = 0.0
        if name == "die":
            engine.wall[w, wl.TOP] = max(
                engine.wall[w, wl.TOP], 1.2 * run.memory["column"]
            )


def _initial_energy(run: "Runner") -> None:
    """Remember the energy that a new engine begins with, for the ledger."""
    e = run.engine
    m, v, w = e.vel[:, 3], e.vel[:, :3], e.vel[:, 4:7]
    kinetic = 0.5 * float(np.sum(m[:, None] * v * v)) + 0.5 * float(
        np.sum(e.vel[:, 7][:, None] * w * w)
    )
    potential = -float(np.sum(m * (e.pos[:, :3] @ e.gravity)))
    run.memory["energy"] = kinetic + potential + float(e.sums[st.STORED])
