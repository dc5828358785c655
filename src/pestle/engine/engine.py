"""State of a simulation as arrays, and what is done to it between compiled runs."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from pestle.engine import lists
from pestle.engine import scratch as ct
from pestle.engine import step as st
from pestle.engine import wall_lists as ls
from pestle.engine import walls as wl
from pestle.engine.mesh import Surface, pack
from pestle.errors import InputError
from pestle.laws._base import Geometry, Nothing, Pair, Parts, Solid, parts_of

Array = npt.NDArray[Any]

# arrays that make up a checkpoint: everything that the next step depends on
SAVED = (
    "pos",
    "vel",
    "mat",
    "ids",
    "field",
    "ref",
    "first",
    "pa",
    "pb",
    "hist",
    "flag",
    "weight",
    "dist",
    "wfirst",
    "wp",
    "ww",
    "whist",
    "wflag",
    "wall",
    "move",
    "total",
    "program",
    "lengths",
    "box",
    "clock",
    "sums",
    "report",
    "wref",
    "body",
    "motion",
    "turns",
    "gap",
    "slot",
    "mfirst",
    "mlisted",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PairRule:
    """What the engine itself needs of a pair of materials."""

    sliding_friction: float = 0.0
    rolling_friction: float = 0.0
    damping: float = 0.0  # factor on sqrt(m* k), twice the damping ratio [-]
    work_of_adhesion: float = 0.0  # [J/m^2]


@dataclass(kw_only=True)
class Engine:
    """Particles, contacts and walls of one simulation.

    Parameters
    ----------
    law : law object
        Contact law with its options.
    solids : list of Solid
        Materials of particles and walls; walls may be rigid.
    rules : dict
        `PairRule` of each pair of indices (i, j), i <= j.
    particle_solids : int
        The first so many solids are those of particles.
    """

    law: Any
    solids: list[Solid]
    rules: dict[tuple[int, int], PairRule]
    particle_solids: int = 1
    gravity: Array = field(default_factory=lambda: np.zeros(3))
    rolling: bool = False
    stretched: bool = False  # the sliding rule: spring and dashpot cut together
    safety: float = 0.2
    skin: float = 0.0
    beyond: float = 0.0  # reach beyond touch since the lists were built [m]
    rebuilds: int = 0
    since_rebuild: int = 0
    lost_contacts: int = 0
    # what `lists.divide` sets
    chunks: Array = field(init=False)
    pairs: Array = field(init=False)
    offset: Array = field(init=False)
    buf: Array = field(init=False)
    ledger: Array = field(init=False)

    def __post_init__(self) -> None:
        """Prepare the table of pairs and empty arrays."""
        self.parts: Parts = parts_of(self.law)
        self.layout = ct.Layout(self.parts, self.rolling)
        self.table = self._pair_table()
        self.constants = np.zeros((len(self.solids), 2))
        if self.parts.particle is not Nothing:
            for m in range(self.particle_solids):
                self.constants[m] = self.law.particle_constants(self.solids[m])
        self.box = np.zeros((4, 3))
        self.clock, self.sums = np.zeros(st.CLOCK), np.zeros(st.SUMS)
        self.clock[st.SAFETY], self.clock[st.AUTO] = self.safety, 1.0
        self.clock[st.SCALE] = 1.8
        self.report = np.zeros(2, np.int64)
        self.condition = np.zeros((0, 3))
        self.set_walls([], [])

    # ------------------------------------------------------------------ set-up

    def _pair_table(self) -> Array:
        count = len(self.solids)
        table = np.zeros((count * count, self.layout.constants))
        for a in range(self.particle_solids):
            for b in range(count):
                one, two = self.solids[a], self.solids[b]
                rule = self.rules.get((min(a, b), max(a, b)), PairRule())
                rigid = two.youngs_modulus == float("inf")
                pair = Pair(
                    first=one,
                    second=two,
                    work_of_adhesion=rule.work_of_adhesion,
                    wall=b >= self.particle_solids,
                )
                shear = (
                    pair.shear_modulus
                    if not rigid
                    else 1.0 / ((2.0 - one.poisson_ratio) / one.shear_modulus)
                )
                table[a * count + b, : self.layout.used] = (
                    rule.sliding_friction,
                    rule.rolling_friction,
                    rule.damping,
                    8.0 * shear,
                    *self.law.constants(pair),
                )
        return table

    def _zeros(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Constants of the law that are 0 among all particles, and with all walls."""
        count, n = len(self.solids), self.particle_solids
        rows = self.table.reshape(count, count, -1)[:n, :, ct.PAIR : self.layout.used]
        among, walls = (
            tuple(np.flatnonzero(~part.any(axis=(0, 1))).tolist()) if part.size else ()
            for part in (rows[:, :n], rows[:, n:])
        )
        return among, walls

    def set_particles(
        self, position: Array, radius: Array, mat: Array, density: Array
    ) -> None:
        """Place particles: positions (N, 3) [m], radii [m], solids, densities [kg/m^3]."""
        n = len(radius)
        self.pos = np.column_stack([position, radius]).astype(float)
        mass = 4.0 / 3.0 * np.pi * radius**3 * density
        self.vel = np.zeros((n, 8))
        self.vel[:, 3], self.vel[:, 7] = mass, 0.4 * mass * radius**2
        self.mat = np.asarray(mat, np.int64)
        self.ids = np.arange(1, n + 1, dtype=np.int64)
        self.field = np.zeros((n, max(self.layout.fields, 1)))
        if self.parts.particle is not Nothing:
            for i in range(n):
                known = self.law.particle(float(radius[i]))
                self.field[i, : len(known)] = known
        self.ref = self.pos.copy()
        self.first = np.zeros(n + 1, np.int64)
        self.pa = self.pb = np.empty(0, np.int32)
        self.hist, self.flag = np.empty((0, self.layout.history)), np.empty(0, np.uint8)
        self.weight = self.dist = np.empty(0)
        self.wfirst = np.zeros(n + 1, np.int64)
        self.wp = self.ww = np.empty(0, np.int32)
        self.whist, self.wflag = self.hist.copy(), self.flag.copy()
        self.gap = np.empty((0, ls.GAP))
        self.slot = self.mlisted = np.empty(0, np.int64)
        self.mfirst = np.zeros(1, np.int64)
        self.skin = self.skin or 0.2 * float(np.mean(radius))
        self.clock[st.DT_MAX] = self.clock[st.DT_MAX] or self.longest_step()
        self.clock[st.DT] = self.clock[st.DT] or self.clock[st.DT_MAX]
        self.rebuild()

    def longest_step(self) -> float:
        """Step for the softest touch worth resolving: an overlap of 1 % of R [s]."""
        best = np.inf
        for m in range(self.particle_solids):
            mine = self.mat == m
            if mine.any():
                pair = Pair(first=self.solids[m], second=self.solids[m])
                r = self.pos[mine, 3]
                stiffness = 2.0 * pair.modulus * 0.1 * r
                best = min(best, float(np.min(np.sqrt(self.vel[mine, 3] / stiffness))))
        return self.safety * best

    def set_walls(
        self,
        wall: list[Any],
        drive: list[Any],
        surfaces: dict[int, Surface] | None = None,
    ) -> None:
        """Set all walls: rows of the `wall` and `move` arrays of `engine.walls`.

        `surfaces` has the meshes of those of that kind.
        """
        surfaces = surfaces or {}
        self.wall = np.array(wall, float).reshape(len(wall), wl.WALL)
        self.move = np.array(drive, float).reshape(len(drive), wl.MOVE)
        self.total = np.zeros((len(wall), wl.TOTALS + 1))
        self.program = np.zeros((len(wall), 2, 2))
        self.lengths = np.zeros(len(wall), np.int64)
        self.wref = self.move[:, wl.DISPLACEMENT].copy()
        self.mesh = pack(surfaces, len(wall))
        self.body = np.zeros((len(wall), wl.BODY))
        for w, surface in surfaces.items():
            self.body[w] = wl.identity(surface.extent)
        self.motion = np.zeros((len(wall), 2, 7))
        self.turns = np.zeros(len(wall), np.int64)

    def set_motion(self, w: int, times: Array, velocity: Array, spin: Array) -> None:
        """Let a mesh follow a motion from now on, besides its drive.

        Times [s] from zero, velocities (n, 3) [m/s] and angular velocities (n, 3)
        [rad/s], linear in between.
        """
        longest = max(len(times), self.motion.shape[1])
        grown = np.zeros((len(self.wall), longest, 7))
        grown[:, : self.motion.shape[1]] = self.motion
        grown[w, : len(times)] = np.column_stack([times, velocity, spin])
        self.motion, self.turns[w] = grown, len(times)
        self.body[w, wl.BEGIN] = self.clock[st.TIME]

    def set_program(self, w: int, times: Array, speeds: Array) -> None:
        """Let a wall follow a piecewise linear velocity from now on [s], [m/s]."""
        longest = max(len(times), self.program.shape[1])
        grown = np.zeros((len(self.wall), longest, 2))
        grown[:, : self.program.shape[1]] = self.program
        grown[w, : len(times), 0], grown[w, : len(times), 1] = times, speeds
        self.program = grown
        self.lengths[w] = len(times)
        self.move[w, wl.MODE], self.move[w, wl.START] = wl.PROGRAM, self.clock[st.TIME]

    def hold_force(self, w: int, force: float, top_speed: float, relax: float) -> None:
        """Let a wall seek a force along its drive axis [N], at most so fast [m/s]."""
        self.move[w, wl.MODE] = wl.SERVO
        self.move[w, wl.TARGET : wl.RELAX + 1] = force, top_speed, relax

    def stop_wall(self, w: int) -> None:
        """Let a wall stand still."""
        self.move[w, wl.MODE], self.turns[w] = wl.FIXED, 0

    # ------------------------------------------------------------------ lists

    def cut(self) -> float:
        """Farthest reach of any pair beyond touch [m]."""
        big = float(self.pos[:, 3].max()) if len(self.pos) else 0.0
        most = 0.0
        for row in self.table[:, ct.PAIR : self.layout.used]:
            if row.any():
                k = self.parts.constants(*row)
                most = max(
                    most,
                    self.parts.reach(k, Geometry(0.0, big / 2, big, big, 1.0, 0.0)),
                )
        return most

    def rebuild(self) -> None:
        """Sort the particles, list all pairs within reach and skin, carry histories."""
        lists.rebuild(self)

    def keep(self, wanted: Array) -> None:
        """Take all particles away but the wanted ones (N,); `start` the ledger anew."""
        lists.rebuild(self, wanted)

    def divide(self) -> None:
        """Set chunks, buffers and candidate triples from the lists: no state of its own."""
        lists.divide(self)

    # ------------------------------------------------------------------ running

    def advance(self, steps: int) -> int:
        """Run up to so many steps; return the reason, lists rebuilt where needed."""
        kernel = st.compiled(
            self.parts,
            self.particle_solids == 1,
            self.rolling,
            self.stretched,
            bool((self.box[1] > 0.0).any()),
            bool((self.wall[:, wl.KIND] == wl.MESH).any()),
            self._zeros(),
        )
        while steps > 0:
            done, why = kernel(
                steps, self.clock, self.sums, self.gravity, self.condition,
                self.pos, self.vel, self.mat, self.field, self.ref, self.constants,
                self.pa, self.pb, self.hist, self.flag, self.weight, self.dist, self.tri,
                self.sides, self.wp, self.ww, self.whist, self.wflag,
                self.table, len(self.solids), self.wall, self.move, self.total, self.program,
                self.lengths, self.box, self.chunks, self.pairs, self.wpairs, self.last,
                self.offset, self.buf, self.scratch, self.listed, self.ledger, self.wtotal,
                self.report, self.wref, self.skin, self.beyond, self.body, self.motion, self.turns,
                self.mesh, self.gap, self.slot, self.mfirst, self.mlisted, self.mpairs,
                self.cand, self.chosen,
            )  # fmt: skip
            self.since_rebuild += done
            steps -= done
            if why == st.REBUILD or why >= 16:
                self.rebuild()
            if why not in (st.RAN, st.REBUILD):
                return int(why % 16)
        return st.RAN

    def start(self) -> None:
        """Evaluate the contacts that exist at the start, and begin the ledger there."""
        step, self.clock[st.DT] = float(self.clock[st.DT]), 0.0
        longest, self.clock[st.DT_MAX] = float(self.clock[st.DT_MAX]), 0.0
        before, self.condition = self.condition, np.zeros((0, 3))
        self.advance(1)
        self.condition = before
        self.clock[st.DT], self.clock[st.DT_MAX] = step, longest
        self.clock[st.DT_LAST] = 0.0
        self.report[0] -= 1
        stored = self.sums[st.STORED]
        self.sums[:] = 0.0
        self.sums[st.STORED] = stored
        self.total[:, wl.WORK] = 0.0

    @property
    def steps(self) -> int:
        """Steps done so far."""
        return int(self.report[0])

    @property
    def time(self) -> float:
        """Time [s]."""
        return float(self.clock[st.TIME])

    # ------------------------------------------------------------------ state

    def saved(self) -> dict[str, Array]:
        """Everything the next step depends on, for a checkpoint."""
        state = {name: getattr(self, name) for name in SAVED}
        state["counters"] = np.array(
            [self.rebuilds, self.since_rebuild, self.lost_contacts], np.int64
        )
        state["skin"] = np.array(self.skin)
        state["beyond"] = np.array(self.beyond)
        state["gravity"] = self.gravity
        return state

    def restore(self, state: dict[str, Array]) -> None:
        """Take over a checkpoint of the same set-up."""
        kept = state["hist"].shape[1], state["field"].shape[1]
        if kept != (self.layout.history, max(self.layout.fields, 1)):
            raise InputError(
                "checkpoint-version",
                "the checkpoint was written by a version of pestle whose "
                f"{self.law.name!r} remembers other quantities",
                hint="use the version that wrote it, or run anew",
            )
        for name in SAVED:
            setattr(self, name, np.array(state[name]))
        self.rebuilds, self.since_rebuild, self.lost_contacts = map(
            int, state["counters"]
        )
        self.skin, self.beyond = float(state["skin"]), float(state["beyond"])
        self.gravity = np.array(state["gravity"])
        self.divide()
