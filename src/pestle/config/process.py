"""[[process]]: the steps of the process, one after the other."""

from itertools import pairwise
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from pestle.config.base import problem
from pestle.config.flow_sequence import FlowSequence
from pestle.config.process_bodies import Carry, Level, Lift, Shear, Stir
from pestle.config.quantities import (
    Coordinate,
    Distance,
    Duration,
    Factor,
    Force,
    Fraction,
    Length,
    Name,
    Rate,
    Speed,
    Stress,
    Time,
    Velocity,
)
from pestle.config.stage import For, Stage


class Fill(Stage):
    """Place the particles at random above each other and let them settle."""

    step: Literal["fill"] = "fill"
    """fill"""
    max_time: Duration = 1.0
    """Longest time to wait until the powder is at rest [s]."""
    softening: Factor = 1000.0
    """The modulus of the particles is divided by this while they fall and settle
    (elastic, without adhesion); the case's own law and stiffness take over at the end
    of the step [-]."""


class Press(Stage):
    """Move a punch into the powder until a stress, a force or a displacement.

    In the file, `to` carries one of the three, told apart by its unit.
    """

    step: Literal["press"] = "press"
    """press"""
    to_stress: Stress | None = None
    """Axial stress at which the step ends [Pa]; in the file: to = "150 MPa"."""
    to_force: Force | None = None
    """Punch force at which the step ends [N]; in the file: to = "30 N"."""
    to_displacement: Length | None = None
    """Displacement in this step at which it ends [m]; in the file: to = "2 mm"."""
    at: Speed
    """Speed of the punch [m/s]."""
    wall: Name = "upper_punch"
    """Wall that moves."""

    @model_validator(mode="before")
    @classmethod
    def _sort_target(cls, data: Any) -> Any:
        return _target_by_unit(data)

    @model_validator(mode="after")
    def _one_target(self) -> "Press":
        keys = ("to_stress", "to_force", "to_displacement")
        given = [key for key in keys if getattr(self, key) is not None]
        if len(given) != 1:
            what = f"{' and '.join(given)} are given" if given else "to is missing"
            raise problem(
                "contradiction" if given else "missing-key",
                what,
                'give one target: to = "150 MPa", "30 N" or "2 mm"',
                key=("to",),
            )
        return self


class Hold(Stage):
    """Wait with the punch at rest, or at a stress or force."""

    step: Literal["hold"] = "hold"
    """hold"""
    duration: For
    """How long [s]; in the file: for."""
    stress: Stress | None = None
    """Axial stress to keep [Pa]; without stress and force the punch stands still."""
    force: Force | None = None
    """Punch force to keep [N]."""
    wall: Name = "upper_punch"
    """Wall that holds."""

    @model_validator(mode="after")
    def _one_target(self) -> "Hold":
        _refuse_both(self.stress, self.force)
        return self


class Unload(Stage):
    """Draw the punch back until its force is zero, then lift it clear."""

    step: Literal["unload"] = "unload"
    """unload"""
    at: Speed
    """Speed of the punch [m/s]."""
    clearance: Distance | None = None
    """How far to lift after the force is zero [m]; by default a mean radius."""
    wall: Name = "upper_punch"
    """Wall that moves."""


class Eject(Stage):
    """Push the tablet out of the die with the lower punch."""

    step: Literal["eject"] = "eject"
    """eject"""
    at: Speed
    """Speed of the lower punch [m/s]."""


class Relax(Stage):
    """Let the particles move with all walls at rest."""

    step: Literal["relax"] = "relax"
    """relax"""
    duration: For
    """How long [s]; in the file: for."""


class Crush(Stage):
    """Diametral compression of the ejected tablet between two platens."""

    step: Literal["crush"] = "crush"
    """crush"""
    at: Speed
    """Speed at which the platens approach [m/s]."""
    to: Fraction = 0.1
    """Approach of the platens over the diameter at which the step ends [-]."""


class Move(Stage):
    """Move walls along their inward directions by a displacement or a program."""

    step: Literal["move"] = "move"
    """move"""
    walls: tuple[Name, ...] | None = None
    """Walls that move; by default all."""
    profile: Literal["constant", "sine"] = "constant"
    """constant: at the speed `at`; sine: half a sine of velocity over `duration`."""
    at: Speed | None = None
    """Speed [m/s]."""
    to: Coordinate | None = None
    """Displacement to reach, inwards positive [m]."""
    turn_at: Length | None = None
    """Turn back at this displacement, instead of stopping at `to` [m]; the step then
    ends at `back_to`."""
    back_to: Coordinate = 0.0
    """Displacement at which the step ends after turning [m]."""
    duration: Duration | None = None
    """Length of a sine [s]."""
    program: tuple[tuple[Time, Velocity], ...] | None = None
    """Pairs of time and velocity, linear in between ([s], [m/s])."""

    @model_validator(mode="after")
    def _check(self) -> "Move":
        if self.walls is not None and len(set(self.walls)) != len(self.walls):
            raise problem("contradiction", "a wall is named twice", key=("walls",))
        if self.program is not None:
            self._check_program(self.program)
        elif self.profile == "sine":
            self._require("to", "duration")
            self._refuse("at", "turn_at")
        else:
            self._require("at", *(("to",) if self.turn_at is None else ()))
            self._refuse("duration")
            self._check_turn()
        return self

    def _check_turn(self) -> None:
        if self.turn_at is None:
            if self.back_to != 0.0:
                raise problem(
                    "contradiction",
                    "back_to is given without turn_at",
                    "add turn_at",
                    key=("back_to",),
                )
            return
        if self.back_to >= self.turn_at:
            raise problem(
                "contradiction",
                f"back_to {self.back_to:g} m is not below turn_at {self.turn_at:g} m",
                key=("back_to",),
            )

    def _check_program(self, program: tuple[tuple[float, float], ...]) -> None:
        self._refuse("at", "to", "turn_at", "duration")
        times = [time for time, _ in program]
        if len(times) < 2 or any(b <= a for a, b in pairwise(times)):
            raise problem(
                "contradiction",
                "a program needs two rows or more with increasing times",
                'program = [["0 ms", "0 m/s"], ["1 ms", "1 m/s"]]',
                key=("program",),
            )
        if times[0] != 0.0:
            raise problem(
                "contradiction", "a program begins at time 0", key=("program",)
            )

    def _require(self, *keys: str) -> None:
        for key in keys:
            if getattr(self, key) is None:
                what = f"a {self.profile} movement needs {key}"
                raise problem("missing-key", what, f"add {key}", key=(key,))

    def _refuse(self, *keys: str) -> None:
        kind = "program" if self.program is not None else f"{self.profile} profile"
        for key in keys:
            if getattr(self, key) is not None:
                what = f"{key} means nothing beside a {kind}"
                raise problem("contradiction", what, f"remove {key}", key=(key,))


class Servo(Stage):
    """Keep a wall at a stress or force."""

    step: Literal["servo"] = "servo"
    """servo"""
    wall: Name
    """Wall that is controlled."""
    stress: Stress | None = None
    """Stress to keep [Pa]; needs a die."""
    force: Force | None = None
    """Force to keep [N]."""
    duration: For
    """How long [s]; in the file: for."""

    @model_validator(mode="after")
    def _one_target(self) -> "Servo":
        _refuse_both(self.stress, self.force)
        if self.stress is None and self.force is None:
            what = "a servo needs a stress or a force"
            raise problem("missing-key", what, 'add force = "30 N"', key=("force",))
        return self


class Deform(Stage):
    """Strain the periodic box at constant rates."""

    step: Literal["deform"] = "deform"
    """deform"""
    strain_rate: tuple[Rate, Rate, Rate]
    """Rate of each edge over its length, negative in compression [1/s]."""
    duration: For
    """How long [s]; in the file: for."""


Step = Annotated[
    Fill
    | Press
    | Hold
    | Unload
    | Eject
    | Relax
    | Crush
    | Move
    | Servo
    | Deform
    | Carry
    | Stir
    | FlowSequence
    | Level
    | Shear
    | Lift,
    Field(discriminator="step"),
]

STEPS: dict[str, type[Stage]] = {
    "fill": Fill,
    "press": Press,
    "hold": Hold,
    "unload": Unload,
    "eject": Eject,
    "relax": Relax,
    "crush": Crush,
    "move": Move,
    "servo": Servo,
    "deform": Deform,
    "carry": Carry,
    "stir": Stir,
    "flow_sequence": FlowSequence,
    "level": Level,
    "shear": Shear,
    "lift": Lift,
}
"""Steps by the word that the case file uses."""


def _target_by_unit(data: Any) -> Any:
    """Sort `to` of a press step into to_stress, to_force or to_displacement."""
    if not isinstance(data, dict) or "to" not in data:
        return data
    from pestle.errors import InputError
    from pestle.units import dimension

    rest = {key: value for key, value in data.items() if key != "to"}
    hint = 'write it like to = "150 MPa", "30 N" or "2 mm"'
    if not isinstance(data["to"], str):
        what = "to needs a unit: it may be a stress, a force or a displacement"
        raise problem("bad-quantity", what, hint, key=("to",))
    try:
        unit = dimension(data["to"])
    except InputError as error:
        raise problem(error.id, error.what, error.hint or hint, ("to",)) from None
    key = {"Pa": "to_stress", "N": "to_force", "m": "to_displacement"}.get(unit or "")
    if key is None:
        what = f'to = "{data["to"]}" is neither a stress, a force nor a displacement'
        raise problem("wrong-unit", what, hint, key=("to",))
    if key in rest:
        what = f"to and {key} are both given"
        raise problem("contradiction", what, "keep one", key=("to",))
    return {**rest, key: data["to"]}


def _refuse_both(stress: float | None, force: float | None) -> None:
    if stress is not None and force is not None:
        what = "stress and force are both given"
        raise problem("contradiction", what, "keep one", key=("force",))
