"""The standard program of a powder rheometer, as the steps that it consists of."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

from pydantic import Field

from pestle.config.process_bodies import HelixAngle, Stir
from pestle.config.quantities import Coordinate, Flag, Length, Name, Speed
from pestle.config.stage import Stage

Tests = Annotated[int, Field(ge=1, le=100)]


class FlowSequence(Stage):
    """Conditioning and test cycles of a blade, at one tip speed and then at others.

    Stands for steps `stir`, down and up again: before every test a conditioning cycle
    clockwise, then down anticlockwise, which is the test, and up clockwise.
    """

    step: Literal["flow_sequence"] = "flow_sequence"
    """flow_sequence"""
    wall: Name = "blade"
    """A wall of kind blade."""
    tip_speed: Speed
    """Speed of the tips along their path in the stability tests [m/s]."""
    helix_angle: HelixAngle
    """Angle of that path to the horizontal [rad], as "5 deg"."""
    to: Coordinate
    """Depth below the surface to which the blade's lowest point goes [m]."""
    clearance: Length
    """Height above the surface to which it comes back [m]."""
    tests: Tests = 7
    """Number of tests at `tip_speed`: the stability index is the flow energy of the
    last one over that of the first [-]."""
    speeds: tuple[Speed, ...] = Field(default=(), max_length=20)
    """Tip speeds of further tests [m/s]: the flow-rate index is the flow energy at the
    slowest over that at the fastest."""
    conditioning: Flag = True
    """Whether a conditioning cycle goes before every test."""
    conditioning_speed: Speed | None = None
    """Tip speed of conditioning [m/s]; by default `tip_speed`."""

    def steps(self) -> "Iterator[Stir]":
        """The steps that this one stands for, in their order."""
        mine = f"{self.name} " if self.name else ""
        speeds = [*[self.tip_speed] * self.tests, *self.speeds]
        for number, speed in enumerate(speeds, start=1):
            if self.conditioning:
                gentle = self.conditioning_speed or self.tip_speed
                name = f"{mine}conditioning {number}"
                yield self._stroke(f"{name} down", "conditioning", gentle, down=True)
                yield self._stroke(f"{name} up", "conditioning", gentle)
            role = "stability" if number <= self.tests else "flow-rate"
            test = f"{mine}test {number}"
            yield self._stroke(f"{test} down", role, speed, down=True, cuts=True)
            yield self._stroke(f"{test} up", role, speed)

    def _stroke(
        self,
        name: str,
        role: Any,
        speed: float,
        *,
        down: bool = False,
        cuts: bool = False,
    ) -> Stir:
        return Stir(
            name=name,
            wall=self.wall,
            tip_speed=speed,
            helix_angle=self.helix_angle,
            to=self.to if down else -self.clearance,
            turn="anticlockwise" if cuts else "clockwise",
            clearance=self.clearance,
            role=role,
        )


def written_out(process: tuple[Any, ...]) -> tuple[Any, ...]:
    """Steps of a process, with those in place of a sequence that it stands for."""
    steps: list[Any] = []
    for number, step in enumerate(process):
        for one in step.steps() if isinstance(step, FlowSequence) else (step,):
            if len(steps) != number:
                one = one.model_copy()
                one._written = number
            steps.append(one)
    return tuple(steps)
