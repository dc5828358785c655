"""Walls: planes, finite cylinders and meshes that stand, are moved or hold a force.

`wall` columns: kind (0 plane, 1 cylinder, 2 mesh), point 3, normal or axis 3, radius,
bottom, top, active, material.  `move` columns: drive axis 3, mode, displacement,
velocity, servo target [N], servo top speed, relaxation time.  Displacement is positive
along the drive axis, inwards to the powder.

A mesh is a rigid body that turns about its point.  On top of the drive along its axis it
may follow a motion: rows of time, velocity 3 and angular velocity 3, linear in between.
`body` columns: quaternion 4, rotation matrix 9, velocity 3 and angular velocity 3 in the
last step, largest distance from the point, path of the farthest point, start of the
motion.
"""

from math import cos, sin, sqrt
from typing import Any

import numpy as np

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
MESH = 2.0
TURN, SPEED, SPIN, EXTENT, PATH, BEGIN, BODY = 4, 13, 16, 19, 20, 21, 22
# sums of a wall: force 3 on the particles, normal force, stiffness, torque 3 about the
# wall's point on the particles; then the work that it has done so far
TORQUE, TOTALS, WORK = 5, 8, 8


@_jit.njit
def across(x: float, y: float, z: float, length: float) -> tuple[float, float, float]:
    """Vector of a length across a unit vector."""
    if abs(x) < 0.6:
        size = length / sqrt(1.0 - x * x)
        return 0.0, z * size, -y * size
    size = length / sqrt(1.0 - y * y)
    return -z * size, 0.0, x * size


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
    if r < 1e-12 * wall[w, 7]:  # on the axis: any direction is as near
        r = 1e-12 * wall[w, 7]
        px, py, pz = across(nx, ny, nz, r)
    out = 1.0 - wall[w, 7] / r
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
def surface_velocity(
    x: float, y: float, z: float, wall: Any, body: Any, w: int
) -> tuple[float, float, float]:
    """Velocity of a point of a mesh in the last step [m/s]."""
    rx, ry, rz = x - wall[w, 1], y - wall[w, 2], z - wall[w, 3]
    a, b, c = body[w, SPIN], body[w, SPIN + 1], body[w, SPIN + 2]
    return (
        body[w, SPEED] + b * rz - c * ry,
        body[w, SPEED + 1] + c * rx - a * rz,
        body[w, SPEED + 2] + a * ry - b * rx,
    )


@_jit.njit
def wall_power(wall: Any, move: Any, body: Any, total: Any, w: int) -> float:
    """Power of a wall on the particles, with its velocity in the last step [W]."""
    power = 0.0
    for v in range(3):
        if wall[w, 0] == MESH:
            power += total[w, v] * body[w, SPEED + v]
            power += total[w, TORQUE + v] * body[w, SPIN + v]
        else:
            power += total[w, v] * move[w, v] * move[w, 5]
    return power


@_jit.njit
def drive_velocity(
    move: Any, total: Any, program: Any, lengths: Any, w: int, time: float, dt: float
) -> float:
    """Velocity of a wall along its drive axis in the next step [m/s]."""
    mode = move[w, 3]
    if mode == PROGRAM:
        return program_velocity(program[w], lengths[w], time - move[w, 9] + 0.5 * dt)
    if mode == SERVO:
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
        return move[w, 5] + (v - move[w, 5]) * min(dt / move[w, 8] * 10.0, 1.0)
    return 0.0


@_jit.njit
def follow_motion(motion: Any, length: int, time: float, body: Any, w: int) -> None:
    """Set the velocities of a mesh from its motion, at a time since its start [s]."""
    last = motion[length - 1]
    n = 1
    while n < length and time >= motion[n, 0]:
        n += 1
    for v in range(6):
        value = last[1 + v]
        if n < length:
            share = (time - motion[n - 1, 0]) / (motion[n, 0] - motion[n - 1, 0])
            value = motion[n - 1, 1 + v] + share * (
                motion[n, 1 + v] - motion[n - 1, 1 + v]
            )
        body[w, SPEED + v] = value


@_jit.njit
def turn_body(body: Any, w: int, dt: float) -> None:
    """Turn a mesh by its angular velocity over a step, and keep its rotation a rotation."""
    a, b, c = body[w, SPIN], body[w, SPIN + 1], body[w, SPIN + 2]
    speed = sqrt(a * a + b * b + c * c)
    if speed * dt == 0.0:
        return
    s, e = sin(0.5 * speed * dt) / speed, cos(0.5 * speed * dt)
    a, b, c = s * a, s * b, s * c
    q0, q1, q2, q3 = body[w, 0], body[w, 1], body[w, 2], body[w, 3]
    p0 = e * q0 - a * q1 - b * q2 - c * q3
    p1 = e * q1 + a * q0 + b * q3 - c * q2
    p2 = e * q2 + b * q0 + c * q1 - a * q3
    p3 = e * q3 + c * q0 + a * q2 - b * q1
    size = 1.0 / sqrt(p0 * p0 + p1 * p1 + p2 * p2 + p3 * p3)
    body[w, 0], body[w, 1], body[w, 2], body[w, 3] = (
        p0 * size,
        p1 * size,
        p2 * size,
        p3 * size,
    )
    set_rotation(body, w)


@_jit.njit
def set_rotation(body: Any, w: int) -> None:
    """Set the rotation matrix of a mesh from its quaternion."""
    q0, q1, q2, q3 = body[w, 0], body[w, 1], body[w, 2], body[w, 3]
    r = TURN
    body[w, r] = 1.0 - 2.0 * (q2 * q2 + q3 * q3)
    body[w, r + 1] = 2.0 * (q1 * q2 - q0 * q3)
    body[w, r + 2] = 2.0 * (q1 * q3 + q0 * q2)
    body[w, r + 3] = 2.0 * (q1 * q2 + q0 * q3)
    body[w, r + 4] = 1.0 - 2.0 * (q1 * q1 + q3 * q3)
    body[w, r + 5] = 2.0 * (q2 * q3 - q0 * q1)
    body[w, r + 6] = 2.0 * (q1 * q3 - q0 * q2)
    body[w, r + 7] = 2.0 * (q2 * q3 + q0 * q1)
    body[w, r + 8] = 1.0 - 2.0 * (q1 * q1 + q2 * q2)


@_jit.njit
def drive_walls(
    wall: Any, move: Any, total: Any, program: Any, lengths: Any, body: Any, motion: Any,
    turns: Any, time: float, dt: float,
) -> None:  # fmt: skip
    """Move all walls over one step: sets each velocity, then place and displacement."""
    for w in range(wall.shape[0]):
        v = drive_velocity(move, total, program, lengths, w, time, dt)
        move[w, 5] = v
        move[w, 4] += v * dt
        if wall[w, 0] != MESH:
            for c in range(3):
                wall[w, 1 + c] += move[w, c] * v * dt
            continue
        body[w, SPEED : SPEED + 6] = 0.0
        if turns[w] > 0:
            since = time - body[w, BEGIN] + 0.5 * dt
            follow_motion(motion[w], turns[w], since, body, w)
        speed2 = spin2 = 0.0
        for c in range(3):
            move[w, 4] += body[w, SPEED + c] * move[w, c] * dt
            body[w, SPEED + c] += move[w, c] * v
            wall[w, 1 + c] += body[w, SPEED + c] * dt
            speed2 += body[w, SPEED + c] ** 2
            spin2 += body[w, SPIN + c] ** 2
        body[w, PATH] += (sqrt(speed2) + sqrt(spin2) * body[w, EXTENT]) * dt
        turn_body(body, w, dt)


@_jit.njit
def wall_path(wall: Any, move: Any, body: Any, wref: Any) -> float:
    """How far any point of any wall has come since the lists were built, at most [m]."""
    most = 0.0
    for w in range(wall.shape[0]):
        if wall[w, ACTIVE] > 0.0:
            here = body[w, PATH] if wall[w, 0] == MESH else move[w, 4]
            most = max(most, abs(here - wref[w]))
    return most


def identity(extent: float) -> Any:
    """Row of `body` of a mesh that has not turned yet; its farthest vertex [m]."""
    row = np.zeros((1, BODY))
    row[0, 0], row[0, EXTENT] = 1.0, extent
    set_rotation(row, 0)
    return row[0]
