"""The bed of all benchmarks: a dense random packing in a box of six rigid walls.

Solid fraction 0.64, radii spread by +-10 %, about three contacts per particle; the
particles move slowly, so that neighbour lists have to be rebuilt now and then.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pestle.engine import step
from pestle.engine.engine import Engine, PairRule
from pestle.laws import Hertz, Solid, Zunker2024

Array = npt.NDArray[Any]

SOLID = Solid(youngs_modulus=1e9, poisson_ratio=0.3, density=1500.0, yield_stress=5e7)
RADIUS = 1e-3  # mean radius [m]
SPREAD = 0.1  # half-width of the uniform distribution of radii [-]
FRACTION = 0.64  # solid fraction [-]
FRICTION = 0.5
DAMPING = 0.4  # factor on sqrt(m* k)
PSI_B = 0.1  # MDR: free-surface fraction where the bulk response begins
SKIN = 0.1 * 2 * RADIUS
REBUILD = 50  # steps between two rebuilds of the neighbour lists
ADHESION = 50.0  # of the adhesive variant [J/m^2]


@dataclass(frozen=True, slots=True, kw_only=True)
class Bed:
    """Places, sizes and velocities of the particles in a cubic box."""

    position: Array
    radius: Array
    velocity: Array
    side: float
    time_step: float


def make_bed(count: int, seed: int = 1) -> Bed:
    """Melt a lattice of spheres, then let it come to rest under strong damping."""
    random = np.random.default_rng(seed)
    radius = RADIUS * (1.0 + SPREAD * random.uniform(-1.0, 1.0, count))
    side = float(np.sum(4.0 / 3.0 * np.pi * radius**3) / FRACTION) ** (1.0 / 3.0)
    per_side = int(np.ceil(count ** (1.0 / 3.0)))
    inner = side - 2.0 * RADIUS
    ticks = RADIUS + np.arange(per_side) * inner / (per_side - 1)
    lattice = np.stack(np.meshgrid(ticks, ticks, ticks, indexing="ij"), -1)
    place = lattice.reshape(-1, 3)[random.permutation(per_side**3)[:count]]
    place = place + RADIUS * random.uniform(-0.3, 0.3, place.shape)
    soft = Bed(
        position=np.clip(place, 0.9 * RADIUS, side - 0.9 * RADIUS),
        radius=radius,
        velocity=np.zeros_like(place),
        side=side,
        time_step=0.0,
    )
    engine = make_engine(soft, "hertz", friction=0.0, damping=1.0, fixed_step=False)
    engine.advance(3000)
    order = np.argsort(engine.ids)
    place, longest = engine.pos[order, :3], engine.clock[step.DT]
    # a slow random motion: a particle crosses half the skin in about 100 steps
    speed = 0.5 * SKIN / (100 * longest)
    return Bed(
        position=place,
        radius=radius,
        velocity=speed * random.normal(0.0, 0.2, place.shape),
        side=side,
        time_step=float(longest),
    )


def make_engine(
    bed: Bed,
    law: Any,
    *,
    adhesion: float = 0.0,
    friction: float = FRICTION,
    damping: float = DAMPING,
    fixed_step: bool = True,
) -> Engine:
    """Engine with the bed in it, ready to run; `law` by name or as an object."""
    named = {"hertz": Hertz(), "mdr": Zunker2024(psi_b=PSI_B)}
    engine = Engine(
        law=named[law] if isinstance(law, str) else law,
        solids=[SOLID, Solid()],
        rules={
            (0, 0): PairRule(
                sliding_friction=friction, damping=damping, work_of_adhesion=adhesion
            ),
            (0, 1): PairRule(sliding_friction=friction, damping=damping),
        },
        skin=SKIN,
    )
    walls, drives = [], []
    for axis in range(3):
        for way in (1.0, -1.0):
            point, normal = np.zeros(3), np.zeros(3)
            point[axis], normal[axis] = 0.0 if way > 0 else bed.side, way
            walls.append([0, *point, *normal, 0, 0, 0, 1, 1])
            drives.append([*normal, *np.zeros(7)])
    engine.set_walls(walls, drives)
    if fixed_step:
        engine.clock[step.AUTO] = 0.0
        engine.clock[step.DT] = engine.clock[step.DT_MAX] = bed.time_step
    count = len(bed.radius)
    solids = np.zeros(count, np.int64)
    engine.set_particles(
        bed.position, bed.radius, solids, np.full(count, SOLID.density)
    )
    engine.vel[:, :3] = bed.velocity[engine.ids - 1]
    return engine


def run_steps(engine: Engine, steps: int) -> None:
    """Advance with one rebuild per `REBUILD` steps, whatever the engine chooses."""
    for _ in range(steps // REBUILD):
        engine.skin = SKIN
        engine.rebuild()
        why = engine.advance(REBUILD)
        if why != step.RAN:
            raise SystemExit(f"the benchmark's bed stopped with reason {why}")
