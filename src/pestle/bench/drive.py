"""Drive a contact or a particle through waypoints of displacement or force.

A leg goes straight in displacement from one waypoint to the next; a waypoint of force
is found by bisection along the leg.  A law that remembers more than its turning points
gets all of them: legs are followed in the order given.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from pestle.bench.subject import Array, Subject, Trace
from pestle.errors import InputError
from pestle.particle.law import no_range_warnings


class Displacement(NamedTuple):
    """Go to a displacement [m]."""

    value: float


class Force(NamedTuple):
    """Go on until a force is reached [N]."""

    value: float


Waypoint = Displacement | Force


@dataclass(frozen=True)
class Run:
    """A driven path.

    Parameters
    ----------
    trace : Trace
        Displacement, force, contact radius, stored energy.
    leg : array
        Number of the leg of every point, from 1; 0 at the start.
    work : array
        Work done on the contact, that of the first flat, since the start [J].
    """

    trace: Trace
    leg: Array
    work: Array

    def columns(self) -> dict[str, Array]:
        """Columns of the table, named with their units."""
        columns = {
            "leg": self.leg,
            "displacement [m]": self.trace.displacement,
            "force [N]": self.trace.force,
            "contact_radius [m]": self.trace.contact_radius,
            "work [J]": self.work,
            "stored [J]": self.trace.stored,
        }
        for number, flat in enumerate(self.trace.others, start=2):
            columns[f"force_{number} [N]"] = flat.force
            columns[f"contact_radius_{number} [m]"] = flat.contact_radius
        return {name: c for name, c in columns.items() if not np.all(np.isnan(c))}


def drive(subject: Subject, waypoints: Sequence[Waypoint], *, points: int = 500) -> Run:
    """Follow waypoints from the virgin state with `points` points a leg.

    Parameters
    ----------
    subject : SingleParticle or PairContact
        What is driven.
    waypoints : sequence of Displacement or Force
        Where the legs end.
    points : int
        Points a leg.
    """
    if not waypoints or points < 2:
        raise InputError(
            "empty-path",
            f"a path of {len(waypoints)} legs with {points} points each has no curve",
            hint="give at least one waypoint and two points a leg",
        )
    corners = [0.0]
    with no_range_warnings():  # the search goes further than the path
        for waypoint in waypoints:
            corners.append(
                waypoint.value
                if isinstance(waypoint, Displacement)
                else _reach_force(subject, corners, waypoint.value)
            )
    legs = [np.linspace(a, b, points + 1)[1:] for a, b in pairwise(corners)]
    path = np.concatenate([[0.0], *legs])
    number = np.concatenate([[0], np.repeat(np.arange(len(legs)) + 1, points)])
    trace = subject.follow(path)
    mean = 0.5 * (trace.force[1:] + trace.force[:-1])
    work = np.concatenate([[0.0], np.cumsum(mean * np.diff(path))])
    return Run(trace, number, work)


def cyclic(
    largest: Sequence[Waypoint], *, lowest: Waypoint, cycles: int = 1
) -> list[Waypoint]:
    """Waypoints that go to each of `largest` and back to `lowest`, `cycles` times."""
    return [point for top in largest for _ in range(cycles) for point in (top, lowest)]


def _reach_force(subject: Subject, corners: list[float], target: float) -> float:
    """Displacement at which a leg from the last corner first has a force."""
    start = corners[-1]
    here = float(subject.follow(np.array(corners)).force[-1])
    if here == target:
        return start
    upward = target > here
    end = subject.largest if upward else -subject.reach
    ahead = _bracket(subject, corners, target, upward=upward, end=end)
    low, high = ahead
    for _ in range(100):
        middle = 0.5 * (low + high)
        if _beyond(subject, corners, middle, target, upward=upward):
            high = middle
        else:
            low = middle
    return high


def _bracket(
    subject: Subject, corners: list[float], target: float, *, upward: bool, end: float
) -> tuple[float, float]:
    """Two displacements along the leg between which the force is first reached."""
    start, low = corners[-1], corners[-1]
    for grid in _ahead(start, end, subject.largest):
        leg = subject.follow(np.concatenate([corners, grid])).force[len(corners) :]
        beyond = np.flatnonzero(leg >= target if upward else leg <= target)
        if beyond.size:
            n = int(beyond[0])
            return float(grid[n - 1]) if n else low, float(grid[n])
        low = float(grid[-1])
    raise InputError(
        "force-out-of-reach",
        f"{subject.name} does not reach a force of {target:.6g} N from "
        f"{start:.6g} m on",
        hint="lower the force; without adhesion it is never negative",
    )


def _ahead(start: float, end: float, largest: float) -> Iterator[Array]:
    """Pieces of a leg: upwards by a quarter more at a time, so as not to go too far."""
    parts = np.concatenate([np.geomspace(1e-6, 0.01, 100), np.linspace(0.01, 1.0, 400)])
    if end < start:
        turns = [0.0, end] if end < 0.0 < start else [end]  # as fine beyond touch
        for a, b in pairwise([start, *turns]):
            yield a + (b - a) * parts
        return
    done, step = start, 1e-6 * largest
    while done < end:
        top = min(done + step, end)
        yield np.linspace(done, top, 21)[1:]
        done, step = top, 0.25 * (top - start) + 1e-6 * largest


def _beyond(
    subject: Subject, corners: list[float], d: float, target: float, *, upward: bool
) -> bool:
    force = float(subject.follow(np.array([*corners, d])).force[-1])
    return force >= target if upward else force <= target
