"""The contact loop: geometry -> law -> damping, friction, rolling -> ledger.

One loop over the contacts of a block, specialised on the law by the compiler.  A contact
is oriented by persistent particle id: the side with the smaller id is `a`, and the
normal points from b to a.  Histories then need no knowledge of the law at a rebuild.
"""

from math import sqrt
from typing import Any

from pestle import _jit
from pestle.engine.scratch import (
    BEFORE,
    COLUMNS,
    D2,
    DAMPING,
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
    W,
    loader,
    saver,
    table_loader,
)
from pestle.laws._base import Geometry, Nothing, Parts


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
    zeros: tuple[int, ...] = (),
) -> Any:
    """Build the loop over the contacts of a block, specialised on the law."""
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
                mu, mu_roll = S[(row + FRICTION) * W + c], S[(row + ROLL) * W + c]
                ratio, shear = S[(row + DAMPING) * W + c], S[(row + SHEAR) * W + c]
            x, y, z = S[c], S[W + c], S[2 * W + c]
            d2 = S[D2 * W + c]
            d = sqrt(d2)
            ux = S[A * W + c] - S[B * W + c]
            uy = S[(A + 1) * W + c] - S[(B + 1) * W + c]
            uz = S[(A + 2) * W + c] - S[(B + 2) * W + c]
            ax, ay, az = (
                S[(A + SPIN) * W + c],
                S[(A + SPIN + 1) * W + c],
                S[(A + SPIN + 2) * W + c],
            )
            bx, by, bz = (
                S[(B + SPIN) * W + c],
                S[(B + SPIN + 1) * W + c],
                S[(B + SPIN + 2) * W + c],
            )
            ra, rb, ma = S[RA * W + c], S[RB * W + c], S[(A + MASS) * W + c]
            mb = 1.0 if is_wall else S[(B + MASS) * W + c]
            weight = 1.0 if is_wall else S[WEIGHT * W + c]
            # approach since the last step, from the exact distance then
            before2 = (
                S[BEFORE * W + c]
                if is_wall
                else (
                    d2
                    - dt * (2.0 * (x * ux + y * uy + z * uz))
                    + dt * dt * (ux * ux + uy * uy + uz * uz)
                )
            )
            before = sqrt(max(before2, 0.0))
            # inverses of five lengths and masses by one division
            apart, least = before + d, ra if is_wall else min(ra, rb)
            inner, outer = d * (ra + rb), apart * least
            both = 1.0 if is_wall else ma + mb
            inverse = 1.0 / (inner * outer * both)
            mass = ma if is_wall else ma * mb * (inner * outer * inverse)
            per_inner, per_outer = outer * both * inverse, inner * both * inverse
            per_d, per_sum = (ra + rb) * per_inner, d * per_inner
            approach = (before2 - d2) * (least * per_outer)
            nx, ny, nz = x * per_d, y * per_d, z * per_d
            star = ra if is_wall else ra * rb * per_sum
            arm = d * per_sum
            h = H0 * W + c
            s0, s1, s2 = S[h], S[h + W], S[h + 2 * W]
            per_old, normal_old = S[h + 3 * W], S[h + 4 * W]
            stored_old, damp_old = S[h + 5 * W], S[h + 6 * W]

            g = Geometry(ra + rb - d, star, ra, rb, weight, normal_old)
            r, new, sums_a, sums_b = evaluate(
                k, g, state(S, c), fields_a(S, c), fields_b(S, c)
            )
            save_state(S, c, new)
            save_a(S, c, sums_a)
            save_b(S, c, sums_b)
            normal = r.force

            # velocity of the surfaces against each other
            ox, oy, oz = (
                (ra * ax + rb * bx) * arm,
                (ra * ay + rb * by) * arm,
                (ra * az + rb * bz) * arm,
            )
            wx, wy, wz = oy * nz - oz * ny, oz * nx - ox * nz, ox * ny - oy * nx
            ux, uy, uz = ux - wx, uy - wy, uz - wz
            vn = ux * nx + uy * ny + uz * nz
            tx, ty, tz = ux - vn * nx, uy - vn * ny, uz - vn * nz
            damp = -ratio * r.damping * sqrt(mass * r.stiffness) * vn
            limit = mu * abs(normal + damp)

            # tangential spring: turns with the contact, softens with it, slides
            kt = weight * shear * r.radius
            size2 = s0 * s0 + s1 * s1 + s2 * s2
            sn = s0 * nx + s1 * ny + s2 * nz
            s0 -= sn * nx
            s1 -= sn * ny
            s2 -= sn * nz
            flat2 = s0 * s0 + s1 * s1 + s2 * s2
            turn = sqrt(size2 / (flat2 + 1e-300)) if flat2 > 0.0 else 0.0
            per_kt = 1.0 / kt if kt > 0.0 else 0.0
            soften = min(kt * per_old, 1.0) if per_old > 0.0 else 1.0
            held2 = size2 * per_old  # twice the energy before
            s0 *= turn
            s1 *= turn
            s2 *= turn
            f0 = soften * s0 - kt * dt * tx
            f1 = soften * s1 - kt * dt * ty
            f2 = soften * s2 - kt * dt * tz
            total = sqrt(f0 * f0 + f1 * f1 + f2 * f2)
            cut = limit / (total + 1e-300) if total > limit else 1.0
            f0 *= cut
            f1 *= cut
            f2 *= cut
            # the dashpot counts towards the limit, but never stretches the spring
            gt = ratio * r.damping * sqrt(mass * kt)
            g0, g1, g2 = f0 - gt * tx, f1 - gt * ty, f2 - gt * tz
            total = sqrt(g0 * g0 + g1 * g1 + g2 * g2)
            cut = limit / (total + 1e-300) if total > limit else 1.0
            g0 *= cut
            g1 *= cut
            g2 *= cut
            held = (f0 * f0 + f1 * f1 + f2 * f2) * per_kt
            # work against the mean of the old force, at its lever, and the new one; and
            # what dashpots take
            slid = -0.5 * dt * ((s0 + f0) * tx + (s1 + f1) * ty + (s2 + f2) * tz)
            slid += 0.5 * dt * approach * per_d * (s0 * wx + s1 * wy + s2 * wz)
            eddy = -dt * ((g0 - f0) * tx + (g1 - f1) * ty + (g2 - f2) * tz)

            m0 = m1 = m2 = 0.0
            if rolling:
                q = roll_row * W + c
                wx, wy, wz = ax - bx, ay - by, az - bz
                wn = wx * nx + wy * ny + wz * nz
                wx, wy, wz = wx - wn * nx, wy - wn * ny, wz - wn * nz
                kr = kt * star * star
                b0, b1, b2 = S[q], S[q + W], S[q + 2 * W]
                old = (b0 * b0 + b1 * b1 + b2 * b2) * per_old / (star * star)
                bn = b0 * nx + b1 * ny + b2 * nz
                b0, b1, b2 = b0 - bn * nx, b1 - bn * ny, b2 - bn * nz
                ease = soften * soften * soften
                m0 = ease * b0 - kr * dt * wx
                m1 = ease * b1 - kr * dt * wy
                m2 = ease * b2 - kr * dt * wz
                most = mu_roll * star * abs(normal)
                torque = sqrt(m0 * m0 + m1 * m1 + m2 * m2)
                rolls = most / (torque + 1e-300) if torque > most else 1.0
                m0, m1, m2 = m0 * rolls, m1 * rolls, m2 * rolls
                S[q], S[q + W], S[q + 2 * W] = m0, m1, m2
                slid -= 0.5 * dt * ((b0 + m0) * wx + (b1 + m1) * wy + (b2 + m2) * wz)
                held += (m0 * m0 + m1 * m1 + m2 * m2) / (kr + 1e-300)
                held2 += old

            S[h], S[h + W], S[h + 2 * W] = f0, f1, f2
            S[h + 3 * W], S[h + 4 * W] = per_kt, normal
            S[h + 5 * W], S[h + 6 * W] = r.stored, damp

            push = normal + damp
            fx, fy, fz = push * nx + g0, push * ny + g1, push * nz + g2
            t0, t1, t2 = ny * fz - nz * fy, nz * fx - nx * fz, nx * fy - ny * fx
            stiff, lever = max(r.stiffness, 3.5 * kt), ra * arm
            o = out_a * W + c
            S[o], S[o + W], S[o + 2 * W] = fx, fy, fz
            o = (out_a + TORQUE) * W + c
            S[o] = m0 - lever * t0
            S[o + W] = m1 - lever * t1
            S[o + 2 * W] = m2 - lever * t2
            S[(out_a + STIFF) * W + c] = stiff
            o = out_b * W + c
            S[o], S[o + W], S[o + 2 * W] = -fx, -fy, -fz
            o, lever = (out_b + TORQUE) * W + c, rb * arm
            S[o] = -(m0 + lever * t0)
            S[o + W] = -(m1 + lever * t1)
            S[o + 2 * W] = -(m2 + lever * t2)
            S[(out_b + STIFF) * W + c] = stiff
            S[deep * W + c] = (ra + rb - d) * (apart * per_outer)
            e = ledger * W + c
            S[e] = r.stored + 0.5 * held
            spent = 0.5 * (normal_old + normal) * approach - (r.stored - stored_old)
            if worked:
                spent -= S[(out_a + worked) * W + c]
                spent -= 0.0 if is_wall else S[(out_b + worked) * W + c]
            S[e + W] = spent
            S[e + 2 * W] = slid - 0.5 * (held - held2)
            S[e + 3 * W] = 0.5 * (damp_old + damp) * approach + eddy
            # energy from nothing: more of it than the trapezoid may err by; a radius that
            # grows moves the contact and widens it too, at the cost of the particle
            closer = approach
            if grows:
                closer += S[grown_a * W + c]
                closer += 0.0 if is_wall else S[grown_b * W + c]
            spent += abs(normal_old + normal) * (closer - approach)
            spent += 0.5 * abs((normal - normal_old) * closer)
            noise = 1e-9 * (abs(normal_old * closer) + abs(r.stored) + abs(stored_old))
            S[e + 4 * W] = spent if spent < -noise else 0.0

    return _jit.njit(batch)
