"""Walls: planes and finite cylinders that stand, follow a program or hold a force.

`wall` columns: kind (0 plane, 1 cylinder), point 3, normal or axis 3, radius, bottom,
top, active, material.  `move` columns: drive axis 3, mode, displacement, velocity,
servo target [N], servo top speed, relaxation time.  Displacement is positive along the
drive axis, inwards to the powder.
"""

from math import sqrt
from typing import Any

from pestle import _jit

KIND, POINT, NORMAL, RADIUS, BOTTOM, TOP, ACTIVE, MATERIAL, WALL = (
    0,
    1,
    4,
    7,
    8,
    9,
    10,
    11,
    12,
)
AXIS, MODE, DISPLACEMENT, VELOCITY, TARGET, TOP_SPEED, RELAX, START, MOVE = (
    0,
    3,
    4,
    5,
    6,
    7,
    8,
    9,
    10,
)
FIXED, PROGRAM, SERVO = 0.0, 1.0, 2.0
# sums of a wall: force 3 on the particles, normal force, stiffness
TOTALS = 5


@_jit.njit(forceinline=True)
def towards_wall(
    x: float, y: float, z: float, wall: Any, w: int
) -> tuple[float, float, float]:
    """Vector from the nearest point of a wall to a particle's centre [m]."""
    rx, ry, rz = x - wall[w, 1], y - wall[w, 2], z - wall[w, 3]
    nx, ny, nz = wall[w, 4], wall[w, 5], wall[w, 6]
    h = rx * nx + ry * ny + rz * nz
    if wall[w, 0] == 0.0:
        return h * nx, h * ny, h * nz
    px, py, pz = rx - h * nx, ry - h * ny, rz - h * nz
    r = sqrt(px * px + py * py + pz * pz)
    out = 1.0 - wall[w, 7] / (r + 1e-300)
    over = h - min(max(h, wall[w, 8]), wall[w, 9])  # beyond the rim, from its edge
    return px * out + over * nx, py * out + over * ny, pz * out + over * nz


@_jit.njit
def program_velocity(program: Any, length: int, time: float) -> float:
    """Velocity of a piecewise linear program at a time since its start [m/s]."""
    if length == 0 or time >= program[length - 1, 0]:
        return program[length - 1, 1] if length else 0.0
    for n in range(1, length):
        if time < program[n, 0]:
            t0, v0 = program[n - 1, 0], program[n - 1, 1]
            return v0 + (program[n, 1] - v0) * (time - t0) / (program[n, 0] - t0)
    return 0.0


@_jit.njit
def drive_walls(
    wall: Any, move: Any, total: Any, program: Any, lengths: Any, time: float, dt: float
) -> None:
    """Move all walls over one step: sets each velocity, then place and displacement."""
    for w in range(wall.shape[0]):
        mode = move[w, 3]
        v = 0.0
        if mode == PROGRAM:
            v = program_velocity(program[w], lengths[w], time - move[w, 9] + 0.5 * dt)
        elif mode == SERVO:
            # force along the drive axis, towards its target within the relaxation time
            force = (
                total[w, 0] * move[w, 0]
                + total[w, 1] * move[w, 1]
                + total[w, 2] * move[w, 2]
            )
            lack = move[w, 6] - force
            stiff = total[w, 4]
            top = move[w, 7]
            v = lack / (stiff * move[w, 8] + abs(move[w, 6]) / top * 1e-3 + 1e-300)
            v = min(max(v, -top), top)
            # no jump in velocity: a wall has inertia
            v = move[w, 5] + (v - move[w, 5]) * min(dt / move[w, 8] * 10.0, 1.0)
        move[w, 5] = v
        move[w, 4] += v * dt
        for c in range(3):
            wall[w, 1 + c] += move[w, c] * v * dt
