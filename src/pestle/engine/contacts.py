"""The contact pass: listed pairs -> overlap -> law -> forces, in blocks for SIMD.

Per block: detect without branches, gather into a flat scratch, one loop over the
contacts that calls the law, scatter into the chunk's private force buffer.  A contact
is oriented by persistent particle id: the side with the smaller id is `a`, and the
normal points from b to a.  Histories then need no knowledge of the law at a rebuild.
"""

from math import sqrt
from typing import Any

import numpy as np

from pestle import _jit
from pestle.laws._base import Geometry, Nothing, Parts

BLOCK = 128  # contacts in a block
W = BLOCK + 8  # length of a scratch row; no power of two: rows spread over the cache
# scratch rows
DX, D2, VX, OX, RA, RB, MASS, KIND, WEIGHT, WX = 0, 3, 4, 7, 10, 11, 12, 13, 14, 15
BEFORE = WEIGHT  # of a wall contact, which has no weight: squared distance a step ago
H0 = 18  # history: spring force 3, its stiffness, normal force, energy, damping force
HISTORY = 7
ROLLING = 3  # further history of the rolling spring
# pair table, columns before the law's constants
FRICTION, ROLL, DAMPING, SHEAR, PAIR = 0, 1, 2, 3, 4
# columns of a force buffer before the law's sums
FORCE, TORQUE, STIFF, COLUMNS = 0, 3, 6, 7
# ledger of a chunk
STORED, PLASTIC, SLIDING, DAMPED, NEGATIVE, NEGATIVES, TOUCHING, DEEPEST, WHERE = range(
    9
)
LEDGER = 16


def loader(kind: type, base: int) -> Any:
    """Compiled function that reads a NamedTuple of floats from scratch rows."""
    length = len(kind._fields)  # type: ignore[attr-defined]
    if length == 0:
        return _jit.inline(lambda scratch, c: kind())

    def step(count: int) -> Any:
        row = (base + count - 1) * W
        if count == 1:
            return _jit.inline(lambda scratch, c: (scratch[row + c],))
        before = step(count - 1)
        return _jit.inline(lambda scratch, c: before(scratch, c) + (scratch[row + c],))

    fields = step(length)
    return _jit.inline(lambda scratch, c: kind(*fields(scratch, c)))


def saver(kind: type, base: int) -> Any:
    """Compiled function that writes a NamedTuple of floats to scratch rows."""
    length = len(kind._fields)  # type: ignore[attr-defined]

    def step(index: int) -> Any:
        if index == length:
            return _jit.inline(lambda scratch, c, values: None)
        row, after = (base + index) * W, step(index + 1)

        def save(scratch: Any, c: int, values: Any) -> None:
            scratch[row + c] = values[index]
            after(scratch, c, values)

        return _jit.inline(save)

    return step(0)


def table_loader(kind: type, base: int, zeros: tuple[int, ...] = ()) -> Any:
    """Compiled function that reads a NamedTuple from a row of the pair table.

    Fields in `zeros` are compiled in as 0: what a law does only for them falls away.
    """
    length = len(kind._fields)  # type: ignore[attr-defined]

    def step(count: int) -> Any:
        column = base + count - 1
        if count == 0:
            return _jit.inline(lambda table, row: ())
        before = step(count - 1)
        if count - 1 in zeros:
            return _jit.inline(lambda table, row: before(table, row) + (0.0,))
        return _jit.inline(
            lambda table, row: before(table, row) + (table[row, column],)
        )

    if length == 0:
        return _jit.inline(lambda table, row: kind())
    fields = step(length)
    return _jit.inline(lambda table, row: kind(*fields(table, row)))


class Layout:
    """Where the parts of a law lie in scratch, history and buffers."""

    def __init__(self, law: Parts, rolling: bool) -> None:
        size = lambda kind: len(kind._fields)
        self.state = size(law.state)
        self.fields = size(law.particle)
        self.sums = size(law.sums)
        self.history = HISTORY + (ROLLING if rolling else 0) + self.state
        self.state_row = H0 + self.history - self.state
        self.field_row = H0 + self.history
        self.out = self.field_row + 2 * self.fields
        self.sum_row = self.out + 12
        self.ledger_row = self.sum_row + 2 * self.sums
        self.rows = self.ledger_row + 5
        self.columns = COLUMNS + self.sums


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
    state, save_state = (
        loader(law.state, layout.state_row),
        saver(law.state, layout.state_row),
    )
    fields_a = loader(law.particle, layout.field_row)
    fields_b = loader(law.particle, layout.field_row + layout.fields)
    save_a = saver(law.sums, layout.sum_row)
    save_b = saver(law.sums, layout.sum_row + layout.sums)
    out, ledger = layout.out, layout.ledger_row
    roll_row = H0 + HISTORY

    def batch(S: Any, m: int, table: Any, dt: float) -> None:
        k = constants(table, 0)
        mu, mu_roll = table[0, FRICTION], table[0, ROLL]
        ratio, shear = table[0, DAMPING], table[0, SHEAR]
        for c in range(m):
            if not uniform:
                kind = np.int64(S[KIND * W + c])
                k = constants(table, kind)
                mu, mu_roll = table[kind, FRICTION], table[kind, ROLL]
                ratio, shear = table[kind, DAMPING], table[kind, SHEAR]
            x, y, z = S[c], S[W + c], S[2 * W + c]
            d2 = S[D2 * W + c]
            d = sqrt(d2)
            ux, uy, uz = S[VX * W + c], S[(VX + 1) * W + c], S[(VX + 2) * W + c]
            ra, rb, mass = S[RA * W + c], S[RB * W + c], S[MASS * W + c]
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
            # four inverses by one division
            apart, least = before + d, ra if is_wall else min(ra, rb)
            inner, outer = d * (ra + rb), apart * least
            inverse = 1.0 / (inner * outer)
            per_inner, per_outer = outer * inverse, inner * inverse
            per_d, per_sum = (ra + rb) * per_inner, d * per_inner
            approach = (before2 - d2) * (least * per_outer)
            nx, ny, nz = x * per_d, y * per_d, z * per_d
            star = ra if is_wall else ra * rb * per_sum
            arm = d * per_sum
            h = H0 * W + c
            s0, s1, s2 = S[h], S[h + W], S[h + 2 * W]
            stiff_old, normal_old = S[h + 3 * W], S[h + 4 * W]
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
                S[OX * W + c] * arm,
                S[(OX + 1) * W + c] * arm,
                S[(OX + 2) * W + c] * arm,
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
            per_old = 1.0 / stiff_old if stiff_old > 0.0 else 0.0
            soften = kt * per_old if kt < stiff_old else 1.0
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
            held = (f0 * f0 + f1 * f1 + f2 * f2) / kt if kt > 0.0 else 0.0
            # work against the mean of the old force, at its lever, and the new one; and
            # what dashpots take
            slid = -0.5 * dt * ((s0 + f0) * tx + (s1 + f1) * ty + (s2 + f2) * tz)
            slid += 0.5 * dt * approach * per_d * (s0 * wx + s1 * wy + s2 * wz)
            eddy = -dt * ((g0 - f0) * tx + (g1 - f1) * ty + (g2 - f2) * tz)

            m0 = m1 = m2 = 0.0
            if rolling:
                q = roll_row * W + c
                wx, wy, wz = S[WX * W + c], S[(WX + 1) * W + c], S[(WX + 2) * W + c]
                wn = wx * nx + wy * ny + wz * nz
                wx, wy, wz = wx - wn * nx, wy - wn * ny, wz - wn * nz
                kr = kt * star * star
                b0, b1, b2 = S[q], S[q + W], S[q + 2 * W]
                old = (b0 * b0 + b1 * b1 + b2 * b2) / (stiff_old * star * star + 1e-300)
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
                held2 += old if stiff_old > 0.0 else 0.0

            S[h], S[h + W], S[h + 2 * W] = f0, f1, f2
            S[h + 3 * W], S[h + 4 * W] = kt, normal
            S[h + 5 * W], S[h + 6 * W] = r.stored, damp

            push = normal + damp
            fx, fy, fz = push * nx + g0, push * ny + g1, push * nz + g2
            o = out * W + c
            S[o], S[o + W], S[o + 2 * W] = fx, fy, fz
            S[o + 3 * W] = ny * fz - nz * fy
            S[o + 4 * W] = nz * fx - nx * fz
            S[o + 5 * W] = nx * fy - ny * fx
            S[o + 6 * W], S[o + 7 * W], S[o + 8 * W] = m0, m1, m2
            S[o + 9 * W] = arm
            S[o + 10 * W] = max(r.stiffness, 3.5 * kt)
            S[o + 11 * W] = (ra + rb - d) * (apart * per_outer)
            e = ledger * W + c
            S[e] = r.stored + 0.5 * held
            S[e + W] = 0.5 * (normal_old + normal) * approach - (r.stored - stored_old)
            S[e + 2 * W] = slid - 0.5 * (held - held2)
            S[e + 3 * W] = 0.5 * (damp_old + damp) * approach + eddy
            S[e + 4 * W] = abs(normal_old * approach) + r.stored + stored_old

    return _jit.njit(batch)


def make_tally() -> Any:
    """Build the sum of a block's ledger rows into its chunk's ledger."""

    def tally(
        S: Any, m: int, row: int, deep_row: int, ledger: Any, listed: Any
    ) -> None:
        stored = spent = slid = damped = negative = negatives = touching = 0.0
        deepest, where = ledger[DEEPEST], ledger[WHERE]
        for c in range(m):
            e = row * W + c
            plastic = S[e + W]
            stored += S[e]
            spent += plastic
            slid += S[e + 2 * W]
            damped += S[e + 3 * W]
            negatives += 1.0 if plastic < -1e-3 * S[e + 4 * W] else 0.0
            negative += min(plastic, 0.0)
            deep = S[deep_row * W + c]
            touching += 1.0 if deep > 0.0 else 0.0
            if not deep <= deepest:  # also catches NaN
                deepest = deep
                where = np.float64(listed[c])
        ledger[STORED] += stored
        ledger[PLASTIC] += spent
        ledger[SLIDING] += slid
        ledger[DAMPED] += damped
        ledger[NEGATIVES] += negatives
        ledger[NEGATIVE] += negative
        ledger[TOUCHING] += touching
        ledger[DEEPEST], ledger[WHERE] = deepest, where

    return _jit.njit(tally)


def make_pair_chunk(
    law: Parts,
    layout: Layout,
    *,
    uniform: bool,
    rolling: bool,
    periodic: bool,
    zeros: tuple[int, ...],
) -> Any:
    """Build the contact pass over one chunk of the pair list."""
    batch = make_batch(
        law, layout, is_wall=False, uniform=uniform, rolling=rolling, zeros=zeros
    )
    tally = make_tally()
    history, fields, sums = layout.history, layout.fields, layout.sums
    field_row, sum_row, out = layout.field_row, layout.sum_row, layout.out
    ledger_row = layout.ledger_row
    keeps = law.particle is not Nothing
    screened = law.screened

    def chunk(
        pos: Any,
        vel: Any,
        mat: Any,
        field: Any,
        pa: Any,
        pb: Any,
        hist: Any,
        flag: Any,
        weight: Any,
        dist: Any,
        table: Any,
        materials: int,
        buf: Any,
        S: Any,
        listed: Any,
        k0: int,
        k1: int,
        shift: int,
        dt: float,
        cut: float,
        box: Any,
        ledger: Any,
    ) -> None:
        U = np.uint64
        k = k0
        while k < k1:
            m = 0
            stop = min(k1, k + BLOCK)
            for n in range(k, stop):
                s = U(n)
                a, b = U(pa[s]), U(pb[s])
                dx, dy, dz = (
                    pos[a, 0] - pos[b, 0],
                    pos[a, 1] - pos[b, 1],
                    pos[a, 2] - pos[b, 2],
                )
                if periodic:
                    dx -= box[0, 0] * np.floor(dx * box[1, 0] + 0.5)
                    dy -= box[0, 1] * np.floor(dy * box[1, 1] + 0.5)
                    dz -= box[0, 2] * np.floor(dz * box[1, 2] + 0.5)
                rs = pos[a, 3] + pos[b, 3]
                d2 = dx * dx + dy * dy + dz * dz
                near = d2 < (rs + cut) * (rs + cut)
                if screened:
                    dist[s] = d2 if d2 < rs * rs else -1.0
                listed[m] = n
                S[m], S[W + m], S[2 * W + m], S[D2 * W + m] = dx, dy, dz, d2
                m += near | ((flag[s] & 1) != 0)
            k = stop
            for c in range(m):
                s = U(listed[c])
                a, b = U(pa[s]), U(pb[s])
                ra, rb, ma, mb = pos[a, 3], pos[b, 3], vel[a, 3], vel[b, 3]
                S[RA * W + c], S[RB * W + c], S[MASS * W + c] = (
                    ra,
                    rb,
                    ma * mb / (ma + mb),
                )
                for v in range(3):
                    S[(VX + v) * W + c] = vel[a, v] - vel[b, v]
                    S[(OX + v) * W + c] = ra * vel[a, 4 + v] + rb * vel[b, 4 + v]
                    if rolling:
                        S[(WX + v) * W + c] = vel[a, 4 + v] - vel[b, 4 + v]
                    if periodic:
                        S[(VX + v) * W + c] += box[2, v] * S[v * W + c]
                if not uniform:
                    S[KIND * W + c] = np.float64(mat[a] * materials + mat[b])
                S[WEIGHT * W + c] = weight[s] if screened else 1.0
                if flag[s] != 0:
                    for q in range(history):
                        S[(H0 + q) * W + c] = hist[s, q]
                else:
                    for q in range(history):
                        S[(H0 + q) * W + c] = 0.0
                for q in range(fields):
                    S[(field_row + q) * W + c] = field[a, q]
                    S[(field_row + fields + q) * W + c] = field[b, q]
            batch(S, m, table, dt)
            for c in range(m):
                s = U(listed[c])
                rs = S[RA * W + c] + S[RB * W + c]
                near = S[D2 * W + c] < (rs + cut) * (rs + cut)
                flag[s] = 3 if near else (2 if keeps else 0)
                for q in range(history):
                    hist[s, q] = S[(H0 + q) * W + c]
                a, b = U(np.int64(pa[s]) + shift), U(np.int64(pb[s]) + shift)
                arm = S[(out + 9) * W + c]
                la, lb = S[RA * W + c] * arm, S[RB * W + c] * arm
                for v in range(3):
                    f, t = S[(out + v) * W + c], S[(out + 3 + v) * W + c]
                    r = S[(out + 6 + v) * W + c]
                    buf[a, v] += f
                    buf[b, v] -= f
                    if periodic:  # work of the deforming box, against the contact
                        ledger[15] -= f * box[2, v] * S[v * W + c] * dt
                    buf[a, 3 + v] += r - la * t
                    buf[b, 3 + v] -= r + lb * t
                stiff = S[(out + 10) * W + c]
                buf[a, STIFF] += stiff
                buf[b, STIFF] += stiff
                for v in range(sums):
                    buf[a, COLUMNS + v] += S[(sum_row + v) * W + c]
                    buf[b, COLUMNS + v] += S[(sum_row + sums + v) * W + c]
            tally(S, m, ledger_row, out + 11, ledger, listed)

    return _jit.njit(chunk)


def make_wall_chunk(
    law: Parts, layout: Layout, *, rolling: bool, zeros: tuple[int, ...]
) -> Any:
    """Build the contact pass of one chunk's particles against the walls."""
    from pestle.engine.walls import towards_wall

    batch = make_batch(
        law, layout, is_wall=True, uniform=False, rolling=rolling, zeros=zeros
    )
    tally = make_tally()
    history, fields, sums = layout.history, layout.fields, layout.sums
    field_row, sum_row, out = layout.field_row, layout.sum_row, layout.out
    ledger_row = layout.ledger_row
    keeps = law.particle is not Nothing

    def chunk(
        pos: Any,
        vel: Any,
        mat: Any,
        field: Any,
        wp: Any,
        ww: Any,
        hist: Any,
        flag: Any,
        table: Any,
        materials: int,
        wall: Any,
        move: Any,
        total: Any,
        buf: Any,
        S: Any,
        listed: Any,
        k0: int,
        k1: int,
        shift: int,
        dt: float,
        cut: float,
        ledger: Any,
    ) -> None:
        U = np.uint64
        total[:, :] = 0.0
        k = k0
        while k < k1:
            m = 0
            stop = min(k1, k + BLOCK)
            for n in range(k, stop):
                s = U(n)
                a, w = U(wp[s]), U(ww[s])
                dx, dy, dz = towards_wall(pos[a, 0], pos[a, 1], pos[a, 2], wall, w)
                r = pos[a, 3] + cut
                d2 = dx * dx + dy * dy + dz * dz
                near = (d2 < r * r) & (wall[w, 10] > 0.0)
                listed[m] = n
                S[m], S[W + m], S[2 * W + m], S[D2 * W + m] = dx, dy, dz, d2
                m += near | ((flag[s] & 1) != 0)
            k = stop
            for c in range(m):
                s = U(listed[c])
                a, w = U(wp[s]), U(ww[s])
                ra = pos[a, 3]
                S[RA * W + c], S[RB * W + c], S[MASS * W + c] = ra, 0.0, vel[a, 3]
                for v in range(3):
                    S[(VX + v) * W + c] = vel[a, v] - move[w, v] * move[w, 5]
                    S[(OX + v) * W + c] = ra * vel[a, 4 + v]
                    S[(WX + v) * W + c] = vel[a, 4 + v]
                S[KIND * W + c] = np.float64(mat[a] * materials) + wall[w, 11]
                dx, dy, dz = towards_wall(  # a step ago, as seen from the wall
                    pos[a, 0] - dt * S[VX * W + c],
                    pos[a, 1] - dt * S[(VX + 1) * W + c],
                    pos[a, 2] - dt * S[(VX + 2) * W + c],
                    wall,
                    w,
                )
                S[BEFORE * W + c] = dx * dx + dy * dy + dz * dz
                if flag[s] != 0:
                    for q in range(history):
                        S[(H0 + q) * W + c] = hist[s, q]
                else:
                    for q in range(history):
                        S[(H0 + q) * W + c] = 0.0
                if wall[w, 10] == 0.0:  # taken away: the contact ends here
                    S[D2 * W + c] = 4.0 * (ra + cut) * (ra + cut) + 1e-300
                    S[BEFORE * W + c] = S[D2 * W + c]  # no work is done on it
                for q in range(fields):
                    S[(field_row + q) * W + c] = field[a, q]
                    S[(field_row + fields + q) * W + c] = field[a, q]
            batch(S, m, table, dt)
            for c in range(m):
                s = U(listed[c])
                w = U(ww[s])
                r = S[RA * W + c] + cut
                near = S[D2 * W + c] < r * r
                flag[s] = 3 if near else (2 if keeps else 0)
                for q in range(history):
                    hist[s, q] = S[(H0 + q) * W + c]
                a = U(np.int64(wp[s]) + shift)
                arm = S[RA * W + c] * S[(out + 9) * W + c]
                for v in range(3):
                    f = S[(out + v) * W + c]
                    buf[a, v] += f
                    buf[a, 3 + v] += (
                        S[(out + 6 + v) * W + c] - arm * S[(out + 3 + v) * W + c]
                    )
                    total[w, v] += f
                total[w, 3] += S[(H0 + 4) * W + c]
                total[w, 4] += S[(out + 10) * W + c]
                buf[a, STIFF] += S[(out + 10) * W + c]
                for v in range(sums):
                    buf[a, COLUMNS + v] += S[(sum_row + v) * W + c]
            tally(S, m, ledger_row, out + 11, ledger, listed)

    return _jit.njit(chunk)
