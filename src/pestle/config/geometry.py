"""[die], [walls.*] and [box]: what holds the powder."""

from math import sqrt
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, model_validator

from pestle.config.base import Section, problem
from pestle.config.quantities import (
    Coordinate,
    Direction,
    Flag,
    Length,
    Name,
    Point,
    Quantity,
    Text,
    WholeNumber,
)

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


class MeshWall(Section):
    """Rigid body with a surface of triangles, both sides of which act."""

    kind: Literal["mesh"] = "mesh"
    """mesh"""
    file: Text
    """STL, PLY or OBJ, relative to the case file."""
    unit: Length
    """Length of one unit of the file [m], as "1 mm"; the formats do not say it."""
    point: Point = (0.0, 0.0, 0.0)
    """Where the origin of the file comes to lie: the body turns about it [m]."""
    axis: UnitVector = (0.0, 0.0, 1.0)
    """Direction of its displacement and of a force that it holds [-]."""
    open: Flag = False
    """Whether it is a sheet with a rim; else a rim is a hole, and refused."""
    absent: Flag = False
    """Whether it comes in only when a step of the process first moves it."""
    material: Name
    """Material of the wall, a name in [materials]."""


class BladeWall(Section):
    """Twisted blade of a powder rheometer: two wings on a shaft, a closed mesh.

    A wing is a strip whose chord stands upright at the shaft and leans to
    `tip_angle` from the horizontal at the tip, linearly in the radius, so that its
    front pushes the powder down when it turns anticlockwise as seen from above.
    """

    kind: Literal["blade"] = "blade"
    """blade"""
    diameter: Length
    """Distance of the tips [m]."""
    chord: Length
    """Width of the strip: the height of the blade at the shaft [m]."""
    thickness: Length
    """Thickness of the strip [m]."""
    tip_angle: Annotated[float, Quantity("rad", above=0.0, most=1.5707964)]
    """Angle of the strip to the horizontal at the tip [rad], as "30 deg"."""
    shaft_diameter: Length
    """Diameter of the shaft [m]."""
    shaft_height: Length
    """Length of the shaft above the middle of the blade [m]."""
    segments: Annotated[int, WholeNumber(2, 500)] = 24
    """Pieces along a wing: the mesh gets about 20 triangles for each [-]."""
    point: Point = (0.0, 0.0, 0.0)
    """Middle of the blade on its axis, about which it turns [m]."""
    absent: Flag = True
    """Whether it comes in only when a step of the process first moves it."""
    material: Name
    """Material of the blade, a name in [materials]."""

    @model_validator(mode="after")
    def _check(self) -> "BladeWall":
        for key, limit, other in (
            ("thickness", self.shaft_diameter, "shaft_diameter"),
            ("shaft_diameter", self.diameter, "diameter"),
        ):
            if getattr(self, key) >= limit:
                raise problem(
                    "contradiction",
                    f"{key} {getattr(self, key):g} m is not below {other} {limit:g} m",
                    "check the units",
                    key=(key,),
                )
        if self.shaft_height <= 0.5 * self.chord:
            raise problem(
                "contradiction",
                f"shaft_height {self.shaft_height:g} m does not reach above the blade, "
                f"half a chord of {self.chord:g} m",
                "it is measured from the middle of the blade",
                key=("shaft_height",),
            )
        return self

    @property
    def axis(self) -> Vector:
        """Direction of its displacement: down into the powder [-]."""
        return (0.0, 0.0, -1.0)


class ShearHead(Section):
    """Disc with radial vanes that grip the powder: head or base of a shear cell.

    Disc and vanes are closed meshes; the vanes reach from the hub to the rim.
    """

    kind: Literal["shear_head"] = "shear_head"
    """shear_head"""
    diameter: Length
    """Diameter of the disc [m]."""
    thickness: Length
    """Thickness of the disc [m]."""
    vanes: Annotated[int, WholeNumber(1, 200)]
    """Number of vanes, evenly around the axis [-]."""
    vane_depth: Length
    """How far the vanes reach out of the disc, into the powder [m]."""
    vane_thickness: Length
    """Thickness of a vane [m]."""
    hub_diameter: Length | None = None
    """Diameter inside which there are no vanes [m]; by default a quarter of the
    disc's."""
    facing: Literal["down", "up"] = "down"
    """Side on which the vanes are: down for a head on the powder, up for a base."""
    point: Point = (0.0, 0.0, 0.0)
    """Middle of the disc's face between the vanes, about which it turns [m]."""
    absent: Flag = True
    """Whether it comes in only when a step of the process first moves it."""
    material: Name
    """Material of disc and vanes, a name in [materials]."""

    @model_validator(mode="after")
    def _check(self) -> "ShearHead":
        if self.hub >= self.diameter:
            raise problem(
                "contradiction",
                f"hub_diameter {self.hub:g} m is not below diameter "
                f"{self.diameter:g} m",
                "the vanes reach from the hub to the rim",
                key=("hub_diameter",),
            )
        if self.vanes * self.vane_thickness >= 3.14159 * self.hub:
            raise problem(
                "contradiction",
                f"{self.vanes} vanes of {self.vane_thickness:g} m meet at the hub of "
                f"{self.hub:g} m diameter",
                "fewer or thinner vanes, or a larger hub_diameter",
                key=("vanes",),
            )
        return self

    @property
    def hub(self) -> float:
        """Diameter of the hub [m]."""
        return self.hub_diameter or 0.25 * self.diameter

    @property
    def radius(self) -> float:
        """Radius of the disc [m]."""
        return 0.5 * self.diameter

    @property
    def area(self) -> float:
        """Area of the disc [m^2]."""
        return 3.141592653589793 * self.radius**2

    @property
    def axis(self) -> Vector:
        """Direction of its displacement: into the powder [-]."""
        return (0.0, 0.0, -1.0 if self.facing == "down" else 1.0)


AnyWall = PlaneWall | CylinderWall | MeshWall | BladeWall | ShearHead
Wall = Annotated[AnyWall, Field(discriminator="kind")]


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
