"""Types of the values in a case file: SI floats that accept text with a unit."""

from dataclasses import dataclass
from operator import ge, gt, le, lt
from typing import Annotated, Any

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from pestle.config.base import problem, reworded
from pestle.errors import InputError
from pestle.units import EXAMPLES, to_si


@dataclass(frozen=True)
class Quantity:
    """Annotation of a float: its SI unit and the range that makes sense.

    Parameters
    ----------
    unit : str
        SI unit, one of `pestle.units.DIMENSIONS`.
    above, least, below, most : float, optional
        Exclusive and inclusive bounds [`unit`].
    """

    unit: str
    above: float | None = None
    least: float | None = None
    below: float | None = None
    most: float | None = None

    def read(self, value: Any) -> float:
        """Convert to the SI unit and check the range."""
        try:
            number = to_si(value, self.unit)
        except InputError as error:
            raise reworded(error) from None
        for bound, is_met, words in (
            (self.above, gt, "greater than"),
            (self.least, ge, "at least"),
            (self.below, lt, "less than"),
            (self.most, le, "at most"),
        ):
            if bound is not None and not is_met(number, bound):
                limit = f"{bound:g}" + ("" if self.unit == "1" else f" {self.unit}")
                raise problem("out-of-range", f"must be {words} {limit}")
        return number

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self.read, serialization=core_schema.simple_ser_schema("float")
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        names = {
            "above": "exclusiveMinimum",
            "least": "minimum",
            "below": "exclusiveMaximum",
            "most": "maximum",
        }
        bounds = {
            name: getattr(self, key)
            for key, name in names.items()
            if getattr(self, key) is not None
        }
        number = {"type": "number", **bounds}
        if self.unit == "1":
            return number
        text = {"type": "string", "examples": [EXAMPLES.get(self.unit, self.unit)]}
        return {"anyOf": [number, text], "x-unit": self.unit}


RADIUS = Quantity("m", above=0.0, most=1e5)

Length = Annotated[float, RADIUS]
Distance = Annotated[float, Quantity("m", least=0.0, most=1e5)]
Coordinate = Annotated[float, Quantity("m", least=-1e5, most=1e5)]
Duration = Annotated[float, Quantity("s", above=0.0, most=1e6)]
Time = Annotated[float, Quantity("s", least=0.0, most=1e6)]
TimeStep = Annotated[float, Quantity("s", above=0.0, most=1.0)]
Speed = Annotated[float, Quantity("m/s", above=0.0, most=1e4)]
Velocity = Annotated[float, Quantity("m/s", least=-1e4, most=1e4)]
Acceleration = Annotated[float, Quantity("m/s^2", least=-1e6, most=1e6)]
Rate = Annotated[float, Quantity("1/s", least=-1e9, most=1e9)]
Mass = Annotated[float, Quantity("kg", above=0.0, most=1e9)]
Density = Annotated[float, Quantity("kg/m^3", above=0.0, most=1e6)]
Modulus = Annotated[float, Quantity("Pa", above=0.0, most=1e14)]
Stress = Annotated[float, Quantity("Pa", above=0.0, most=1e13)]
Force = Annotated[float, Quantity("N", above=0.0, most=1e12)]
Adhesion = Annotated[float, Quantity("J/m^2", least=0.0, most=1e9)]
PoissonRatio = Annotated[float, Quantity("1", least=0.0, below=0.5)]
Friction = Annotated[float, Quantity("1", least=0.0, most=100.0)]
Restitution = Annotated[float, Quantity("1", above=0.0, most=1.0)]
DampingRatio = Annotated[float, Quantity("1", least=0.0, most=100.0)]
Fraction = Annotated[float, Quantity("1", above=0.0, most=1.0)]
Factor = Annotated[float, Quantity("1", least=1.0, most=1e12)]
Number = Annotated[float, Quantity("1", least=-1e12, most=1e12)]


@dataclass(frozen=True)
class WholeNumber:
    """Annotation of an int; 1e6 is fine, 1.5, true and "7" are not."""

    least: int = 1
    most: int = 10**9

    def read(self, value: Any) -> int:
        """Check that the value is a whole number in the range."""
        is_whole = isinstance(value, int) or (
            isinstance(value, float) and value.is_integer()
        )
        if isinstance(value, bool) or not is_whole:
            raise problem("not-a-whole-number", "must be a whole number")
        if not self.least <= value <= self.most:
            raise problem(
                "out-of-range",
                f"must be a whole number from {self.least} to {self.most:.10g}",
            )
        return int(value)

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "integer", "minimum": self.least, "maximum": self.most}


Count = Annotated[int, WholeNumber(1, 10**8)]
Steps = Annotated[int, WholeNumber(1, 10**10)]
Seed = Annotated[int, WholeNumber(0, 2**63 - 1)]

Flag = Annotated[bool, Field(strict=True)]
Name = Annotated[
    str,
    Field(
        strict=True, min_length=1, max_length=60, pattern=r"^[A-Za-z][A-Za-z0-9_-]*$"
    ),
]
Text = Annotated[str, Field(strict=True, max_length=300)]

Point = tuple[Coordinate, Coordinate, Coordinate]
Direction = tuple[Number, Number, Number]
