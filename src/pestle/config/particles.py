"""[particles]: how many, how large, or where they are read from.

One powder is a table [particles]; several powders are [[particles]], one each.
"""

from typing import Annotated, Any

from pydantic import Field, WrapValidator, model_validator

from pestle.config.base import Section, problem
from pestle.config.quantities import Count, Mass, Name, Text
from pestle.config.sizes import SizeDistribution


class ParticleSettings(Section):
    """One powder: generated (count and radius), or from a file or an earlier run."""

    material: Name | None = None
    """Material of the particles, a name in [materials]; may be left out where the file
    has a column material, or where an earlier run goes on."""
    count: Count | None = None
    """Number of particles to generate."""
    mass: Mass | None = None
    """Mass of the particles to generate, to half a particle [kg], instead of count."""
    radius: SizeDistribution | None = None
    """Mean radius [m], or a table with distribution and its numbers."""
    file: Text | None = None
    """CSV with the columns id, radius_m, density_kg_m3, x_m, y_m, z_m and, for several
    powders, material; the path is relative to the case file."""
    start_from: Text | None = None
    """Directory of an earlier run whose last state is the start."""

    @model_validator(mode="after")
    def _check(self) -> "ParticleSettings":
        given = [k for k in ("count", "mass", "file", "start_from") if getattr(self, k)]
        if not given:
            raise problem(
                "missing-key",
                "no particles: none of count, mass, file and start_from is given",
                "add count = 1000",
                key=("count",),
            )
        if len(given) > 1:
            raise problem(
                "contradiction",
                f"{' and '.join(given)} are both given",
                "particles come from one place",
                key=(given[-1],),
            )
        if self.is_generated and self.material is None:
            raise problem(
                "missing-key",
                "material is missing",
                'add material = "powder", a name in [materials]',
                key=("material",),
            )
        if self.is_generated and self.radius is None:
            raise problem(
                "missing-key",
                "generated particles need a radius",
                'add radius = "150 um"',
                key=("radius",),
            )
        if not self.is_generated and self.radius is not None:
            raise problem(
                "contradiction",
                f"radius is given but the radii come from {given[0]}",
                "remove radius",
                key=("radius",),
            )
        return self

    @property
    def is_generated(self) -> bool:
        """Whether the particles are drawn, not read."""
        return self.count is not None or self.mass is not None

    def number(self, density: float) -> int:
        """Number of particles to generate; of a mass, to be expected [-]."""
        if self.mass is None or self.radius is None:
            return self.count or 0
        each = 4.18879 * self.radius.mean_cube * density
        return max(round(self.mass / each), 1)


def _as_tuple(value: Any, handler: Any) -> tuple[ParticleSettings, ...]:
    """Accept one powder for a tuple of one."""
    if isinstance(value, dict | ParticleSettings):
        return (ParticleSettings.model_validate(value),)
    if not isinstance(value, list | tuple):
        hint = "write [particles], or [[particles]] for several powders"
        raise problem("wrong-type", "must be a table or an array of tables", hint)
    groups: tuple[ParticleSettings, ...] = handler(value)
    return groups


Powders = Annotated[
    tuple[ParticleSettings, ...],
    Field(min_length=1, max_length=100),
    WrapValidator(_as_tuple),
]
