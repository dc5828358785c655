"""A study file: which values of which case a sweep tries."""

from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

from pydantic import (
    Field,
    PlainValidator,
    PrivateAttr,
    ValidationError,
    model_validator,
)

from pestle.config.base import Section, problem
from pestle.config.quantities import Count, Flag, Seed, Text
from pestle.errors import InputError
from pestle.units import dimension, shown, to_si

LARGEST_STUDY = 1_000_000
"""Largest study file [bytes]."""

MOST_RUNS = 100_000
"""Most runs of a study."""


class Interval(Section):
    """Numbers between two ends, with or without a unit."""

    low: float | str
    """Lower end."""
    high: float | str
    """Upper end."""
    scale: Literal["linear", "log"] = "linear"
    """Whether values or their logarithms are spread evenly."""
    whole: Flag = False
    """Round to whole numbers."""
    points: Count | None = None
    """Number of values, in a grid [-]."""
    _unit: str = PrivateAttr(default="")
    _ends: tuple[float, float] = PrivateAttr(default=(0.0, 0.0))

    @model_validator(mode="after")
    def _check(self) -> "Interval":
        units = {unit_of(end) for end in (self.low, self.high)}
        if len(units) > 1:
            raise problem(
                "wrong-unit",
                f"{shown(self.low)} and {shown(self.high)} have no common unit",
                "give both ends in units of the same kind",
                key=("high",),
            )
        self._unit = units.pop()
        self._ends = number(self.low, self._unit), number(self.high, self._unit)
        low, high = self._ends
        if not low < high or (self.scale == "log" and low <= 0.0):
            raise problem(
                "empty-bounds",
                f"no {self.scale} interval from {shown(self.low)} to "
                f"{shown(self.high)}",
                "low must be below high, and above zero on a log scale",
                key=("high",),
            )
        return self

    @property
    def unit(self) -> str:
        """SI unit of both ends, empty for plain numbers."""
        return self._unit

    @property
    def ends(self) -> tuple[float, float]:
        """Both ends [`unit`]."""
        return self._ends

    def at(self, share: float) -> float:
        """Value at a share between 0 and 1 of the interval [`unit`]."""
        low, high = self._ends
        value = low + share * (high - low)
        if self.scale == "log":
            value = float(low * (high / low) ** share)
        return float(round(value)) if self.whole else value

    def share(self, value: float) -> float:
        """Share of the interval that lies below a value; the inverse of `at`."""
        from math import log

        low, high = self._ends
        if self.scale == "log":
            return log(value / low) / log(high / low)
        return (value - low) / (high - low)

    def written(self, value: float) -> Any:
        """Value as a case file takes it."""
        if self.whole:
            return int(value)
        return f"{value!r} {self._unit}" if self._unit else value


def values_or_interval(data: Any) -> Any:
    """Values to try: an array as it is, a table as an `Interval`."""
    from pestle.config.translate import translated

    if isinstance(data, list | Interval):
        return data
    if not isinstance(data, dict):
        hint = "[0.3, 0.5] or { low = 0.3, high = 0.5 }"
        raise problem("wrong-type", "must be an array or a table", hint)
    try:
        return Interval.model_validate(data)
    except ValidationError as found:
        error = translated(found, Interval)
        key = tuple((error.where or "").split(".")) if error.where else ()
        raise problem(error.id, error.what, error.hint, key) from None


Values = Annotated[list[Any] | Interval, PlainValidator(values_or_interval)]


class StudySettings(Section):
    """A case, and what of it is varied."""

    schema_version: Literal[1] = 1
    """Version of the format [-]."""
    title: Text = ""
    """Name for people."""
    case: Text
    """Case file, relative to this one."""
    design: Literal["grid", "latin_hypercube", "sobol"] = "grid"
    """How values are combined: all with all, or spread over the whole space."""
    samples: Count | None = None
    """Number of points of a Latin hypercube or Sobol sequence [-]."""
    seed: Seed = 1
    """Seed of the design [-]."""
    replicates: Count = 1
    """Runs of each point, with the seed of the case and the next ones [-]."""
    set: dict[str, Any] = Field(default_factory=dict)
    """Values of the case that differ from the file, the same in all runs."""
    vary: dict[str, Values] = Field(min_length=1)
    """Values to try by key of the case: an array, or a table with low and high."""
    _source: Path = PrivateAttr(default=Path())

    @model_validator(mode="before")
    @classmethod
    def _flatten(cls, data: Any) -> Any:
        if isinstance(data, dict):
            data = dict(data)
            for key in ("set", "vary"):
                if isinstance(data.get(key), dict):
                    data[key] = flattened(data[key])
        return data

    @model_validator(mode="after")
    def _check(self) -> "StudySettings":
        for key, values in self.vary.items():
            self._check_values(key, values)
        if self.design == "grid":
            if self.samples is not None:
                what = "a grid has as many points as its values give"
                hint = 'remove samples, or design = "latin_hypercube"'
                raise problem("contradiction", what, hint, key=("samples",))
        elif self.samples is None:
            what = f"a {self.design} design needs samples"
            raise problem("missing-key", what, "add samples = 32", key=("samples",))
        elif self.design == "sobol" and self.samples & (self.samples - 1):
            lower = 1 << (self.samples.bit_length() - 1)
            what = f"{self.samples} samples unbalance a Sobol sequence"
            hint = f"a power of two: {lower} or {2 * lower}"
            raise problem("not-a-power-of-two", what, hint, key=("samples",))
        if self.replicates > 1 and "seed" in self.vary:
            what = "replicates and a varied seed are both given"
            raise problem("contradiction", what, "keep one", key=("replicates",))
        return self

    def _check_values(self, key: str, values: list[Any] | Interval) -> None:
        if isinstance(values, list):
            if not values:
                what = f"{key} has no values"
                raise problem("missing-key", what, "give one or more", ("vary", key))
            return
        if (self.design == "grid") != (values.points is not None):
            what = f"an interval in a {self.design} design"
            what += " needs points" if self.design == "grid" else " has no points"
            hint = "points belongs to intervals of a grid alone"
            raise problem("contradiction", what, hint, key=("vary", key, "points"))

    @property
    def source(self) -> Path:
        """File that the study was read from."""
        return self._source

    @property
    def case_file(self) -> Path:
        """Path of the case file."""
        return self._source.parent / self.case


Model = TypeVar("Model", bound=Section)


def read_settings(model: type[Model], path: Path) -> Model:
    """Read and check a TOML file beside a case: a study or a calibration.

    Raises
    ------
    InputError
        Naming file, line, key, value and reason.
    """
    from pestle.config.file import parse_toml, read_text
    from pestle.config.translate import Origin, translated

    text = read_text(path, LARGEST_STUDY)
    try:
        found = model.model_validate(parse_toml(text, path))
    except ValidationError as error:
        raise translated(error, model, Origin(text, str(path))) from None
    found._source = path  # type: ignore[attr-defined]
    return found


def flattened(table: dict[str, Any], above: str = "") -> dict[str, Any]:
    """Write nested tables as one with dotted keys; intervals stay whole.

    Examples
    --------
    >>> flattened({"law": {"psi_b": [0.3, 0.5]}, "seed": [1, 2]})
    {'law.psi_b': [0.3, 0.5], 'seed': [1, 2]}
    """
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict) and not {"low", "high", "mean"} & set(value):
            flat |= flattened(value, f"{above}{key}.")
        else:
            flat[above + key] = value
    return flat


def unit_of(value: Any) -> str:
    """SI unit of a value of a case, empty for plain numbers and words."""
    if not isinstance(value, str):
        return ""
    try:
        return dimension(value) or ""
    except InputError:
        return ""


def number(value: Any, unit: str) -> float:
    """Value in an SI unit; a plain number is in it already."""
    from pestle.config.base import reworded

    try:
        return to_si(value, unit or "1")
    except InputError as error:
        raise reworded(error) from None
