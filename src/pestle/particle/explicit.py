r"""The step-by-step scheme of Appendix E, of first order in the step.

Order of a step: overlaps with the radius before the step, running maxima, yield test,
forces, elastic volume by (38) with the volume before, radius by (37).  With
`carry_largest` the running maximum of every contact that is at it grows together with
the radius (otherwise the next step sees the last growth as an unloading, or unloads
late by it: an error of the size of the whole elastic recovery).
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import ceil

from pestle.particle.contact import (
    Contact,
    Memory,
    ParticleMaterial,
    evaluate,
    has_reached_yield,
    yielded,
)
from pestle.particle.state import ParticleState, RadiusRule, snapshot
from pestle.reference import volume


@dataclass(frozen=True, slots=True, kw_only=True)
class _Setting:
    material: ParticleMaterial
    initial_radius: float
    counts: tuple[int, ...]
    rule: RadiusRule
    carry_largest: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class _State:
    growth: float
    volume: float
    memories: tuple[Memory, ...]
    displacements: tuple[float, ...]


def explicit_path(
    material: ParticleMaterial,
    radius: float,
    path: Iterable[Sequence[float]],
    *,
    counts: Sequence[int] = (2,),
    radius_rule: RadiusRule = "plastic",
    step: float = 1e-3,
    carry_largest: bool = True,
) -> list[ParticleState]:
    """Follow a path as Appendix E does and return the state after every leg.

    Parameters
    ----------
    material : ParticleMaterial
        Material of the particle.
    radius : float
        Initial radius R_o [m].
    path : iterable of sequences of float
        Displacements of every group at the end of each leg [m].
    counts : sequence of int
        Numbers of flats that move alike.
    radius_rule : {"plastic", "loading", "eq37", "frozen"}
        When the apparent radius may grow.
    step : float
        Largest displacement in a step, in radii [-].
    carry_largest : bool
        Let running maxima grow with the radius.

    Returns
    -------
    list of ParticleState
        One a leg; forces are those of the radius before the last update.

    Examples
    --------
    >>> material = ParticleMaterial(
    ...     youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=0.005
    ... )
    >>> last = explicit_path(material, 1.0, [[0.3]])[-1]
    >>> round(last.flats[0].force / 0.01368035 - 1.0, 4)  # low by about 0.6 step
    -0.0006
    """
    setting = _Setting(
        material=material,
        initial_radius=radius,
        counts=tuple(counts),
        rule=radius_rule,
        carry_largest=carry_largest,
    )
    state = _State(
        growth=0.0,
        volume=volume.sphere_volume(radius),
        memories=(Memory(),) * len(counts),
        displacements=(0.0,) * len(counts),
    )
    results = []
    for target in path:
        start = state.displacements
        length = max(abs(b - a) for a, b in zip(start, target, strict=True))
        steps = max(1, ceil(length / (step * radius) - 1e-9))
        for i in range(1, steps + 1):
            weight = i / steps
            goal = tuple(
                b if i == steps else a + weight * (b - a)
                for a, b in zip(start, target, strict=True)
            )
            state, result = _advance(setting, state, goal)
        results.append(result)
    return results


def _advance(
    setting: _Setting, state: _State, goal: tuple[float, ...]
) -> tuple[_State, ParticleState]:
    material, r_o = setting.material, setting.initial_radius
    radius = r_o + state.growth
    contacts = tuple(
        _contact(material, radius, d + state.growth, memory)
        for d, memory in zip(goal, state.memories, strict=True)
    )
    increments = tuple(b - a for a, b in zip(state.displacements, goal, strict=True))
    update = volume.radius_step(
        radius,
        state.volume,
        flats=[
            (d, dd, c.force)
            for d, dd, c, n in zip(
                goal, increments, contacts, setting.counts, strict=True
            )
            if c.radius > 0.0
            for _ in range(n)
        ],
        initial_radius=r_o,
        bulk=material.constants.bulk,
    )
    acts = _acts(setting.rule, contacts, increments)
    growth = max(update.growth, 0.0) if acts else 0.0
    carried = growth if setting.carry_largest else 0.0
    memories = tuple(
        c.memory._replace(largest=c.memory.largest + carried)
        if c.overlap >= c.memory.largest
        else c.memory
        for c in contacts
    )
    result = snapshot(
        material,
        r_o,
        state.growth,
        contacts=contacts,
        counts=setting.counts,
        displacements=goal,
    )
    after = replace(
        state,
        growth=state.growth + growth,
        volume=update.volume,
        memories=memories,
        displacements=goal,
    )
    return after, replace(result, growth=after.growth)


def _contact(
    material: ParticleMaterial, radius: float, overlap: float, memory: Memory
) -> Contact:
    contact = evaluate(material, radius, overlap, memory)
    k, remembered = material.constants, contact.memory
    if has_reached_yield(k, radius, overlap, remembered):
        memory = yielded(k, radius, remembered)
        return evaluate(material, radius, overlap, memory)
    return contact


def _acts(
    rule: RadiusRule, contacts: Sequence[Contact], increments: Sequence[float]
) -> bool:
    if rule in ("eq37", "frozen"):
        return rule == "eq37"
    leading = [
        c
        for c, dd in zip(contacts, increments, strict=True)
        if dd > 0.0 and c.overlap >= c.memory.largest
    ]
    return any(c.memory.yielded or rule == "loading" for c in leading)
