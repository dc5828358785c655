r"""Contact models in LAMMPS' words, with its conventions.

A wall of LAMMPS is of the particle's own material; the modulus here is chosen so that
the composite is ours, E = 2 (1 - nu^2) E*.  The tangential stiffness is given, 8 G*.
``coeff_restitution`` damps a Hertz contact exactly as our engine does:

.. math::
    c = \sqrt5\,\beta\sqrt{m F/\delta} = 2\sqrt{5/6}\,\beta\sqrt{m\,2 E^* a}

LAMMPS' ``jkr`` takes the energy of one surface, W/2.  Its ``mdr`` gives each side of a
contact its own: between two particles W/2, against a wall W.  Its MDR damping is ours
between particles with half our factor, and a quarter of ours at walls.
"""

from math import exp, pi, sqrt
from typing import TYPE_CHECKING

from pestle.laws._base import Pair
from pestle.simulation.build import rules_of, solids_of

if TYPE_CHECKING:
    from pestle.config import Case

NONE = "tangential linear_nohistory 0.0 0.0"


def pair_model(case: "Case", first: str, second: str) -> str:
    """Model of two materials, the second of them that of a wall or a particle.

    Parameters
    ----------
    case : Case
        The case.
    first, second : str
        Names of materials; the first is a powder's.
    """
    solids, names = solids_of(case)
    a = names.index(first)
    is_wall = second not in case.powders
    b = names.index(second, len(case.powders) if is_wall else 0)
    rule = rules_of(case, names, adhesive=True)[min(a, b), max(a, b)]
    pair = Pair(
        first=solids[a],
        second=solids[b],
        work_of_adhesion=rule.work_of_adhesion,
        wall=is_wall,
    )
    damps = rule.damping
    if case.law.name == "zunker2024":  # one for all: that of the particles
        damps = rules_of(case, names, adhesive=True)[a, a].damping
    normal, damping = _normal(case, pair, damps)
    if rule.sliding_friction == 0.0:
        return f"{normal} {NONE} {damping}"
    ratio = sqrt(4.0 * pair.shear_modulus / pair.modulus)  # of the two dashpots
    style = "mindlin" if case.law.name == "zunker2024" else "mindlin_rescale/force"
    sliding = f"{8.0 * pair.shear_modulus!r} {ratio!r} {rule.sliding_friction!r}"
    return f"{normal} tangential {style} {sliding} {damping}"


def _normal(case: "Case", pair: Pair, damping: float) -> tuple[str, str]:
    """Normal model and its damping."""
    solid, adhesion = pair.first, pair.work_of_adhesion
    nu = solid.poisson_ratio
    modulus = 2.0 * (1.0 - nu * nu) * pair.modulus
    if case.law.name == "hertz":
        number = restitution(damping)
        return f"hertz/material {modulus!r} {number!r} {nu!r}", (
            "damping coeff_restitution"
        )
    if case.law.name == "jkr":
        return f"jkr {modulus!r} 0.0 {nu!r} {0.5 * adhesion!r}", "damping velocity"
    gamma = adhesion if pair.wall else 0.5 * adhesion
    free = float(case.law.options.get("psi_b", 0.5))
    values = (solid.youngs_modulus, nu, solid.yield_stress, gamma, free, 0.5 * damping)
    return " ".join(["mdr", *map(repr, values)]), "damping mdr 1"


def restitution(factor: float) -> float:
    """Restitution that LAMMPS turns into a damping factor c / sqrt(m k) [-].

    Examples
    --------
    >>> from pestle.simulation.build import damping_factor
    >>> round(restitution(damping_factor(0.4, None)), 12)
    0.4
    """
    beta = factor / (2.0 * sqrt(5.0 / 6.0))
    return exp(-pi * beta / sqrt(1.0 - beta * beta))


def notes(case: "Case") -> list[str]:
    """What is computed differently there, for the report."""
    found = [
        "Computed by LAMMPS: no energies, no plastic state; contact areas are those of "
        "overlapping spheres."
    ]
    if case.law.name == "zunker2024":
        found.append(
            "LAMMPS' MDR differs from ours: force at walls times "
            "1 + exp(10.7 delta/R - 10), a mean of ten steps for the growth of R, no "
            "tension beyond touch; walls damp with a quarter of the pairs' ratio."
        )
        if any(pair_adheres(case)):
            found.append(
                "LAMMPS' MDR did not damp adhesive contacts when we measured it."
            )
    if case.law.name == "jkr":
        found.append(
            "LAMMPS' JKR slides at friction times the normal force plus twice the "
            "pull-off force, ours at friction times the normal force."
        )
    return found


def pair_adheres(case: "Case") -> list[bool]:
    """Whether each kind of contact has adhesion."""
    others = {*case.powders, *(w.material for w in case.all_walls.values())}
    return [
        case.pair(powder, other).work_of_adhesion > 0.0
        for powder in case.powders
        for other in others
    ]
