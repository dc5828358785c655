"""Contacts of particles with triangle meshes: which points of a mesh act on a sphere.

A contact is a point of the mesh whose distance from the centre is a local minimum: in
the middle of a face, on an edge if no face that meets there comes nearer, at a vertex
if no edge does.  Of two such points of one smooth surface whose directions differ by
less than 30 degrees only the nearer one counts; so a finely faceted hollow acts like the
smooth one, while the faces of a sharp corner act each.  Up to `SLOTS` contacts, the
nearest, are followed for each particle and mesh.

Each contact keeps its slot, and with it its history, as its point wanders over the mesh:
it is found again by the point that is nearest to the last one, in the body's frame.
"""

from math import sqrt
from typing import Any

import numpy as np

from pestle import _jit
from pestle.engine import walls as wl
from pestle.engine.mesh import ACROSS, CREASE, NORMAL
from pestle.engine.wall_lists import AT, BEFORE, SLOTS, SQUARE, USED, closest, to_body

CANDIDATES = 64  # local minima looked at for a particle and a mesh
# columns of the candidates: vector 3 and point 3 in the body's frame, distance while not
# looked at, distance, smooth surface; and, by rank, the slot of each contact
LEFT, DISTANCE, SURFACE, SLOT, COLUMNS = 6, 7, 8, 9, 10
OUTSIDE = 1e-7  # by how much a direction may leave the cone of its feature [-]
SAME = 1e-12  # square of the angle between directions that are one [-]


@_jit.njit
def is_minimum(x: float, y: float, z: float, feature: int, mesh: Any, t: int) -> bool:
    """Whether no neighbour of a triangle's feature comes nearer than its point."""
    if feature == 0:
        return True
    most = OUTSIDE * sqrt(x * x + y * y + z * z)
    if feature < 4:
        k = ACROSS + 3 * (feature - 1)
        face = mesh.face
        return x * face[t, k] + y * face[t, k + 1] + z * face[t, k + 2] <= most
    v = mesh.corner[t, feature - 4]
    for s in range(mesh.ring[v], mesh.ring[v + 1]):
        way = mesh.spoke[s]
        if x * way[0] + y * way[1] + z * way[2] > most:
            return False
    return True


@_jit.njit
def select(cand: Any, m: int, chosen: Any) -> int:
    """Choose the contacts among `m` minima, the nearest first; return their number."""
    count = 0
    for _ in range(m):
        best = -1
        for q in range(m):
            if cand[q, LEFT] < 1e300 and (best < 0 or cand[q, LEFT] < cand[best, LEFT]):
                best = q
        if best < 0 or count == SLOTS:
            break
        d = cand[best, LEFT]
        counts = True
        for n in range(count):
            o = chosen[n]
            apart = along = 0.0
            for v in range(3):
                one, two = cand[best, v] / d, cand[o, v] / cand[o, DISTANCE]
                apart += (one - two) ** 2
                along += one * two
            near = cand[best, SURFACE] == cand[o, SURFACE] and along > CREASE
            if near or apart < SAME:
                counts = False
        cand[best, LEFT] = 1e301  # looked at
        cand[best, DISTANCE] = d
        if counts:
            chosen[count] = best
            count += 1
    return count


@_jit.njit
def free_slot(gap: Any, flag: Any, s0: int) -> int:
    """Slot for a contact that is new; what another remembered there is forgotten."""
    best = -1
    for s in range(s0, s0 + SLOTS):
        if gap[s, USED] <= 0.0:
            empty = gap[s, USED] == 0.0 and flag[s] == 0
            if best < 0 or empty:
                best = s
            if empty:
                break
    flag[best] = 0
    return best


@_jit.njit
def gather_contacts(
    pos: Any, vel: Any, wall: Any, body: Any, mesh: Any, wp: Any, ww: Any, flag: Any,
    gap: Any, slot: Any, first: Any, listed: Any, k0: int, k1: int, dt: float, cut: float,
    cand: Any, chosen: Any,
) -> None:  # fmt: skip
    """Find the contacts of pairs k0:k1 of particles and meshes; fill their slots.

    The slots of pair k begin at slot[k], its triangles are first[k]:first[k + 1] of
    `listed`.
    """
    rot = wl.TURN
    for k in range(k0, k1):
        s0 = slot[k]
        i, w = wp[s0], ww[s0]
        x, y, z = to_body(pos, i, wall, body, w)
        ra = pos[i, 3]
        far = 1.05 * ra + cut
        m = 0
        if wall[w, wl.ACTIVE] > 0.0:
            for e in range(first[k], first[k + 1]):
                t = listed[e]
                h = (x - mesh.face[t, 0]) * mesh.face[t, NORMAL]
                h += (y - mesh.face[t, 1]) * mesh.face[t, NORMAL + 1]
                h += (z - mesh.face[t, 2]) * mesh.face[t, NORMAL + 2]
                if abs(h) > far:
                    continue
                vx, vy, vz, feature = closest(x, y, z, mesh.face, t)
                d2 = vx * vx + vy * vy + vz * vz
                if d2 >= far * far or not is_minimum(vx, vy, vz, feature, mesh, t):
                    continue
                q = m
                if m == CANDIDATES:  # replace the farthest
                    q = 0
                    for n in range(1, m):
                        if cand[n, LEFT] > cand[q, LEFT]:
                            q = n
                    if d2 >= cand[q, LEFT] ** 2:
                        continue
                else:
                    m += 1
                d = sqrt(d2)
                if d < 1e-12 * ra:  # centre on the surface: along the normal
                    d = 1e-12 * ra
                    vx = d * mesh.face[t, NORMAL]
                    vy = d * mesh.face[t, NORMAL + 1]
                    vz = d * mesh.face[t, NORMAL + 2]
                cand[q, 0], cand[q, 1], cand[q, 2] = vx, vy, vz
                cand[q, 3], cand[q, 4], cand[q, 5] = x - vx, y - vy, z - vz
                cand[q, LEFT] = d
                cand[q, SURFACE] = np.float64(mesh.corner[t, 3])
        count = select(cand, m, chosen)
        # which slot each contact was in: pairs of new and old points, the nearest first
        for n in range(count):
            cand[n, SLOT] = -1.0
        for s in range(s0, s0 + SLOTS):
            gap[s, USED] = -gap[s, USED]  # in use before: -1
        for _ in range(count):
            nearest, new, old = 0.36 * ra * ra, -1, -1
            for n in range(count):
                if cand[n, SLOT] >= 0.0:
                    continue
                for s in range(s0, s0 + SLOTS):
                    if gap[s, USED] == -1.0 or (gap[s, USED] == 0.0 and flag[s] == 2):
                        apart = 0.0
                        for v in range(3):
                            apart += (cand[chosen[n], 3 + v] - gap[s, AT + v]) ** 2
                        if apart < nearest:
                            nearest, new, old = apart, n, s
            if new < 0:
                break
            cand[new, SLOT] = np.float64(old)
            gap[old, BEFORE] = gap[old, SQUARE] if gap[old, USED] < 0.0 else -1.0
            gap[old, USED] = 1.0
        for n in range(count):
            q = chosen[n]
            s = int(cand[n, SLOT])
            if s < 0:
                s = free_slot(gap, flag, s0)
                gap[s, USED], gap[s, BEFORE] = 1.0, -1.0
            vx, vy, vz, d = cand[q, 0], cand[q, 1], cand[q, 2], cand[q, DISTANCE]
            speed = 0.0
            for v in range(3):
                r = rot + 3 * v
                gap[s, v] = body[w, r] * vx + body[w, r + 1] * vy + body[w, r + 2] * vz
                gap[s, AT + v] = cand[q, 3 + v]
            gap[s, SQUARE] = d * d
            if gap[s, BEFORE] < 0.0:  # not looked at a step ago
                u0, u1, u2 = wl.surface_velocity(
                    pos[i, 0] - gap[s, 0],
                    pos[i, 1] - gap[s, 1],
                    pos[i, 2] - gap[s, 2],
                    wall,
                    body,
                    w,
                )
                speed += gap[s, 0] * (vel[i, 0] - u0)
                speed += gap[s, 1] * (vel[i, 1] - u1)
                speed += gap[s, 2] * (vel[i, 2] - u2)
                before = max(d - dt * speed / d, 0.0)
                gap[s, BEFORE] = before * before
        for s in range(s0, s0 + SLOTS):
            if gap[s, USED] <= 0.0:
                gap[s, USED] = 0.0
                gap[s, SQUARE] = gap[s, BEFORE] = 1e300
