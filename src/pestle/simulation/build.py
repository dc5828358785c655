"""From a case to an engine: materials, pairs, walls, particles."""

from itertools import combinations_with_replacement
from math import hypot, log, pi, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.engine.engine import Engine, PairRule
from pestle.engine.mesh import Surface
from pestle.laws import Hertz, Solid

if TYPE_CHECKING:
    from pestle.config import Case

BODIES = ("mesh", "blade", "shear_head")
"""Kinds of walls that are bodies of triangles."""

PLATENS = ("platen_left", "platen_right")


def law_of(case: "Case") -> Any:
    """Return the law object of a case."""
    return case.law.build()


def solids_of(case: "Case", softening: float = 1.0) -> tuple[list[Solid], list[str]]:
    """Return solids and material names, the particles' first."""
    walls = sorted({w.material for w in case.all_walls.values()})
    names = [*case.powders, *walls]
    solids = []
    for name in names:
        m = case.materials[name]
        if m.youngs_modulus is None or m.poisson_ratio is None:
            solids.append(Solid())  # a rigid tool
            continue
        solids.append(
            Solid(
                youngs_modulus=m.youngs_modulus / softening,
                poisson_ratio=m.poisson_ratio,
                yield_stress=float("inf") if m.yield_stress is None else m.yield_stress,
                density=m.density or 0.0,
            )
        )
    return solids, names


def damping_factor(
    restitution: float | None, damping_ratio: float | None, *, linear: bool = False
) -> float:
    """Factor c / sqrt(m* k) of the dashpot [-].

    From a restitution e: 2 sqrt(5/6) beta, beta = -ln e / sqrt(ln^2 e + pi^2), exact
    for Hertz at any speed (Antypov & Elliott, EPL 94 (2011) 50004); 2 beta, exact for a
    linear spring, where the law is `linear`; else twice the ratio.
    """
    if damping_ratio is not None:
        return 2.0 * damping_ratio
    assert restitution is not None
    if restitution >= 1.0:
        return 0.0
    loss = -log(max(restitution, 1e-3))
    return 2.0 * sqrt(1.0 if linear else 5.0 / 6.0) * loss / hypot(loss, pi)


def rules_of(
    case: "Case", names: list[str], adhesive: bool
) -> dict[tuple[int, int], PairRule]:
    """Return the pair rules by indices of `names`."""
    rules = {}
    powders = len(case.powders)
    linear = adhesive and getattr(law_of(case), "linear", False)
    for a, b in combinations_with_replacement(range(len(names)), 2):
        if a >= powders:
            continue  # two walls
        pair = case.pair(names[a], names[b])
        rules[a, b] = PairRule(
            sliding_friction=pair.sliding_friction,
            rolling_friction=pair.rolling_friction,
            damping=damping_factor(pair.restitution, pair.damping_ratio, linear=linear),
            work_of_adhesion=pair.work_of_adhesion if adhesive else 0.0,
        )
    return rules


def wall_rows(case: "Case", names: list[str]) -> tuple[list[str], list[Any], list[Any]]:
    """Return names, `wall` rows and `move` rows of all walls."""
    powders = len(case.powders)
    found, rows, moves = [], [], []
    for name, w in case.all_walls.items():
        material = float(names.index(w.material, powders))
        if w.kind == "plane":
            row = [0.0, *w.point, *w.normal, 0.0, 0.0, 0.0, 1.0, material]
            axis = w.normal
        elif w.kind == "cylinder":
            row = [1.0, *w.point, *w.axis, w.radius, w.bottom, w.top, 1.0, material]
            axis = w.axis
        else:
            here = 0.0 if w.absent else 1.0
            row = [wl.MESH, *w.point, *w.axis, 0.0, 0.0, 0.0, here, material]
            axis = w.axis
        found.append(name)
        rows.append(row)
        moves.append([*axis, *[0.0] * (wl.MOVE - 3)])
    if any(stage.step == "crush" for stage in case.process) and case.die:
        material = float(names.index(case.die.material, powders))
        for name, way in zip(PLATENS, (1.0, -1.0), strict=True):
            found.append(name)
            rows.append(
                [0.0, 0.0, 0.0, 0.0, way, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, material]
            )
            moves.append([way, *[0.0] * (wl.MOVE - 1)])
    return found, rows, moves


def surfaces_of(case: "Case", names: list[str]) -> dict[int, Surface]:
    """Surfaces of the walls that are bodies of triangles, by number."""
    return {
        number: Surface(*case.surface(name))
        for number, name in enumerate(names)
        if name in case.walls and case.walls[name].kind in BODIES
    }


def make_engine(
    case: "Case", *, filling: bool = False, softening: float = 1.0
) -> tuple[Engine, list[str]]:
    """Build the engine of a case without particles; return it with its wall names.

    While filling the particles are elastic, without adhesion, and softer.
    """
    solids, names = solids_of(case, softening if filling else 1.0)
    rules = rules_of(case, names, adhesive=not filling)
    engine = Engine(
        law=Hertz() if filling else law_of(case),
        solids=solids,
        rules=rules,
        particle_solids=len(case.powders),
        gravity=np.array(case.engine.gravity, float),
        rolling=any(rule.rolling_friction > 0.0 for rule in rules.values()),
        stretched=case.contacts.sliding_rule == "total",
        safety=case.engine.safety,
    )
    if case.box is not None:
        lengths = np.array(case.box.lengths)
        engine.box[0] = lengths
        engine.box[1] = np.where(case.box.periodic, 1.0 / lengths, 0.0)
        engine.box[3] = case.box.origin
    if case.engine.time_step != "auto":
        engine.clock[st.AUTO] = 0.0
        engine.clock[st.DT] = engine.clock[st.DT_MAX] = case.engine.time_step
    found, rows, moves = wall_rows(case, names)
    engine.set_walls(rows, moves, surfaces_of(case, found))
    return engine, found
