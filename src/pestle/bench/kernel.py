"""Compiled loops over a pair law: along overlaps, and through an impact in time.

Each loop is made once a law; it is kept on disk under the fingerprint of the law.
"""

from functools import cache
from math import cos, sin, sqrt
from typing import Any

from pestle._jit import cached, fingerprint, inline, njit
from pestle.laws._base import Geometry, Parts

FORCE, RADIUS, STIFFNESS, STORED = range(4)


@cache
def follower(parts: Parts) -> Any:
    """Loop that follows paths of overlaps, a row a path, from a virgin contact."""
    contact = inline(parts.contact)

    def follow(k: Any, sizes: Any, paths: Any, zero: Any, out: Any) -> None:
        radius, radius_i, radius_j, reach = sizes
        for row in range(paths.shape[0]):
            state, force = zero, 0.0
            for n in range(paths.shape[1]):
                g = Geometry(paths[row, n], radius, radius_i, radius_j, 1.0, force)
                force = 0.0
                if g.overlap < -reach:
                    state = zero  # parted: the contact is forgotten
                    out[:, row, n] = 0.0
                else:
                    r, state = contact(k, g, state)
                    force = r.force
                    out[FORCE, row, n], out[RADIUS, row, n] = r.force, r.radius
                    out[STIFFNESS, row, n], out[STORED, row, n] = r.stiffness, r.stored

    return _kept(follow)


@cache
def impactor(parts: Parts) -> Any:
    """Loop that integrates impacts in time by velocity Verlet.

    The tangential spring is the engine's: it softens with the contact, slides at
    Coulomb's limit, and a dashpot never stretches it.
    """
    contact = inline(parts.contact)

    def impact(k: Any, sizes: Any, zero: Any, body: Any, runs: Any, out: Any) -> None:
        radius, radius_i, radius_j, reach = sizes
        mass, shear, friction, ratio = body
        for row in range(runs.shape[0]):
            speed, angle, dt, steps = runs[row]
            vn, vt = speed * cos(angle), speed * sin(angle)
            spin = 0.0  # what turning adds to the surface's velocity
            x, state, force, spring, stiff = 0.0, zero, 0.0, 0.0, 0.0
            push, pull = 0.0, 0.0
            out[row, 3] = 0.0
            for _ in range(int(steps)):
                vn -= 0.5 * dt * push / mass
                vt -= 0.5 * dt * pull / mass
                spin -= 1.25 * dt * pull / mass
                x += dt * vn
                g = Geometry(x, radius, radius_i, radius_j, 1.0, force)
                if x < -reach:
                    out[row, 3] = 1.0  # it has left
                    break
                r, state = contact(k, g, state)
                force = r.force
                push = force + ratio * r.damping * sqrt(mass * r.stiffness) * vn
                kt = shear * r.radius
                soften = kt / stiff if kt < stiff else 1.0
                spring = soften * spring + kt * dt * (vt + spin)
                limit = friction * abs(push)
                spring = min(max(spring, -limit), limit)
                pull = spring + ratio * r.damping * sqrt(mass * kt) * (vt + spin)
                pull = min(max(pull, -limit), limit)
                stiff = kt
                vn -= 0.5 * dt * push / mass
                vt -= 0.5 * dt * pull / mass
                spin -= 1.25 * dt * pull / mass
            out[row, 0], out[row, 1], out[row, 2] = -vn, vt, spin

    return _kept(impact)


def _kept(function: Any) -> Any:
    compiled = njit(function)
    return cached(compiled, fingerprint(function))
