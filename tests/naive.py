"""The engine again, slow and obvious: no lists, no blocks, no compiler.

Every pair is looked at in every step; a contact law is called as a plain function.  The
order of a step is the engine's: forces at the places of now with the velocities of half
a step ago, kick, drift, walls, particle states, screening weights.
"""

from dataclasses import dataclass, field
from math import acos, exp, pi, sqrt
from typing import Any

import numpy as np

from pestle.laws import Geometry, Nothing, Pair, parts_of


def norm(v: Any) -> float:
    return sqrt(v @ v)


def cross(a: Any, b: Any) -> Any:
    return np.array(
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    )


@dataclass
class Memory:
    """What one contact remembers."""

    state: Any
    spring: Any = field(default_factory=lambda: np.zeros(3))
    bend: Any = field(default_factory=lambda: np.zeros(3))
    stiffness: float = 0.0  # of the tangential spring
    normal: float = 0.0
    near: bool = False


class Twin:
    """A set-up (`engine.setups.Setup`) and its state."""

    def __init__(self, setup: Any) -> None:
        self.setup, self.parts = setup, parts_of(setup.law)
        count = len(setup.radius)
        self.x, self.r = np.array(setup.position, float), np.array(setup.radius)
        self.v = np.zeros((count, 3)) + setup.velocity
        self.w = np.zeros((count, 3)) + setup.spin
        self.mass = 4 / 3 * pi * self.r**3 * setup.density()
        self.inertia = 0.4 * self.mass * self.r**2
        self.kind = np.zeros(count, int) + setup.material
        self.lengths = np.array(setup.lengths, float)
        self.points = [np.array(wall.point, float) for wall in setup.walls]
        self.multi = self.parts.particle is not Nothing
        self.fields = [setup.law.particle(r) for r in self.r] if self.multi else []
        self.memory: dict[tuple[int, int], Memory] = {}
        self.weight: dict[tuple[int, int], float] = {}
        self.wall_force = np.zeros((len(setup.walls), 3))
        self.last = self.stored = 0.0
        self.pairs = {ab: self.pair(*ab) for ab in self.ordered_rules()}
        g = Geometry(0, 1, self.r.max(), self.r.max(), 1, 0)
        self.cut = max(self.parts.reach(k, g) for _, k, _ in self.pairs.values())

    def ordered_rules(self) -> list[tuple[int, int]]:
        count = range(self.setup.particle_solids)
        both = [*self.setup.rules, *[(b, a) for a, b in self.setup.rules]]
        return [(a, b) for a, b in both if a in count]

    def pair(self, a: int, b: int) -> tuple[Any, Any, float]:
        """Rule, constants of the law and tangential stiffness per contact radius."""
        one, two = self.setup.solids[a], self.setup.solids[b]
        rule = self.setup.rules[min(a, b), max(a, b)]
        wall = b >= self.setup.particle_solids
        both = Pair(
            first=one, second=two, work_of_adhesion=rule.work_of_adhesion, wall=wall
        )
        ease = (2 - one.poisson_ratio) / one.shear_modulus
        if np.isfinite(two.youngs_modulus):
            ease += (2 - two.poisson_ratio) / two.shear_modulus
        return rule, self.setup.law.constants(both), 8 / ease

    def image(self, arm: Any) -> Any:
        """Nearest periodic image of a distance vector."""
        with np.errstate(divide="ignore", invalid="ignore"):
            jumps = np.where(self.lengths > 0, np.round(arm / self.lengths), 0.0)
        return arm - self.lengths * jumps

    def touch(self, key, arm, size, mass, slip, spins, pair, weight):  # type: ignore
        """Force on the first, rolling torque, lever and what the law adds, or None.

        `slip` is the relative velocity of the centres, `spins` both angular velocities.
        """
        d, (ra, rb) = norm(arm), size
        near = d < ra + rb + self.cut
        if not near and not (key in self.memory and self.memory[key].near):
            return None
        (rule, k, shear), dt = pair, self.last
        m = self.memory.setdefault(key, Memory(self.zero(self.parts.state)))
        m.near, n = near, arm / d
        star = ra * rb / (ra + rb) if rb else ra
        g = Geometry(ra + rb - d, star, ra, rb, weight, m.normal)
        i, j = key
        adds: tuple[Any, ...] = (None, None)
        if not self.multi:
            response, m.state = self.parts.contact(k, g, m.state)
        elif j < 0:
            response, m.state, *adds = self.parts.wall(k, g, m.state, self.fields[i])
        else:
            response, m.state, *adds = self.parts.contact(
                k, g, m.state, self.fields[i], self.fields[j]
            )
        # surfaces at the point of contact, which divides the distance as the radii
        lever = d / (ra + rb)
        u = slip - cross((ra * spins[0] + rb * spins[1]) * lever, n)
        normal_speed, across = u @ n, u - (u @ n) * n
        damping = rule.damping * response.damping
        damp = -damping * sqrt(mass * response.stiffness) * normal_speed
        # tangential spring: turn into the plane at its length, soften, stretch, slide
        kt = weight * shear * response.radius
        flat = m.spring - (m.spring @ n) * n
        turned = norm(flat)
        if turned > 0:
            flat *= norm(m.spring) / turned
        soften = min(kt / m.stiffness, 1.0) if m.stiffness > 0 else 1.0
        limit = rule.sliding_friction * abs(response.force + damp)
        spring = flat * soften - kt * dt * across
        if not self.setup.stretched:
            spring *= min(limit / max(norm(spring), 1e-300), 1.0)
        drag = damping * sqrt(mass * kt) * across
        friction = spring - drag
        friction *= min(limit / max(norm(friction), 1e-300), 1.0)
        m.spring = friction + drag if self.setup.stretched else spring
        torque = np.zeros(3)
        if self.setup.rolling:
            roll = spins[0] - spins[1]
            bend = (m.bend - (m.bend @ n) * n) * soften**3
            bend = bend - kt * star**2 * dt * (roll - (roll @ n) * n)
            most = rule.rolling_friction * star * abs(response.force)
            if norm(bend) > most:
                bend *= most / norm(bend)
            m.bend = torque = bend
        m.stiffness, m.normal = kt, response.force
        if not near and not self.multi:
            del self.memory[key]  # forgotten; a multi-neighbour law remembers
        self.stored += response.stored
        if kt > 0:
            self.stored += 0.5 * m.spring @ m.spring / kt
            self.stored += 0.5 * m.bend @ m.bend / (kt * star**2)
        return (response.force + damp) * n + friction, torque, lever, n, adds

    def zero(self, kind: Any) -> Any:
        return kind(*[0.0] * len(kind._fields))

    def forces(self) -> tuple[Any, Any, Any]:
        count = len(self.r)
        force, moment = np.zeros((count, 3)), np.zeros((count, 3))
        sums = np.zeros((count, len(self.parts.sums._fields)))
        self.wall_force[:], self.stored, rate = 0.0, 0.0, np.array(self.setup.rate)
        for i in range(count):
            for j in range(i + 1, count):
                arm = self.image(self.x[i] - self.x[j])
                got = self.touch(
                    (i, j), arm, (self.r[i], self.r[j]),
                    self.mass[i] * self.mass[j] / (self.mass[i] + self.mass[j]),
                    (self.v[i] - self.v[j] + rate * arm) / (1 + rate * self.last),
                    (self.w[i], self.w[j]), self.pairs[self.kind[i], self.kind[j]],
                    self.weight.get((i, j), 1.0),
                )  # fmt: skip
                if got:
                    f, torque, lever, n, adds = got
                    force[i] += f
                    force[j] -= f
                    moment[i] += torque - self.r[i] * lever * cross(n, f)
                    moment[j] += -torque - self.r[j] * lever * cross(n, f)
                    if self.multi:
                        sums[i] += adds[0]
                        sums[j] += adds[1]
            for w, wall in enumerate(self.setup.walls):
                drive = np.array(wall.drive or wall.normal) * wall.speed
                got = self.touch(
                    (i, -1 - w), self.towards(w, self.x[i]), (self.r[i], 0.0),
                    self.mass[i], self.v[i] - drive * (self.last > 0),
                    (self.w[i], np.zeros(3)), self.pairs[self.kind[i], wall.solid], 1.0,
                )  # fmt: skip
                if got:
                    f, torque, lever, n, adds = got
                    force[i] += f
                    self.wall_force[w] += f
                    moment[i] += torque - self.r[i] * lever * cross(n, f)
                    if self.multi:
                        sums[i] += adds[0]
        return force, moment, sums

    def towards(self, w: int, x: Any) -> Any:
        """Vector from the nearest point of a wall."""
        wall, from_point = self.setup.walls[w], x - self.points[w]
        axis = np.array(wall.normal)
        height = from_point @ axis
        if not wall.radius:
            return height * axis
        out = from_point - height * axis
        beyond = height - np.clip(height, 0.0, wall.height)
        return out - wall.radius * out / norm(out) + beyond * axis

    def step(self, dt: float) -> None:
        force, moment, sums = self.forces()
        kick = 0.5 * (self.last + dt)
        self.v += kick * (force / self.mass[:, None] + np.array(self.setup.gravity))
        self.w += kick * moment / self.inertia[:, None]
        before = self.x.copy()
        self.x += dt * (self.v + np.array(self.setup.rate) * self.x)
        for w, wall in enumerate(self.setup.walls):
            self.points[w] += np.array(wall.drive or wall.normal) * wall.speed * dt
        if self.multi:
            if self.parts.screened:
                self.screen(before)
            for i, kind in enumerate(self.kind):
                constants = self.setup.law.particle_constants(self.setup.solids[kind])
                self.r[i], self.fields[i] = self.parts.update(
                    constants, self.r[i], self.fields[i], self.parts.sums(*sums[i])
                )
                self.stored += getattr(self.fields[i], "energy", 0.0)
        self.lengths *= 1.0 + np.array(self.setup.rate) * dt
        self.last = dt

    def screen(self, x: Any) -> None:
        """Weigh each pair that overlaps, from the places `x`."""
        count = len(self.r)
        arm = self.image(x[:, None] - x[None])
        distance = np.linalg.norm(arm, axis=2)
        touching = distance < self.r[:, None] + self.r
        self.weight = {}
        for i, j in zip(*np.nonzero(np.triu(touching, 1)), strict=True):
            d, gone = distance[i, j], 0.0
            for k in set(range(count)) - {i, j}:
                one, two = distance[i, k], distance[k, j]
                if touching[i, k] and touching[k, j] and d > max(one, two):
                    angle = acos((one**2 + two**2 - d**2) / (2 * one * two))
                    gone += 1 / (1 + exp(-50 * (angle / pi - 0.5)))
            self.weight[int(i), int(j)] = max(1 - gone, 0.0)
