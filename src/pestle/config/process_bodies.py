"""Steps of the process that move rigid bodies through the powder, or level it."""

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import model_validator

from pestle.config.base import problem
from pestle.config.quantities import (
    Coordinate,
    Duration,
    Length,
    Name,
    Quantity,
    Rate,
    Speed,
    Stress,
    Time,
    Velocity,
)
from pestle.config.stage import Stage

AngularSpeed = Annotated[float, Quantity("1/s", above=0.0, most=1e6)]
TurnAngle = Annotated[float, Quantity("rad", above=0.0, most=1e4)]
HelixAngle = Annotated[float, Quantity("rad", above=0.0, below=1.5707)]


class Carry(Stage):
    """Move and turn a body of triangles by a program."""

    step: Literal["carry"] = "carry"
    """carry"""
    wall: Name
    """A wall of kind mesh, blade or shear_head; it turns about its point."""
    program: tuple[tuple[Time, Velocity, Velocity, Velocity, Rate, Rate, Rate], ...]
    """Rows of time, velocity along x, y, z and angular velocity about x, y, z, linear
    in between ([s], [m/s], [1/s]); the step ends with the last row."""

    @model_validator(mode="after")
    def _check(self) -> "Carry":
        times = [row[0] for row in self.program]
        if len(times) < 2 or times[0] != 0.0 or any(b <= a for a, b in pairwise(times)):
            raise problem(
                "contradiction",
                "a program needs two rows or more whose times increase from 0",
                'program = [["0 s", 0, 0, "1 cm/s", 0, 0, "60 rpm"], ["2 s", 0, 0, '
                '"1 cm/s", 0, 0, "60 rpm"]]',
                key=("program",),
            )
        return self


class Stir(Stage):
    """Drive the blade of a powder rheometer along a helix, to a depth."""

    step: Literal["stir"] = "stir"
    """stir"""
    wall: Name = "blade"
    """A wall of kind blade."""
    tip_speed: Speed
    """Speed of the tips along their path [m/s]."""
    helix_angle: HelixAngle
    """Angle of that path to the horizontal [rad], as "5 deg"."""
    to: Coordinate
    """Depth of the blade's lowest point below the surface at which the step ends,
    negative above it [m]; the blade goes down or up to it."""
    turn: Literal["anticlockwise", "clockwise"] = "anticlockwise"
    """Sense of rotation as seen from above; the blade pushes the powder down when it
    turns anticlockwise, and lifts it clockwise."""
    clearance: Length | None = None
    """Height above the surface at which an absent blade comes in [m]; by default a mean
    radius."""
    role: Literal["test", "conditioning", "stability", "flow-rate"] = "test"
    """What its flow energy counts for; `flow_sequence` gives the roles of its steps."""


class Level(Stage):
    """Take away all particles that reach above a height."""

    step: Literal["level"] = "level"
    """level"""
    height: Coordinate
    """Height along z of the new surface [m]."""


class Shear(Stage):
    """Turn the head of a shear cell under a normal stress, through an angle.

    An absent head comes down to the powder first.  The head then presses until it has
    the stress, which is kept while it turns; the step ends with the angle.
    """

    step: Literal["shear"] = "shear"
    """shear"""
    wall: Name = "head"
    """A wall of kind shear_head that faces down."""
    stress: Stress
    """Normal stress over the area of the head's disc [Pa]."""
    angle: TurnAngle
    """Angle through which the head turns, anticlockwise as seen from above [rad], as
    "30 deg"."""
    angular_speed: AngularSpeed
    """Angular speed of the head [1/s], as "2 rpm"."""
    role: Literal["pre-shear", "yield"] = "yield"
    """pre-shear: to steady flow at the consolidation stress; yield: a point of the
    yield locus, at a lower stress."""
    at: Speed | None = None
    """Speed at which an absent head comes down [m/s]; by default that of its rim."""

    @property
    def duration(self) -> float:
        """Time of turning [s]."""
        return self.angle / self.angular_speed


class Lift(Stage):
    """Lift the die off the powder and wait until the heap is at rest."""

    step: Literal["lift"] = "lift"
    """lift"""
    at: Speed
    """Speed of the die [m/s]."""
    max_time: Duration = 1.0
    """Longest time to wait until the heap is at rest [s]."""
