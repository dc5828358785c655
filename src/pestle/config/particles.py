"""[particles]: how many, how large, or where they are read from.

One powder is a table [particles]; several powders are [[particles]], one each.
"""

from typing import Annotated, Any, Literal

from pydantic import Field, WrapValidator, model_validator

from pestle.config.base import Section, problem
from pestle.config.quantities import RADIUS, Count, Distance, Length, Name, Text

Distribution = Literal["single", "uniform", "normal", "lognormal"]


class SizeDistribution(Section):
    """Distribution of the particle radius, by number."""

    distribution: Distribution
    """single, uniform, normal or lognormal; the tails are cut off at the limits."""
    mean: Length
    """Arithmetic mean of the radius before the tails are cut [m]."""
    deviation: Distance = 0.0
    """Standard deviation of the radius itself, also for lognormal [m]."""
    minimum: Length
    """Smallest radius [m]; by default of a normal or lognormal distribution: mean minus
    2.5 deviations."""
    maximum: Length
    """Largest radius [m]; by default: mean plus 2.5 deviations."""

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            radius = RADIUS.read(data)
            limits = {"minimum": radius, "maximum": radius}
            return {"distribution": "single", "mean": radius, **limits}
        kind = data.get("distribution")
        if kind == "single" and "mean" in data:
            return {"minimum": data["mean"], "maximum": data["mean"], **data}
        if kind in ("normal", "lognormal") and {"mean", "deviation"} <= data.keys():
            return _with_tails(data)
        if kind == "uniform" and {"minimum", "maximum"} <= data.keys():
            return _with_middle(data)
        if kind in ("normal", "lognormal"):
            return {"minimum": 1.0, "maximum": 1.0, **data}  # mean is reported missing
        return data

    @model_validator(mode="after")
    def _check(self) -> "SizeDistribution":
        if self.distribution in ("normal", "lognormal") and self.deviation == 0.0:
            raise problem(
                "missing-key",
                f"a {self.distribution} distribution needs a deviation above zero",
                'add deviation = "10 um"',
                key=("deviation",),
            )
        if not self.minimum <= self.mean <= self.maximum:
            raise problem(
                "contradiction",
                f"mean {self.mean:g} m is not between minimum {self.minimum:g} m "
                f"and maximum {self.maximum:g} m",
                "these are radii, not diameters",
                key=("mean",),
            )
        if self.maximum > 1000.0 * self.minimum:
            raise problem(
                "too-wide",
                f"the largest radius is {self.maximum / self.minimum:.3g} times the "
                "smallest",
                "keep the ratio below 1000",
                key=("maximum",),
            )
        return self


class ParticleSettings(Section):
    """One powder: generated (count and radius), or from a file or an earlier run."""

    material: Name | None = None
    """Material of the particles, a name in [materials]; may be left out where the file
    has a column material, or where an earlier run goes on."""
    count: Count | None = None
    """Number of particles to generate."""
    radius: SizeDistribution | None = None
    """Mean radius [m], or a table with distribution, mean, deviation, minimum and
    maximum."""
    file: Text | None = None
    """CSV with the columns id, radius_m, density_kg_m3, x_m, y_m, z_m and, for several
    powders, material; the path is relative to the case file."""
    start_from: Text | None = None
    """Directory of an earlier run whose last state is the start."""

    @model_validator(mode="after")
    def _check(self) -> "ParticleSettings":
        given = [k for k in ("count", "file", "start_from") if getattr(self, k)]
        if not given:
            raise problem(
                "missing-key",
                "no particles: none of count, file and start_from is given",
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
        if self.count is not None and self.material is None:
            raise problem(
                "missing-key",
                "material is missing",
                'add material = "powder", a name in [materials]',
                key=("material",),
            )
        if self.count is not None and self.radius is None:
            raise problem(
                "missing-key",
                "generated particles need a radius",
                'add radius = "150 um"',
                key=("radius",),
            )
        if self.count is None and self.radius is not None:
            raise problem(
                "contradiction",
                f"radius is given but the radii come from {given[0]}",
                "remove radius",
                key=("radius",),
            )
        return self


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


def _with_tails(data: dict[str, Any]) -> dict[str, Any]:
    from pestle.units import to_si

    if "minimum" in data and "maximum" in data:
        return data
    mean, deviation = _number(to_si, data["mean"]), _number(to_si, data["deviation"])
    if mean is None or deviation is None:
        return data  # the fields themselves report what is wrong
    if "minimum" not in data and mean <= 2.5 * deviation:
        raise problem(
            "contradiction",
            "the deviation is so large that radii reach zero",
            "add minimum, the smallest radius",
            key=("deviation",),
        )
    tails = {"minimum": mean - 2.5 * deviation, "maximum": mean + 2.5 * deviation}
    return {**tails, **data}


def _with_middle(data: dict[str, Any]) -> dict[str, Any]:
    from pestle.units import to_si

    low, high = _number(to_si, data["minimum"]), _number(to_si, data["maximum"])
    if low is None or high is None:
        return data
    return {"mean": (low + high) / 2, "deviation": abs(high - low) / 12**0.5, **data}


def _number(to_si: Any, value: Any) -> float | None:
    from pestle.errors import InputError

    try:
        return float(to_si(value, "m"))
    except InputError:
        return None
