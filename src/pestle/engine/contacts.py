"""The contact loop: geometry -> law -> damping, friction, rolling -> ledger.

One loop over the contacts of a block, specialised on the law by the compiler.  A contact
is oriented by persistent particle id: the side with the smaller id is `a`, and the
normal points from b to a.  Histories then need no knowledge of the law at a rebuild.
"""

from math import sqrt
from typing import Any

from pestle import _jit
from pestle._jit import multiply_add
from pestle.engine.scratch import (
    BEFORE,
    COLUMNS,
    D2,
    DAMPING,
    DX,
    FRICTION,
    H0,
    HISTORY,
    MASS,
    PAIR,
    RA,
    RB,
    ROLL,
    SHEAR,
    SPIN,
    STIFF,
    TORQUE,
    WEIGHT,
    A,
    B,
    Layout,
    at,
    loader,
    saver,
    table_loader,
)
from pestle.engine.vectors import Vector, cross, dot, minus, plus, times
from pestle.laws._base import Geometry, Nothing, Parts

TINY = 1e-150  # keeps from dividing by 0; two of them can be multiplied


@_jit.inline
def three(S: Any, row: int, c: Any) -> Vector:
    """Read three numbers of a contact from rows one after the other."""
    return S[at(row, c)], S[at(row + 1, c)], S[at(row + 2, c)]


@_jit.inline
def save_three(S: Any, row: int, c: Any, v: Vector) -> None:
    """Write three numbers of a contact to rows one after the other."""
    S[at(row, c)], S[at(row + 1, c)], S[at(row + 2, c)] = v


@_jit.inline
def half_root(x: float) -> float:
    """(sqrt(1 + x) - 1) / x by its series: to 4e-12 at 0.01, to 4e-7 at 0.1."""
    p = multiply_add(x, 7.0 / 256.0, -5.0 / 128.0)
    p = multiply_add(x, p, 1.0 / 16.0)
    p = multiply_add(x, p, -1.0 / 8.0)
    return multiply_add(x, p, 0.5)


def evaluator(law: Parts, is_wall: bool) -> Any:
    """One signature for pair laws, multi-neighbour laws and walls."""
    if law.particle is Nothing:
        contact = _jit.inline(law.contact)

        def simple(k: Any, g: Any, s: Any, a: Any, b: Any) -> Any:
            response, state = contact(k, g, s)
            return response, state, Nothing(), Nothing()

        return _jit.inline(simple)
    if not is_wall:
        return _jit.inline(law.contact)
    wall = _jit.inline(law.wall)

    def against_wall(k: Any, g: Any, s: Any, a: Any, b: Any) -> Any:
        response, state, sums = wall(k, g, s, a)
        return response, state, sums, sums

    return _jit.inline(against_wall)


def make_batch(
    law: Parts,
    layout: Layout,
    *,
    is_wall: bool,
    uniform: bool,
    rolling: bool,
    stretched: bool,
    zeros: tuple[int, ...] = (),
) -> Any:
    """Build the loop over the contacts of a block, specialised on the law.

    `stretched`: the limit cuts spring and dashpot together, and the spring of a sliding
    contact is what the dashpot leaves of it; else the spring is cut first by itself.
    """
    evaluate = evaluator(law, is_wall)
    constants = table_loader(law.constants, PAIR, zeros)
    row = layout.table_row
    constants_of = loader(law.constants, row + PAIR, zeros)
    state, save_state = (
        loader(law.state, layout.state_row),
        saver(law.state, layout.state_row),
    )
    fields_a = loader(law.particle, layout.field_a)
    fields_b = loader(law.particle, layout.field_b)
    out_a, out_b = layout.out_a, layout.out_b
    save_a, save_b = saver(law.sums, out_a + COLUMNS), saver(law.sums, out_b + COLUMNS)
    deep, ledger = layout.deep_row, layout.ledger_row
    roll_row = H0 + HISTORY
    worked = layout.worked
    grown_a, grown_b = layout.field_a + layout.growth, layout.field_b + layout.growth
    grows = layout.growth >= 0

    def batch(S: Any, m: int, table: Any, dt: float) -> None:
        k = constants(table, 0)
        mu, mu_roll = table[0, FRICTION], table[0, ROLL]
        ratio, shear = table[0, DAMPING], table[0, SHEAR]
        for c in range(m):
            if not uniform:
                k = constants_of(S, c)
                mu, mu_roll = S[at(row + FRICTION, c)], S[at(row + ROLL, c)]
                ratio, shear = S[at(row + DAMPING, c)], S[at(row + SHEAR, c)]
            between, d2 = three(S, DX, c), S[at(D2, c)]
            speed = minus(three(S, A, c), three(S, B, c))
            spin_a, spin_b = three(S, A + SPIN, c), three(S, B + SPIN, c)
            ra, rb, ma = S[at(RA, c)], S[at(RB, c)], S[at(A + MASS, c)]
            mb = 1.0 if is_wall else S[at(B + MASS, c)]
            weight = 1.0 if is_wall else S[at(WEIGHT, c)]
            # inverses of lengths and masses by one division, while the root is taken
            d, both = sqrt(d2), ra + rb
            least = ra if is_wall else min(ra, rb)
            inner, outer = d2 * both, least if is_wall else least * (ma + mb)
            inverse = 1.0 / (inner * outer)
            per_d, per_sum = d * (both * outer * inverse), d2 * outer * inverse
            mass = ma if is_wall else ma * mb * (inner * least * inverse)
            per_least = inner * inverse * (1.0 if is_wall else ma + mb)
            normal = times(per_d, between)
            star = ra if is_wall else ra * rb * per_sum
            arm = d * per_sum
            towards = dot(between, speed)
            # approach since the last step, from the exact distance then
            if is_wall:
                before2 = S[at(BEFORE, c)]
                approach = (before2 - d2) / (sqrt(max(before2, 0.0)) + d)
            else:
                more = dt * (dt * dot(speed, speed) - 2.0 * towards)
                approach = more * per_d * half_root(more * per_d * per_d)
            old, per_old = three(S, H0, c), S[at(H0 + 3, c)]
            push_old, stored_old, damp_old = three(S, H0 + 4, c)

            g = Geometry(both - d, star, ra, rb, weight, push_old)
            r, new, sums_a, sums_b = evaluate(
                k, g, state(S, c), fields_a(S, c), fields_b(S, c)
            )
            save_state(S, c, new)
            save_a(S, c, sums_a)
            save_b(S, c, sums_b)

            # velocity of the surfaces against each other
            turning = plus(times(ra, spin_a), rb, spin_b)
            carried = times(per_sum, cross(turning, between))
            closing = towards * per_d
            slip = plus(minus(speed, carried), -closing, normal)
            damp = -ratio * r.damping * sqrt(mass * r.stiffness) * closing
            limit = mu * abs(r.force + damp)

            # tangential spring: turns with the contact, softens with it, slides
            kt = weight * shear * r.radius
            size2 = dot(old, old)
            flat = plus(old, -dot(old, normal), normal)
            flat2 = dot(flat, flat)
            turn = sqrt(size2 * flat2) / (flat2 + TINY)
            soften = min(kt * per_old, 1.0) if per_old > 0.0 else 1.0
            held2 = size2 * per_old  # twice the energy before
            old = times(turn, flat)
            spring = plus(times(soften, old), -kt * dt, slip)
            # the inverses of its square and stiffness by one division
            square, rigid = dot(spring, spring) + TINY, kt + TINY
            inverse, size = 1.0 / (square * rigid), sqrt(square)
            per_kt = square * inverse if kt > 0.0 else 0.0
            cut = limit * rigid * (inverse * size)
            if not stretched:
                spring = times(cut if size > limit else 1.0, spring)
            # the dashpot counts towards the limit
            drag = ratio * r.damping * sqrt(mass * kt)
            rubbing = plus(spring, -drag, slip)
            square = dot(rubbing, rubbing) + TINY
            size = sqrt(square)
            rubbing = times(limit / square * size if size > limit else 1.0, rubbing)
            if stretched:
                spring = plus(rubbing, drag, slip)
            held = dot(spring, spring) * per_kt
            # work against the mean of the old force, at its lever, and the new one; and
            # what dashpots take
            slid = -0.5 * dt * (dot(old, slip) + dot(spring, slip))
            slid += 0.5 * dt * approach * per_d * dot(old, carried)
            eddy = -dt * dot(minus(rubbing, spring), slip)

            rolled = (0.0, 0.0, 0.0)
            if rolling:
                turning = minus(spin_a, spin_b)
                turning = plus(turning, -dot(turning, normal), normal)
                kr = kt * star * star
                bent = three(S, roll_row, c)
                held2 += dot(bent, bent) * per_old / (star * star)
                bent = plus(bent, -dot(bent, normal), normal)
                ease = soften * soften * soften
                rolled = plus(times(ease, bent), -kr * dt, turning)
                most = mu_roll * star * abs(r.force)
                size = sqrt(dot(rolled, rolled))
                rolled = times(most / (size + TINY) if size > most else 1.0, rolled)
                save_three(S, roll_row, c, rolled)
                slid -= 0.5 * dt * (dot(bent, turning) + dot(rolled, turning))
                held += dot(rolled, rolled) / (kr + TINY)

            save_three(S, H0, c, spring)
            S[at(H0 + 3, c)] = per_kt
            save_three(S, H0 + 4, c, (r.force, r.stored, damp))

            force = plus(rubbing, r.force + damp, normal)
            torque = cross(normal, rubbing)
            stiff = max(r.stiffness, 3.5 * kt)
            save_three(S, out_a, c, force)
            save_three(S, out_a + TORQUE, c, plus(rolled, -ra * arm, torque))
            S[at(out_a + STIFF, c)] = stiff
            save_three(S, out_b, c, times(-1.0, force))
            rolled = times(-1.0, rolled)
            save_three(S, out_b + TORQUE, c, plus(rolled, -rb * arm, torque))
            S[at(out_b + STIFF, c)] = stiff
            S[at(deep, c)] = (both - d) * per_least
            S[at(ledger, c)] = r.stored + 0.5 * held
            spent = 0.5 * (push_old + r.force) * approach - (r.stored - stored_old)
            if worked:
                spent -= S[at(out_a + worked, c)]
                spent -= 0.0 if is_wall else S[at(out_b + worked, c)]
            S[at(ledger + 1, c)] = spent
            S[at(ledger + 2, c)] = slid - 0.5 * (held - held2)
            S[at(ledger + 3, c)] = 0.5 * (damp_old + damp) * approach + eddy
            # energy from nothing: more of it than the trapezoid may err by; a radius that
            # grows moves the contact and widens it too, at the cost of the particle
            closer = approach
            if grows:
                closer += S[at(grown_a, c)]
                closer += 0.0 if is_wall else S[at(grown_b, c)]
            spent += abs(push_old + r.force) * (closer - approach)
            spent += 0.5 * abs((r.force - push_old) * closer)
            noise = 1e-9 * (abs(push_old * closer) + abs(r.stored) + abs(stored_old))
            S[at(ledger + 4, c)] = spent if spent < -noise else 0.0

    return _jit.njit(batch)
