"""List of particles near walls: one slot each, several and the triangles for a mesh."""

from typing import Any

from pestle import _jit
from pestle.engine import walls as wl
from pestle.engine.mesh import BASE, CELLS, EDGE, NORMAL
from pestle.engine.walls import towards_wall

SLOTS = 6  # contacts followed for a particle and a mesh
# columns of `gap`: vector to the centre 3, its square, the square a step ago, point in
# the body's frame 3, whether the slot is in use
SQUARE, BEFORE, AT, USED, GAP = 3, 4, 5, 8, 9


@_jit.njit
def closest(
    x: float, y: float, z: float, face: Any, t: int
) -> tuple[float, float, float, int]:
    """Vector from the nearest point of a triangle [m] and the feature that it lies on.

    0 the face, 1, 2, 3 the edges ab, bc, ca, 4, 5, 6 the corners a, b, c.
    """
    ax, ay, az = face[t, 0], face[t, 1], face[t, 2]
    bx, by, bz = face[t, 3] - ax, face[t, 4] - ay, face[t, 5] - az
    cx, cy, cz = face[t, 6] - ax, face[t, 7] - ay, face[t, 8] - az
    px, py, pz = x - ax, y - ay, z - az
    d1 = bx * px + by * py + bz * pz
    d2 = cx * px + cy * py + cz * pz
    if d1 <= 0.0 and d2 <= 0.0:
        return px, py, pz, 4
    qx, qy, qz = px - bx, py - by, pz - bz
    d3 = bx * qx + by * qy + bz * qz
    d4 = cx * qx + cy * qy + cz * qz
    if d3 >= 0.0 and d4 <= d3:
        return qx, qy, qz, 5
    if d1 * d4 - d3 * d2 <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        s = d1 / (d1 - d3)
        return px - s * bx, py - s * by, pz - s * bz, 1
    rx, ry, rz = px - cx, py - cy, pz - cz
    d5 = bx * rx + by * ry + bz * rz
    d6 = cx * rx + cy * ry + cz * rz
    if d6 >= 0.0 and d5 <= d6:
        return rx, ry, rz, 6
    if d5 * d2 - d1 * d6 <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        s = d2 / (d2 - d6)
        return px - s * cx, py - s * cy, pz - s * cz, 3
    if d3 * d6 - d5 * d4 <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        s = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return qx - s * (cx - bx), qy - s * (cy - by), qz - s * (cz - bz), 2
    nx, ny, nz = face[t, NORMAL], face[t, NORMAL + 1], face[t, NORMAL + 2]
    h = px * nx + py * ny + pz * nz
    return h * nx, h * ny, h * nz, 0


@_jit.njit
def to_body(
    pos: Any, i: int, wall: Any, body: Any, w: int
) -> tuple[float, float, float]:
    """Place of a particle in the frame of a mesh [m]."""
    x = pos[i, 0] - wall[w, wl.POINT]
    y = pos[i, 1] - wall[w, wl.POINT + 1]
    z = pos[i, 2] - wall[w, wl.POINT + 2]
    r = wl.TURN
    return (
        body[w, r] * x + body[w, r + 3] * y + body[w, r + 6] * z,
        body[w, r + 1] * x + body[w, r + 4] * y + body[w, r + 7] * z,
        body[w, r + 2] * x + body[w, r + 5] * y + body[w, r + 8] * z,
    )


@_jit.njit
def near_triangles(
    x: float, y: float, z: float, reach: float, w: int, mesh: Any, mark: Any, sign: int,
    out: Any, filled: int,
) -> int:  # fmt: skip
    """Append the triangles within reach of a point to `out`; return how many there are."""
    bins = mesh.bins
    size = bins[w, EDGE]
    nx, ny, nz = (
        int(bins[w, CELLS]),
        int(bins[w, CELLS + 1]),
        int(bins[w, CELLS + 2]),
    )
    fx, fy, fz = x - bins[w, 0], y - bins[w, 1], z - bins[w, 2]
    if fx + reach < 0.0 or fy + reach < 0.0 or fz + reach < 0.0:
        return filled
    if fx - reach > nx * size or fy - reach > ny * size or fz - reach > nz * size:
        return filled
    x0, x1 = max(int((fx - reach) / size), 0), min(int((fx + reach) / size), nx - 1)
    y0, y1 = max(int((fy - reach) / size), 0), min(int((fy + reach) / size), ny - 1)
    z0, z1 = max(int((fz - reach) / size), 0), min(int((fz + reach) / size), nz - 1)
    base = int(bins[w, BASE])
    for a in range(x0, x1 + 1):
        for b in range(y0, y1 + 1):
            for c in range(z0, z1 + 1):
                cell = base + (a * ny + b) * nz + c
                for s in range(mesh.cell[cell], mesh.cell[cell + 1]):
                    t = mesh.inside[s]
                    if mark[t] == sign:
                        continue
                    mark[t] = sign
                    vx, vy, vz, _ = closest(x, y, z, mesh.face, t)
                    if vx * vx + vy * vy + vz * vz < reach * reach:
                        if filled < out.shape[0]:
                            out[filled] = t
                        filled += 1
    return filled


@_jit.njit
def wall_list(
    pos: Any, wall: Any, body: Any, mesh: Any, reach: float, mark: Any, wp: Any, ww: Any,
    first: Any, slot: Any, mfirst: Any, listed: Any, fill: bool,
) -> tuple[int, int, int]:  # fmt: skip
    """Fill the list of particles near walls, by particle, or only count.

    A plane or cylinder takes one slot; a mesh takes `SLOTS`, the first of which stands
    in `slot`, and the triangles mfirst[k]:mfirst[k + 1] of `listed`.
    """
    total = pairs = triangles = 0
    mark[:] = 0
    for i in range(pos.shape[0]):
        first[i] = total
        r = pos[i, 3] + reach
        for w in range(wall.shape[0]):
            if wall[w, wl.ACTIVE] == 0.0:
                continue
            places = 1
            if wall[w, wl.KIND] == wl.MESH:
                x, y, z = to_body(pos, i, wall, body, w)
                before = triangles
                triangles = near_triangles(
                    x, y, z, r, w, mesh, mark, i + 1, listed, triangles
                )
                if triangles == before:
                    continue
                if fill:
                    slot[pairs], mfirst[pairs] = total, before
                pairs += 1
                places = SLOTS
            else:
                x, y, z = towards_wall(pos[i, 0], pos[i, 1], pos[i, 2], wall, w)
                if x * x + y * y + z * z >= r * r:
                    continue
            if fill:
                wp[total : total + places] = i
                ww[total : total + places] = w
            total += places
    first[pos.shape[0]] = total
    if fill:
        mfirst[pairs] = triangles
    return total, pairs, triangles


@_jit.njit
def carry_walls(
    order: Any, old_first: Any, old_w: Any, old_hist: Any, old_flag: Any, old_gap: Any,
    first: Any, ww: Any, hist: Any, flag: Any, gap: Any,
) -> None:  # fmt: skip
    """Copy the histories of wall contacts to the new list."""
    for i in range(first.shape[0] - 1):
        a = order[i]
        place = 0  # among the slots of one mesh
        for s in range(first[i], first[i + 1]):
            place = place + 1 if s > first[i] and ww[s] == ww[s - 1] else 0
            for run in range(old_first[a], old_first[a + 1]):
                if old_w[run] == ww[s]:
                    o = run + place
                    flag[s] = old_flag[o]
                    if gap.shape[0] > 0 and old_gap.shape[0] > 0:
                        gap[s] = old_gap[o]
                    if old_flag[o] != 0:
                        for q in range(hist.shape[1]):
                            hist[s, q] = old_hist[o, q]
                    break
