"""[die], [walls.*] and [box]: what holds the powder."""

from math import sqrt
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, model_validator

from pestle.config.base import Section, problem
from pestle.config.quantities import Coordinate, Direction, Flag, Length, Name, Point

Vector = tuple[float, float, float]


def unit_vector(vector: Vector) -> Vector:
    """Scale a direction to length one."""
    length = sqrt(sum(component**2 for component in vector))
    if length < 1e-12:
        raise problem("zero-vector", "a direction must not be zero", "try [0, 0, 1]")
    x, y, z = (component / length for component in vector)
    return x, y, z


UnitVector = Annotated[Direction, AfterValidator(unit_vector)]


class PlaneWall(Section):
    """Flat wall; the powder is on the side that the normal points to."""

    kind: Literal["plane"] = "plane"
    """plane"""
    point: Point
    """A point of the plane [m]."""
    normal: UnitVector
    """Direction into the powder [-]; any length, stored as a unit vector."""
    material: Name
    """Material of the wall, a name in [materials]."""


class CylinderWall(Section):
    """Hollow cylinder; the powder is inside."""

    kind: Literal["cylinder"] = "cylinder"
    """cylinder"""
    point: Point
    """A point on the axis [m]."""
    axis: UnitVector = (0.0, 0.0, 1.0)
    """Direction of the axis [-]; any length, stored as a unit vector."""
    radius: Length
    """Inner radius [m]."""
    bottom: Coordinate
    """Where the wall begins, along the axis from the point [m]."""
    top: Coordinate
    """Where the wall ends, along the axis from the point [m]."""
    material: Name
    """Material of the wall, a name in [materials]."""

    @model_validator(mode="after")
    def _check(self) -> "CylinderWall":
        if self.top <= self.bottom:
            raise problem(
                "contradiction",
                f"top {self.top:g} m is not above bottom {self.bottom:g} m",
                "both are measured along the axis from the point",
                key=("top",),
            )
        return self


Wall = Annotated[PlaneWall | CylinderWall, Field(discriminator="kind")]


class DieSettings(Section):
    """Cylindrical die on the z axis with a punch at z = 0 and one at z = height.

    It makes the walls "die", "lower_punch" and "upper_punch".
    """

    radius: Length
    """Inner radius, not diameter [m]."""
    height: Length
    """Distance of the punches at the start [m]."""
    material: Name
    """Material of die and punches, a name in [materials]."""

    @property
    def area(self) -> float:
        """Cross-section of the die [m^2]."""
        return 3.141592653589793 * self.radius**2

    @property
    def volume(self) -> float:
        """Volume between the punches at the start [m^3]."""
        return self.area * self.height

    def walls(self) -> dict[str, PlaneWall | CylinderWall]:
        """Walls of the die by name."""
        return {
            "die": CylinderWall(
                point=(0.0, 0.0, 0.0),
                radius=self.radius,
                bottom=0.0,
                top=self.height,
                material=self.material,
            ),
            "lower_punch": PlaneWall(
                point=(0.0, 0.0, 0.0), normal=(0.0, 0.0, 1.0), material=self.material
            ),
            "upper_punch": PlaneWall(
                point=(0.0, 0.0, self.height),
                normal=(0.0, 0.0, -1.0),
                material=self.material,
            ),
        }


class BoxSettings(Section):
    """Periodic box, which the step "deform" can strain."""

    lengths: tuple[Length, Length, Length]
    """Edges along x, y, z [m]."""
    periodic: tuple[Flag, Flag, Flag] = (True, True, True)
    """Which directions repeat."""
    origin: Point = (0.0, 0.0, 0.0)
    """Corner with the smallest coordinates [m]."""

    @model_validator(mode="after")
    def _check(self) -> "BoxSettings":
        if not any(self.periodic):
            raise problem(
                "contradiction",
                "a box without a periodic direction bounds nothing",
                "use walls, or make a direction periodic",
                key=("periodic",),
            )
        return self

    @property
    def volume(self) -> float:
        """Volume of the box [m^3]."""
        return self.lengths[0] * self.lengths[1] * self.lengths[2]
