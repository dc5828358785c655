"""How a run begins: particles placed, filled soft, hardened; or read."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.errors import InputError
from pestle.packing import draw_mass, draw_radii, place_in_die
from pestle.simulation import checkpoint
from pestle.simulation.build import make_engine

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.simulation.runner import Runner

Array = npt.NDArray[Any]


def start(run: "Runner") -> None:
    """Place the particles of a fresh run."""
    case = run.case
    filling = case.process[0].step == "fill"
    if case.particles[0].start_from is not None:
        continue_from_run(run)
        return
    run.engine, run.walls = make_engine(
        case, filling=filling, softening=softening(case)
    )
    if case.particles[0].file is not None:
        table = case.read_particles()
        place, radius, density = table.position, table.radius, table.density
        material = table.material
    elif case.die is not None and filling:
        random = np.random.default_rng(case.seed)
        radius, density, material = drawn(case, random)
        place, height = place_in_die(radius, case.die.radius, random)
        floor = standing(case)
        place[:, 2] += floor
        run.memory["column"] = floor + height
    else:
        raise InputError(
            "no-start",
            "generated particles need a die and a first step 'fill'",
            "process.0.step",
            'add [[process]] step = "fill" as the first step, or read a file',
        )
    run.engine.set_particles(
        place, radius, material, density * case.engine.mass_scaling
    )
    if filling:
        run.memory.setdefault("column", float(place[:, 2].max()))
        _open_for_filling(run)
    begin_ledger(run)


def standing(case: "Case") -> float:
    """Height of what stands in the die from the start; powder begins above it [m]."""
    tops = [
        wall.point[2] + float(case.surface(name)[0][:, 2].max())
        for name, wall in case.walls.items()
        if not getattr(wall, "absent", True)
    ]
    return max([0.0, *tops])


def drawn(
    case: "Case", random: np.random.Generator, share: float = 1.0
) -> tuple[Array, Array, Array]:
    """Radii [m], densities [kg/m^3] and materials of generated powders, in turn.

    With `share` below one, so much of each powder, but at least one particle.
    """
    powders = case.powders
    radius, density, material = [], [], []
    for group in case.particles:
        assert group.radius is not None
        assert group.material is not None
        each = case.materials[group.material].density
        assert each is not None
        if group.mass is not None:
            radii = draw_mass(group.radius, share * group.mass / each, random)
        else:
            assert group.count is not None
            count = max(round(share * group.count), 1)
            radii = draw_radii(group.radius, count, random)
        radius.append(radii)
        density.append(np.full(len(radii), each))
        material.append(np.full(len(radii), powders.index(group.material)))
    return np.concatenate(radius), np.concatenate(density), np.concatenate(material)


def softening(case: "Case") -> float:
    """Modulus over that of the filling stage [-]."""
    for step in case.process:
        if step.step == "fill":
            return step.softening
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
    run.engine = engine
    begin_ledger(run)


def continue_from_run(run: "Runner") -> None:
    """Start from the last state of an earlier run."""
    arrays, facts, radius, density, material = earlier(run.case)
    run.engine, run.walls = make_engine(run.case)
    engine = run.engine
    order = np.argsort(arrays["ids"])
    engine.set_particles(arrays["pos"][order, :3], radius, material, density)
    moving = [0, 1, 2, 4, 5, 6]
    engine.vel[:, moving] = arrays["vel"][order][engine.ids - 1][:, moving]
    same_law = facts.get("law") == run.case.canonical_law()
    same_powders = facts.get("powders") == list(run.case.powders)
    if same_law and same_powders and facts.get("walls") == run.walls:
        gravity, clock = engine.gravity, engine.clock.copy()
        engine.restore(arrays)
        engine.gravity = gravity
        engine.report[0] = 0
        engine.clock[:] = clock
    begin_ledger(run)


def earlier(
    case: "Case",
) -> tuple[dict[str, Array], dict[str, Any], Array, Array, Array]:
    """Last state of the run that a case continues: arrays and facts of its checkpoint.

    Then, by the order of the ids, initial radii [m], densities [kg/m^3] with mass
    scaling, and materials as this case numbers them.
    """
    assert case.particles[0].start_from is not None
    arrays, facts = checkpoint.read(case.resolve(case.particles[0].start_from))
    order = np.argsort(arrays["ids"])
    grows = arrays["field"].shape[1] > 1
    radius = arrays["field"][order, 0] if grows else arrays["pos"][order, 3]
    density = arrays["vel"][order, 3] / (4.0 / 3.0 * np.pi * radius**3)
    number = _renumbered(case, facts.get("powders"))
    return arrays, facts, radius, density, number[arrays["mat"][order]]


def _renumbered(case: "Case", before: list[str] | None) -> Array:
    """Number in this case of each of the earlier run's powders."""
    powders = case.powders
    if case.particles[0].material is None:
        assert before is not None
        return np.array([powders.index(name) for name in before])
    if before is not None and len(before) > 1:
        raise InputError(
            "contradiction",
            f"the earlier run has the powders {', '.join(before)}, but the case says "
            f"that all are of {case.particles[0].material!r}",
            "particles.material",
            "leave material out",
        )
    return np.zeros(1, int)


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


def begin_ledger(run: "Runner") -> None:
    """Start an engine, and remember the energy that it begins with, for the ledger."""
    run.engine.start()
    e = run.engine
    m, v, w = e.vel[:, 3], e.vel[:, :3], e.vel[:, 4:7]
    kinetic = 0.5 * float(np.sum(m[:, None] * v * v)) + 0.5 * float(
        np.sum(e.vel[:, 7][:, None] * w * w)
    )
    potential = -float(np.sum(m * (e.pos[:, :3] @ e.gravity)))
    run.memory["energy"] = kinetic + potential + float(e.sums[st.STORED])
