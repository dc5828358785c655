"""What is read off the engine's arrays: frames of results, density, coordination."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pestle.engine import scratch as ct
from pestle.engine import walls as wl
from pestle.engine.walls import towards_wall
from pestle.laws._base import Nothing
from pestle.results.write import NO_MESH

if TYPE_CHECKING:
    from pestle.engine.engine import Engine
    from pestle.engine.mesh import Surface

Array = npt.NDArray[Any]


def column(engine: "Engine", hist: Array, name: str) -> Array | None:
    """One field of the law's state over contacts, None if the law has no such field."""
    fields = engine.parts.state._fields  # type: ignore[attr-defined]
    if name not in fields:
        return None
    return hist[:, engine.layout.state_row - ct.H0 + fields.index(name)]


def _contact_columns(
    engine: "Engine", hist: Array, kind: Array, weight: Array, vector: Array
) -> dict[str, Array]:
    """Columns that pairs and wall contacts share; `vector` points to the first."""
    distance = np.linalg.norm(vector, axis=1)
    normal = vector / np.maximum(distance, 1e-300)[:, None]
    push = hist[:, ct.HISTORY - 3]
    shear = engine.table[kind, ct.SHEAR] * np.maximum(weight, 1e-12)
    stiffness = np.divide(
        1.0, hist[:, 3], out=np.zeros(len(hist)), where=hist[:, 3] > 0.0
    )
    area = np.pi * (stiffness / shear) ** 2
    pressure = np.divide(push, area, out=np.zeros_like(area), where=area > 0.0)
    offset = column(engine, hist, "offset_i")
    other = column(engine, hist, "offset_j")
    yielded = np.zeros(len(hist), np.int64)
    if offset is not None and other is not None:
        yielded = ((offset < 0.0) | (other < 0.0)).astype(np.int64)
    return {
        "force": hist[:, 0:3] + push[:, None] * normal,
        "normal": normal,
        "area": area,
        "pressure": pressure,
        "yielded": yielded,
        "distance": distance,
    }


def contact_table(engine: "Engine") -> dict[str, Array]:
    """All contacts that carry a force, pairs first, walls as second = -1 - wall."""
    s = np.flatnonzero((engine.flag & 1 != 0) & (engine.hist[:, 4] != 0.0))
    a, b = engine.pa[s], engine.pb[s]
    vector = engine.pos[a, :3] - engine.pos[b, :3]
    for c in np.flatnonzero(engine.box[1] > 0.0):
        vector[:, c] -= engine.box[0, c] * np.round(vector[:, c] / engine.box[0, c])
    solids = len(engine.solids)
    kind = engine.mat[a] * solids + engine.mat[b]
    pairs = _contact_columns(engine, engine.hist[s], kind, engine.weight[s], vector)
    ra, rb, d = engine.pos[a, 3], engine.pos[b, 3], pairs.pop("distance")
    flat = column(engine, engine.hist[s], "flat_i")
    if flat is None:
        near = 0.5 * (d + (ra * ra - rb * rb) / np.maximum(d, 1e-300))
    else:
        near = engine.field[a, 0] - flat
    pairs |= {
        "first": engine.ids[a],
        "second": engine.ids[b],
        "overlap": ra + rb - d,
        "flat": near,
    }
    s = np.flatnonzero((engine.wflag & 1 != 0) & (engine.whist[:, 4] != 0.0))
    p, w = engine.wp[s], engine.ww[s]
    vector = np.array(
        [
            engine.gap[q, :3]
            if engine.wall[j, wl.KIND] == wl.MESH
            else towards_wall(*engine.pos[i, :3], engine.wall, j)
            for q, i, j in zip(s, p, w, strict=True)
        ]
    ).reshape(-1, 3)
    kind = engine.mat[p] * solids + engine.wall[w, wl.MATERIAL].astype(np.int64)
    walls = _contact_columns(engine, engine.whist[s], kind, np.ones(len(s)), vector)
    d = walls.pop("distance")
    walls |= {
        "first": engine.ids[p],
        "second": -1 - w.astype(np.int64),
        "overlap": engine.pos[p, 3] - d,
        "flat": d,
    }
    return {k: np.concatenate([pairs[k], walls[k]]) for k in pairs}


def particle_table(engine: "Engine", contacts: dict[str, Array]) -> dict[str, Array]:
    """All particles in the order of their ids."""
    order = np.argsort(engine.ids)
    n = len(order)
    place = np.empty(int(engine.ids.max()) + 1, np.int64)
    place[engine.ids[order]] = np.arange(n)
    multi = engine.parts.particle is not Nothing
    first = engine.field[order, 0] if multi else engine.pos[order, 3]
    virial = np.zeros((n, 3, 3))
    plastic = np.zeros(n, np.int64)
    one = place[contacts["first"]]
    couple = contacts["force"][:, :, None] * contacts["normal"][:, None, :]
    np.add.at(virial, one, couple * contacts["flat"][:, None, None])
    np.add.at(plastic, one, contacts["yielded"])
    pair = contacts["second"] > 0
    two = place[contacts["second"][pair]]
    span = _span(engine, contacts, pair)
    far = (span - contacts["flat"][pair])[:, None, None]
    np.add.at(virial, two, couple[pair] * far)
    np.add.at(plastic, two, contacts["yielded"][pair])
    volume = solid_volumes(engine)[order]
    table = {
        "id": engine.ids[order],
        "position": engine.pos[order, :3],
        "radius": engine.pos[order, 3],
        "radius_initial": first,
        "velocity": engine.vel[order, :3],
        "angular_velocity": engine.vel[order, 4:7],
        "material": engine.mat[order],
        "stress": virial / volume[:, None, None],
        "plastic_contacts": plastic,
        "psi": engine.field[order, 2] if multi else np.ones(n),
    }
    return table


def mesh_table(engine: "Engine", surfaces: dict[int, "Surface"]) -> dict[str, Array]:
    """Triangles of all walls that are there, where they are now."""
    corner, triangle, wall = ([NO_MESH[k]] for k in ("corner", "triangle", "wall"))
    for w, surface in surfaces.items():
        if engine.wall[w, wl.ACTIVE] > 0.0:
            turn = engine.body[w, wl.TURN : wl.TURN + 9].reshape(3, 3)
            point = engine.wall[w, wl.POINT : wl.POINT + 3]
            triangle.append(surface.faces + sum(map(len, corner)))
            corner.append(surface.vertices @ turn.T + point)
            wall.append(np.full(len(surface.faces), w))
    return {
        "corner": np.concatenate(corner),
        "triangle": np.concatenate(triangle),
        "wall": np.concatenate(wall),
    }


def _span(engine: "Engine", contacts: dict[str, Array], pair: Array) -> Array:
    """Distance of the centres of each pair [m]."""
    radius = np.zeros(int(engine.ids.max()) + 1)
    radius[engine.ids] = engine.pos[:, 3]
    one, two = contacts["first"][pair], contacts["second"][pair]
    return radius[one] + radius[two] - contacts["overlap"][pair]


def solid_volumes(engine: "Engine") -> Array:
    """Volume of each particle [m^3]: MDR's elastic volume, else sphere without caps."""
    if engine.parts.particle is not Nothing:
        return engine.field[:, 1]
    r = engine.pos[:, 3]
    volume = 4.0 / 3.0 * np.pi * r**3
    s = np.flatnonzero(engine.flag & 1)
    a, b = engine.pa[s], engine.pb[s]
    vector = engine.pos[a, :3] - engine.pos[b, :3]
    for c in np.flatnonzero(engine.box[1] > 0.0):
        vector[:, c] -= engine.box[0, c] * np.round(vector[:, c] / engine.box[0, c])
    d = np.linalg.norm(vector, axis=1)
    near = 0.5 * (d + (r[a] ** 2 - r[b] ** 2) / np.maximum(d, 1e-300))
    for i, h in ((a, r[a] - near), (b, r[b] - (d - near))):
        h = np.clip(h, 0.0, r[i])
        np.subtract.at(volume, i, np.pi * h * h * (3.0 * r[i] - h) / 3.0)
    return volume


def coordination(engine: "Engine") -> float:
    """Mean number of contacts of a particle that carry force [-]."""
    pairs = np.count_nonzero((engine.flag & 1 != 0) & (engine.hist[:, 4] != 0.0))
    walls = np.count_nonzero((engine.wflag & 1 != 0) & (engine.whist[:, 4] != 0.0))
    return (2.0 * pairs + walls) / max(len(engine.pos), 1)
