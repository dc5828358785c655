"""Small set-ups that the engine and its naive twin can both run."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from pestle.engine import scratch as ct
from pestle.engine import step as st
from pestle.engine.engine import Engine, PairRule
from pestle.laws import Hertz, Solid, Zunker2024

Array = np.ndarray[Any, Any]

GLASS = Solid(youngs_modulus=1e8, poisson_ratio=0.25, density=2500.0)
SOFT = Solid(youngs_modulus=1e8, poisson_ratio=0.3, density=1500.0, yield_stress=1e6)
HARD = Solid(youngs_modulus=3e8, poisson_ratio=0.2, density=2500.0, yield_stress=6e6)
RIGID = Solid()


@dataclass(frozen=True, kw_only=True)
class Wall:
    """A plane or cylinder that moves along `drive` with a constant velocity."""

    point: tuple[float, ...] = (0.0, 0.0, 0.0)
    normal: tuple[float, ...] = (0.0, 0.0, 1.0)
    radius: float = 0.0  # of a cylinder; 0 means a plane [m]
    height: float = 0.0
    speed: float = 0.0  # along `drive` [m/s]
    drive: tuple[float, ...] | None = None  # the normal if None
    solid: int = 1


@dataclass(frozen=True, kw_only=True)
class Setup:
    """Particles, walls and rules; the default is one material and a rigid tool."""

    position: Array
    radius: Array
    law: Any = field(default_factory=Hertz)
    solids: tuple[Solid, ...] = (GLASS, RIGID)
    particle_solids: int = 1
    rules: dict[tuple[int, int], PairRule] = field(default_factory=dict)
    velocity: Any = 0.0
    spin: Any = 0.0
    material: Any = 0
    walls: tuple[Wall, ...] = ()
    gravity: tuple[float, ...] = (0.0, 0.0, 0.0)
    rolling: bool = False
    stretched: bool = False
    lengths: tuple[float, ...] = (0.0, 0.0, 0.0)  # periodic where not 0
    rate: tuple[float, ...] = (0.0, 0.0, 0.0)  # of the box [1/s]
    step: float | None = None  # None: as the engine chooses
    skin: float = 0.0

    def but(self, **changes: Any) -> "Setup":
        return replace(self, **changes)

    def density(self) -> Array:
        kind = np.zeros(len(self.radius), int) + self.material
        return np.array([self.solids[m].density for m in kind])

    def engine(self) -> Engine:
        count = len(self.radius)
        engine = Engine(
            law=self.law,
            solids=list(self.solids),
            rules=self.rules,
            particle_solids=self.particle_solids,
            gravity=np.array(self.gravity),
            rolling=self.rolling,
            stretched=self.stretched,
            skin=self.skin,
        )
        rows, moves = [], []
        for wall in self.walls:
            kind = 1.0 if wall.radius else 0.0
            shape = (wall.radius, 0.0, wall.height, 1.0, wall.solid)
            rows.append((kind, *wall.point, *wall.normal, *shape))
            moves.append((*(wall.drive or wall.normal), *[0.0] * 7))
        engine.set_walls(rows, moves)
        for w, wall in enumerate(self.walls):
            if wall.speed:
                engine.set_program(w, np.array([0.0, 1e9]), np.full(2, wall.speed))
        periodic = np.array(self.lengths) > 0.0
        engine.box[0] = np.where(periodic, self.lengths, 1.0)
        engine.box[1] = np.where(periodic, 1.0 / engine.box[0], 0.0)
        engine.box[2] = self.rate
        if self.step is not None:
            engine.clock[st.AUTO] = 0.0
            engine.clock[st.DT] = engine.clock[st.DT_MAX] = self.step
        kind = np.zeros(count, int) + self.material
        engine.set_particles(self.position, self.radius, kind, self.density())
        order = engine.ids - 1
        engine.vel[:, :3] = (np.zeros((count, 3)) + self.velocity)[order]
        engine.vel[:, 4:7] = (np.zeros((count, 3)) + self.spin)[order]
        return engine


def by_id(engine: Engine, name: str) -> Array:
    """Rows of a particle array in the order of creation."""
    rows: Array = getattr(engine, name)[np.argsort(engine.ids)]
    return rows


def run(engine: Engine, steps: int) -> Engine:
    """Advance, and insist that nothing stopped the run."""
    assert engine.advance(steps) == st.RAN
    return engine


def total(engine: Engine) -> float:
    """Kinetic, stored and gravity energy [J]."""
    return float(engine.sums[[st.KINETIC, st.STORED, st.GRAVITY]].sum())


def lost(engine: Engine) -> float:
    """Dissipated energy [J]."""
    return float(engine.sums[[st.PLASTIC, st.SLIDING, st.DAMPED]].sum())


def box_walls(low: Any, high: Any, **options: Any) -> tuple[Wall, ...]:
    """Six planes that look inwards."""
    walls = []
    for axis in range(3):
        for side, place in ((1.0, low), (-1.0, high)):
            normal, point = [0.0] * 3, [0.0] * 3
            normal[axis], point[axis] = side, float(np.broadcast_to(place, 3)[axis])
            walls.append(Wall(point=tuple(point), normal=tuple(normal), **options))
    return tuple(walls)


def packing(
    count: int, *, seed: int = 1, radius: float = 1.0, spread: float = 0.2,
    spacing: float = 1.9, lower: Any = (0.0, 0.0, 0.0),
) -> tuple[Array, Array]:  # fmt: skip
    """Positions and radii on a jittered cubic grid, particles overlapping a little."""
    random = np.random.default_rng(seed)
    side = int(np.ceil(count ** (1 / 3) - 1e-9))
    grid = np.array(np.unravel_index(np.arange(count), (side,) * 3)).T
    place = (grid + 0.5 + random.uniform(-0.06, 0.06, (count, 3))) * spacing * radius
    sizes = radius * (1.0 + spread * random.uniform(-0.5, 0.5, count))
    return place + np.array(lower), sizes


MDR = Zunker2024()


def pair(
    radius: tuple[float, ...], *, law: Any = MDR, solids: tuple[Solid, ...] = (SOFT,),
    work_of_adhesion: float = 0.0, step: float = 1.0, gap: float = 0.0,
) -> Setup:  # fmt: skip
    """Two spheres on the z axis (one above a rigid wall), too heavy to be moved.

    Moved with `press`, they give the answer of a contact to any path of overlaps.
    """
    heavy = [replace(solid, density=1e30 * solid.youngs_modulus) for solid in solids]
    adhesion = PairRule(work_of_adhesion=work_of_adhesion)
    count = len(heavy)
    place = np.zeros((len(radius), 3))
    place[-1, 2] = sum(radius) + gap
    return Setup(
        law=law, position=place, radius=np.array(radius), solids=(*heavy, RIGID),
        particle_solids=count, material=np.arange(len(radius)) % count, step=step,
        rules={(a, b): adhesion for a in range(count) for b in range(count + 1)},
        walls=(Wall(solid=count),) if len(radius) == 1 else (),
    )  # fmt: skip


def press(engine: Engine, depth: float, steps: int) -> Array:
    """Move the upper sphere of a `pair` down by `depth` [m] in equal steps.

    Returns a row before and one after each step: overlap [m], force [N], stored and
    dissipated energy [J].  The speed is changed between two steps, at rest, so that the
    ledger of the engine takes no notice.
    """
    step, rows = float(engine.clock[st.DT]), []
    upper = int(np.argmax(engine.pos[:, 2]))
    for n in range(steps + 1):
        engine.clock[st.DT] = step if n < steps else 0.0  # last: only look
        if n == 0:
            engine.vel[upper, 2] = -depth / steps / step
        places = engine.pos[:, 2]
        overlap = engine.pos[:, 3].sum() - (places.max() - places.min())
        if len(places) == 1:
            overlap = engine.pos[0, 3] - places[0]
        run(engine, 1)
        push = engine.whist if len(places) == 1 else engine.hist
        force = push[0, ct.HISTORY - 3] if len(push) else 0.0
        rows.append((overlap, force, engine.sums[st.STORED], engine.sums[st.PLASTIC]))
    engine.clock[st.DT] = step
    return np.array(rows)
