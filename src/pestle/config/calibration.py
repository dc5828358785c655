"""A calibration file: measured data, and the parameters that shall explain them."""

import csv
import re
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PrivateAttr, model_validator

from pestle.config.base import Section, problem
from pestle.config.quantities import Count, Length, Seed, Text
from pestle.config.study import Interval, flattened, number
from pestle.errors import InputError, did_you_mean
from pestle.units import to_si

CURVES = {
    "axial_stress": "axial",
    "transmitted_stress": "transmitted",
    "die_wall_stress": "radial",
}
"""Stresses over the relative density that a compaction can be compared with, of the
upper punch, the lower punch and the die wall, and their names in `DieCurves`."""


class Parameter(Interval):
    """A parameter: bounds, and what is believed of it before the data."""

    mean: float | str | None = None
    """Mean of a normal prior; without it all values are as likely on the scale."""
    deviation: float | str | None = None
    """Standard deviation of the normal prior."""

    @model_validator(mode="after")
    def _check_prior(self) -> "Parameter":
        if (self.mean is None) != (self.deviation is None):
            what = "mean and deviation of a prior belong together"
            raise problem("contradiction", what, "give both or none", ("mean",))
        if self.points is not None or self.whole:
            what = "points and whole belong to a study"
            raise problem("contradiction", what, "remove them", ("low",))
        return self

    @property
    def normal(self) -> tuple[float, float] | None:
        """Mean and standard deviation of a normal prior [`unit`]."""
        if self.mean is None:
            return None
        return number(self.mean, self.unit), number(self.deviation, self.unit)


class ParticleData(Section):
    """Force curve of one particle between two platens."""

    file: Text
    """CSV with the columns "displacement [unit]" and "force [unit]"."""
    law: Text
    """Law of a particle, with one of unloading behind a plus."""
    diameter: Length
    """Diameter of the particle before [m]."""
    fixed: dict[str, Any] = Field(default_factory=dict)
    """Values of the other parameters."""


class Target(Section):
    """What was measured of the bulk: a number, or a curve over the density."""

    metric: Text | None = None
    """Key of a number in metrics.json."""
    value: float | str | None = None
    """What was measured of it."""
    curve: Literal["axial_stress", "transmitted_stress", "die_wall_stress"] | None = (
        None
    )
    """Curve of the loading over the relative density: upper punch, lower, wall."""
    file: Text | None = None
    """CSV with the columns "relative_density [-]" and that of the curve."""
    points: Count = 5
    """Number of densities at which a curve is compared, spread evenly [-]."""
    deviation: float | str
    """Standard deviation of the measurement."""

    @model_validator(mode="after")
    def _one_kind(self) -> "Target":
        number_given = self.metric is not None and self.value is not None
        curve_given = self.curve is not None and self.file is not None
        either = (self.metric or self.value) is not None
        if number_given == curve_given or (curve_given and either):
            what = "a target is a metric with its value, or a curve with its file"
            raise problem("contradiction", what, "give one of the two", ("metric",))
        return self


class BulkData(Section):
    """A case whose results are compared with measurements."""

    case: Text
    """Case file, relative to this one."""
    set: dict[str, Any] = Field(default_factory=dict)
    """Values of the case that differ from the file."""
    targets: tuple[Target, ...] = Field(min_length=1)
    """What was measured."""
    first: Count | None = None
    """Runs before the first surrogate, by default six for each parameter [-]."""
    most: Count = 60
    """Most runs of all [-]."""

    @model_validator(mode="before")
    @classmethod
    def _flatten(cls, data: Any) -> Any:
        if isinstance(data, dict) and isinstance(data.get("set"), dict):
            data = {**data, "set": flattened(data["set"])}
        return data


class CalibrationSettings(Section):
    """Data, parameters, seeds."""

    schema_version: Literal[1] = 1
    """Version of the format [-]."""
    title: Text = ""
    """Name for people."""
    source: Text
    """Where the data come from; kept with the parameters."""
    seed: Seed = 1
    """Seed of designs and chains [-]."""
    parameters: Annotated[dict[str, Parameter], Field(min_length=1)]
    """Parameters by name: of the law, or by key of the case."""
    particle: ParticleData | None = None
    """Data of one particle."""
    bulk: BulkData | None = None
    """Data of the bulk."""
    _source: Path = PrivateAttr(default=Path())

    @model_validator(mode="before")
    @classmethod
    def _flatten(cls, data: Any) -> Any:
        if isinstance(data, dict) and isinstance(data.get("parameters"), dict):
            data = {**data, "parameters": flattened(data["parameters"])}
        return data

    @model_validator(mode="after")
    def _one_kind(self) -> "CalibrationSettings":
        if (self.particle is None) == (self.bulk is None):
            what = "a calibration has [particle] or [bulk]"
            raise problem("contradiction", what, "give one of the two", ("particle",))
        return self

    def resolve(self, name: str) -> Path:
        """Path of a file that the calibration names."""
        return self._source.parent / name


def read_columns(path: Path, units: dict[str, str]) -> dict[str, NDArray[np.float64]]:
    """Columns of a CSV in SI units; their unit stands in brackets behind the name.

    Parameters
    ----------
    path : Path
        The file.
    units : dict
        SI unit of each column that is wanted, by name.
    """
    try:
        rows = list(csv.reader(path.read_text(encoding="utf-8-sig").splitlines()))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError("unreadable-curve", f"{path}: {error}") from None
    head = [name.strip() for name in rows[0]] if rows else []
    body = [row for row in rows[1:] if any(cell.strip() for cell in row)]
    found = {}
    for name, unit in units.items():
        at, factor = _column(path, head, name, unit)
        try:
            found[name] = np.array([factor * float(row[at]) for row in body])
        except (ValueError, IndexError) as error:
            what = f"{name} holds something that is no number: {error}"
            raise InputError("not-a-number", what, str(path)) from None
    return found


def _column(path: Path, head: list[str], name: str, unit: str) -> tuple[int, float]:
    for at, text in enumerate(head):
        match = re.fullmatch(rf"{name}\s*\[(.+)\]", text)
        if match:
            factor = "1" if match[1] == "-" else f"1 {match[1]}"
            return at, to_si(factor if unit != "1" else 1.0, unit)
    raise InputError(
        "missing-column",
        f'{path} has no column "{name} [unit]"',
        f"{path}:1",
        did_you_mean(name, head) if head else "the file is empty",
    )
