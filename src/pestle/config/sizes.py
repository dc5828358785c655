"""The radius of particles: one value or a distribution, cut off at both ends."""

from collections.abc import Sequence
from itertools import pairwise
from math import log
from typing import Annotated, Any, Literal

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from pestle.config.base import Section, problem
from pestle.config.quantities import RADIUS, Distance, Length, Quantity

Distribution = Literal[
    "single", "uniform", "normal", "lognormal", "rosin-rammler", "table"
]
_EXPONENT = Quantity("1", above=0.0, most=100.0)
_SHARE = Quantity("1", least=0.0, most=1.0)
Exponent = Annotated[float, _EXPONENT]
Share = Annotated[float, _SHARE]

_TAIL = 0.01  # share by volume of either tail of a Rosin-Rammler distribution


class SizeDistribution(Section):
    """Distribution of the particle radius: what is drawn are radii by number."""

    distribution: Distribution
    """single, uniform, normal, lognormal, rosin-rammler or table; the tails are cut off
    at the limits."""
    mean: Length
    """Arithmetic mean of the radius by number, before the tails are cut [m]; follows
    from the limits of uniform, from rosin-rammler and from a table."""
    deviation: Distance = 0.0
    """Standard deviation of the radius itself, also for lognormal [m]."""
    minimum: Length
    """Smallest radius [m]; by default of a normal or lognormal distribution: mean minus
    2.5 deviations; of rosin-rammler: 1 % by volume is finer."""
    maximum: Length
    """Largest radius [m]; by default: mean plus 2.5 deviations; of rosin-rammler: 1 %
    by volume is coarser."""
    scale: Length | None = None
    """Of rosin-rammler: radius that 63.2 % by volume are finer than [m]; a share
    1 - exp(-(r/scale)^exponent) is finer than r."""
    exponent: Exponent | None = None
    """Of rosin-rammler: the larger, the narrower [-]."""
    table: tuple[tuple[Length, Share], ...] | None = None
    """Of table: rows of radius [m] and share that is finer, from 0 to 1 [-]; uniform
    in between."""
    by: Literal["number", "volume"] = "volume"
    """Of table: what the shares are of, number or volume (which is by mass, too)."""

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
        if kind in ("rosin-rammler", "table"):
            return _with_moments(data)
        return data

    @model_validator(mode="after")
    def _check(self) -> "SizeDistribution":
        self._check_keys()
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

    def _check_keys(self) -> None:
        """Refuse a curve without its keys, keys without a curve, and a bad table."""
        needs = {"rosin-rammler": ("scale", "exponent"), "table": ("table",)}
        wanted = needs.get(self.distribution, ())
        for key in ("scale", "exponent", "table"):
            given = getattr(self, key) is not None
            if given == (key in wanted):
                continue
            raise problem(
                "contradiction" if given else "missing-key",
                f"{key} means nothing in a {self.distribution} distribution"
                if given
                else f"a {self.distribution} distribution needs {key}",
                f"remove {key}" if given else f"add {key}",
                key=(key,),
            )
        if self.table is None:
            return
        if len(self.table) < 2 or not _rises(self.table):
            raise problem(
                "contradiction",
                "a table needs rising radii and shares that rise from 0 to 1",
                'table = [["50 um", 0], ["80 um", 0.4], ["100 um", 1]]',
                key=("table",),
            )
        if (self.minimum, self.maximum) != (self.table[0][0], self.table[-1][0]):
            raise problem(
                "contradiction",
                "the limits are not those of the table",
                "remove minimum and maximum",
                key=("minimum",),
            )

    @property
    def mean_cube(self) -> float:
        """Mean of the cubed radius by number [m^3]; before the tails are cut."""
        if self.distribution in ("rosin-rammler", "table"):
            from pestle.config.size_table import moment

            return moment(self, 3)
        return self.mean**3 + 3.0 * self.mean * self.deviation**2


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


def _with_moments(data: dict[str, Any]) -> dict[str, Any]:
    """Add limits, mean and deviation of a curve; what is wrong is reported later."""
    from pestle.errors import InputError

    wanted = ("table",) if data["distribution"] == "table" else ("scale", "exponent")
    unknown = {"mean": 1.0, "minimum": 1.0, "maximum": 1.0, **data}
    if not all(key in data for key in wanted):
        return unknown
    try:
        limits = _limits(data)
    except PydanticCustomError as error:
        if (error.context or {}).get("id") == "contradiction":
            raise
        return unknown
    except (InputError, TypeError, ValueError, OverflowError):
        return unknown
    if limits is None:
        return unknown
    low, high, given = limits
    if "mean" in data and "deviation" in data:
        return {"minimum": low, "maximum": high, **data}
    from pestle.config.size_table import moment

    draft = SizeDistribution.model_construct(distribution=data["distribution"], **given)
    mean = moment(draft, 1)
    deviation = max(moment(draft, 2) - mean**2, 0.0) ** 0.5
    return {
        "minimum": low,
        "maximum": high,
        "mean": mean,
        "deviation": deviation,
        **data,
    }


def _limits(data: dict[str, Any]) -> tuple[float, float, dict[str, Any]] | None:
    """Smallest and largest radius of a curve, and its parameters; None if none."""
    if data["distribution"] == "table":
        rows = [(RADIUS.read(r), _SHARE.read(q)) for r, q in data["table"]]
        if len(rows) < 2 or not _rises(rows):
            return None
        low, high = rows[0][0], rows[-1][0]
        return low, high, {"table": rows, "by": data.get("by", "volume")}
    scale, exponent = RADIUS.read(data["scale"]), _EXPONENT.read(data["exponent"])
    low, high = (
        scale * (-log(1.0 - share)) ** (1.0 / exponent)
        for share in (_TAIL, 1.0 - _TAIL)
    )
    low = RADIUS.read(data.get("minimum", low))
    high = RADIUS.read(data.get("maximum", high))
    given = {"scale": scale, "exponent": exponent, "minimum": low, "maximum": high}
    if low >= high:
        what = f"minimum {low:g} m is not below maximum {high:g} m"
        hint = "their defaults follow from scale and exponent"
        raise problem("contradiction", what, hint, key=("minimum",))
    return low, high, given


def _rises(rows: Sequence[tuple[float, float]]) -> bool:
    steps = list(pairwise(rows))
    larger = all(a[0] < b[0] and a[1] <= b[1] for a, b in steps)
    return larger and rows[0][1] == 0.0 and rows[-1][1] == 1.0
