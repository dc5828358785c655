"""What every pair law must obey, for our laws and for yours.

`check_law(law)` drives one contact along many paths and raises an `AssertionError` that
names everything wrong; `follow` gives the answers along a path.  Multi-neighbour laws
need an engine and are not checked here.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields, replace
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from pestle.errors import InputError
from pestle.laws import Geometry, Nothing, Pair, Parts, Solid, parts_of

Array = npt.NDArray[np.float64]

SOLID = Solid(youngs_modulus=1e8, poisson_ratio=0.3, yield_stress=1e6, density=1500.0)
PAIR = Pair(first=SOLID, second=SOLID, work_of_adhesion=0.05)
RADIUS = 1e-4  # R* [m]
COLUMNS = ("force", "radius", "stiffness", "stored", "damping")
# powers of stress and length in the units of options
DIMENSIONS = {"Pa": (1, 0), "N/m": (1, 1), "N": (1, 2), "m": (0, 1), "1/m": (0, -1)}


def geometry(overlap: float, radius: float = RADIUS) -> Geometry:
    """Two equal spheres of reduced radius `radius` [m] at an overlap [m]."""
    return Geometry(overlap, radius, 2.0 * radius, 2.0 * radius, 1.0, 0.0)


def follow(
    law: Any,
    overlaps: Iterable[float],
    *,
    pair: Pair = PAIR,
    radius: float = RADIUS,
    state: Any = None,
) -> dict[str, Array]:
    """Answers of a law along a path of overlaps.

    Parameters
    ----------
    law : law object
        A pair law with its options.
    overlaps : iterable of float
        Path [m].
    pair : Pair
        Materials and work of adhesion.
    radius : float
        R* [m].
    state : NamedTuple, optional
        State at the start; fresh if none.

    Returns
    -------
    dict
        Arrays "overlap", "force", "radius", "stiffness", "stored", "damping" and
        "state" (one row a point). SI units.
    """
    parts = pair_parts(law)
    k = law.constants(pair)
    s = fresh(parts) if state is None else state
    path = np.array(list(overlaps), float)
    answers, states = np.zeros((len(path), 5)), np.zeros((len(path), len(s)))
    for n, x in enumerate(path.tolist()):
        answers[n], s = parts.contact(k, geometry(x, radius), s)
        states[n] = s
    return {
        "overlap": path,
        **{name: answers[:, n] for n, name in enumerate(COLUMNS)},
        "state": states,
    }


def pair_parts(law: Any) -> Parts:
    """Parts of a pair law; an error for one whose contacts feel each other."""
    parts = parts_of(law)
    if parts.particle is not Nothing:
        raise InputError(
            "not-a-pair-law",
            f"the contacts of {law.name!r} feel each other",
            hint="drive it through the engine or pestle.particle",
        )
    return parts


def fresh(parts: Parts) -> Any:
    """State of a contact before its first touch."""
    return parts.state(*[0.0] * len(parts.state._fields))  # type: ignore[attr-defined]


def legs(corners: Sequence[float], steps: int = 150) -> Array:
    """Path through corners, each leg in equal steps."""
    parts = [
        np.linspace(one, two, steps, endpoint=False) for one, two in pairwise(corners)
    ]
    return np.concatenate([*parts, [corners[-1]]])


def dissipation(answer: dict[str, Array]) -> tuple[Array, Array]:
    """Increments of dissipation along a path, and what the steps may hide [J].

    A trapezoid errs where the force jumps and, by the stiffness, where it has a kink.
    """
    x, f, u = answer["overlap"], answer["force"], answer["stored"]
    k = answer["stiffness"]
    moved = np.diff(x)
    spent = 0.5 * (f[1:] + f[:-1]) * moved - np.diff(u)
    noise = 0.5 * np.abs(np.diff(f) * moved)
    noise += 0.5 * np.maximum(k[1:], k[:-1]) * moved**2
    noise += 1e-9 * (np.abs(f[1:] * moved) + np.abs(u[1:]) + np.abs(u[:-1]))
    noise += np.finfo(float).tiny  # below it numbers lose their digits
    return spent, noise


def paths(law: Any, pair: Pair, radius: float, depth: float, count: int) -> list[Array]:
    """Random closed paths from beyond reach to beyond reach."""
    random = np.random.default_rng(20)
    apart = _apart(law, pair, radius)
    found = []
    for _ in range(count):
        deep = depth * 10.0 ** random.uniform(-4.0, 0.0)
        inner = random.uniform(-1.2 * apart, deep, random.integers(2, 7))
        found.append(legs([-1.5 * apart, deep, *inner, -1.5 * apart]))
    return found


def _apart(law: Any, pair: Pair, radius: float) -> float:
    """A distance beyond the reach of the law [m]."""
    reach = parts_of(law).reach(law.constants(pair), geometry(0.0, radius))
    return float(reach) + 1e-6 * radius


def check_law(
    law: Any,
    *,
    pair: Pair = PAIR,
    radius: float = RADIUS,
    depth: float = 5e-6,
    scales: bool = True,
) -> None:
    """Check that a pair law keeps the contract.

    Answers are finite, compiled as in plain Python; the force is continuous but where a
    contact attaches or detaches; no step creates energy and none comes back that was
    not stored; the stiffness is the slope of the force; forces scale with stress and
    length (options by the unit in their metadata); a contact parted beyond reach is as
    new.

    Parameters
    ----------
    law : law object
        The law with its options.
    pair : Pair
        Materials and work of adhesion of the test.
    radius, depth : float
        R* and largest overlap of the test [m].
    scales : bool
        Whether to check the scaling.

    Raises
    ------
    AssertionError
        With a sentence for each thing that is wrong.
    """
    tests: list[Callable[..., str | None]] = [
        _finite, _without_gain, _continuous, _slope, _forgets, _compiled,
    ]  # fmt: skip
    tests += [_scaling] if scales else []
    problems = [test(law, pair, radius, depth) for test in tests]
    found = [f"{law.name}: {problem}" for problem in problems if problem]
    if found:
        raise AssertionError("\n".join(found))


def _finite(law: Any, pair: Pair, radius: float, depth: float) -> str | None:
    apart = _apart(law, pair, radius)
    deep = [0.0, 1e-12 * radius, depth, 0.5 * radius, 0.0, -apart, -radius, 0.0]
    answer = follow(law, legs(deep, 50), pair=pair, radius=radius)
    for name in (*COLUMNS, "state"):
        if not np.isfinite(answer[name]).all():
            return f"{name} is not finite"
    for name in ("radius", "stiffness", "damping"):
        if (answer[name] < 0.0).any():
            return f"{name} is negative"
    return None


def _without_gain(law: Any, pair: Pair, radius: float, depth: float) -> str | None:
    for path in paths(law, pair, radius, depth, 25):
        answer = follow(law, path, pair=pair, radius=radius)
        spent, noise = dissipation(answer)
        worst = int(np.argmin(spent + noise))
        if spent[worst] < -noise[worst]:
            x, scale = path[worst + 1], float(np.abs(answer["stored"]).max())
            return (
                f"energy from nothing: {spent[worst]:.3g} J at an overlap of {x:.3g} m "
                f"(largest stored energy {scale:.3g} J)"
            )
        if answer["stored"][-1] != 0.0:
            return "a parted contact stores energy"
    return None


def _continuous(law: Any, pair: Pair, radius: float, depth: float) -> str | None:
    apart = _apart(law, pair, radius)
    corners = [-apart, depth, 0.3 * depth, 0.9 * depth, -apart]
    jumps = []
    for steps in (250, 4000):
        f = follow(law, legs(corners, steps), pair=pair, radius=radius)["force"]
        inner = (f[1:] != 0.0) & (f[:-1] != 0.0)
        jumps.append(float(np.abs(np.diff(f))[inner].max(initial=0.0)))
    if jumps[1] > 0.6 * jumps[0]:
        return f"the force of a joined contact jumps by {jumps[1]:.3g} N"
    return None


def _slope(law: Any, pair: Pair, radius: float, depth: float) -> str | None:
    """On most of the path: kinks and the steep end of a branch are left out."""
    path = legs([0.0, depth, 0.2 * depth, 1.1 * depth, 0.5 * depth], 2000)
    answer = follow(law, path, pair=pair, radius=radius)
    x, f, k = answer["overlap"], answer["force"], answer["stiffness"]
    slope = np.abs((f[2:] - f[:-2]) / np.where(x[2:] == x[:-2], np.inf, x[2:] - x[:-2]))
    near = np.abs(slope - k[1:-1]) <= 0.02 * np.maximum(slope, k[1:-1])
    if near.mean() < 0.95:
        return f"the stiffness is the slope of the force on {near.mean():.0%} of a path"
    return None


def _forgets(law: Any, pair: Pair, radius: float, depth: float) -> str | None:
    apart = _apart(law, pair, radius)
    path = legs([-apart, 0.6 * depth, -apart, -1.1 * apart])
    once = follow(law, path, pair=pair, radius=radius)
    if once["state"][-1].any() or once["force"][-1] != 0.0:
        return "a contact parted beyond reach is not as new"
    parts = pair_parts(law)
    state = parts.state(*once["state"][-1].tolist())
    again = follow(law, path, pair=pair, radius=radius, state=state)
    if not np.array_equal(once["force"], again["force"]):
        return "a second contact does not answer as the first"
    return None


def _compiled(law: Any, pair: Pair, radius: float, depth: float) -> str | None:
    from pestle import _jit

    parts: Any = pair_parts(law)
    k = law.constants(pair)
    if type(k) is not parts.constants:
        return f"constants() gives a {type(k).__name__}"
    one = _jit.inline(parts.contact)

    def run(k: Any, s: Any, path: Any, radius: Any, out: Any) -> Any:
        for n in range(len(path)):
            g = Geometry(path[n], radius, 2.0 * radius, 2.0 * radius, 1.0, 0.0)
            r, s = one(k, g, s)
            out[n, 0], out[n, 1], out[n, 2] = r.force, r.radius, r.stiffness
            out[n, 3], out[n, 4] = r.stored, r.damping
        return s

    for path in paths(law, pair, radius, depth, 5):
        plain = follow(law, path, pair=pair, radius=radius)
        out = np.zeros((len(path), 5))
        floats = parts.constants(*map(float, k))
        _jit.njit(run)(floats, fresh(parts), path, radius, out)
        for n, name in enumerate(COLUMNS):
            scale = float(np.abs(plain[name]).max())
            if not np.allclose(out[:, n], plain[name], rtol=1e-10, atol=1e-12 * scale):
                return f"compiled, the {name} is another than in plain Python"
    return None


def _scaling(law: Any, pair: Pair, radius: float, depth: float) -> str | None:
    stress, length = 3.0, 0.25
    larger = scaled(law, stress, length)
    solids = [
        replace(
            solid,
            youngs_modulus=stress * solid.youngs_modulus,
            yield_stress=stress * solid.yield_stress,
        )
        for solid in (pair.first, pair.second)
    ]
    other = Pair(
        first=solids[0],
        second=solids[1],
        work_of_adhesion=stress * length * pair.work_of_adhesion,
        wall=pair.wall,
    )
    apart = _apart(law, pair, radius)
    path = legs([-apart, depth, -0.7 * apart, 0.3 * depth, -1.5 * apart], 100)
    one = follow(law, path, pair=pair, radius=radius)
    two = follow(larger, length * path, pair=other, radius=length * radius)
    for name, power in (("force", 2), ("stiffness", 1), ("stored", 3)):
        want = stress * length**power * one[name]
        scale = float(np.abs(want).max())
        if not np.allclose(two[name], want, rtol=1e-9, atol=1e-10 * scale):
            return f"the {name} does not scale with stress and length"
    return None


def scaled(law: Any, stress: float, length: float) -> Any:
    """Law whose options with units are scaled by a factor of stress and of length."""
    changed = {}
    for field in fields(law):
        powers = DIMENSIONS.get(field.metadata.get("unit", ""))
        value = getattr(law, field.name)
        if powers and value is not None:
            changed[field.name] = value * stress ** powers[0] * length ** powers[1]
    return replace(law, **changed)
