"""Options of a law: fields that carry their help, SI unit and possible values.

The same words make the command line's help, the schema of case files and the error.
"""

import dataclasses
from dataclasses import MISSING, field
from math import inf
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from pestle.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def parameter(
    text: str,
    unit: str = "1",
    low: float = 0.0,
    high: float = inf,
    ends: str = "()",
    *,
    default: Any = MISSING,
) -> Any:
    """Field of a number with its help and the interval of its possible values.

    Parameters
    ----------
    text : str
        What it is.
    unit : str
        SI unit, "1" for a plain number.
    low, high : float
        Ends of the interval [unit].
    ends : {"()", "[)", "(]", "[]"}
        Which ends belong to it; infinity never does.
    default : float, optional
        Without it the number must be given; None is taken as it is.
    """
    metadata = {"help": text, "unit": unit, "low": low, "high": high, "ends": ends}
    return field(default=default, metadata=metadata)


def choice(text: str, options: tuple[str, ...], *, default: str) -> Any:
    """Field that is one of a few words."""
    return field(default=default, metadata={"help": text, "choices": options})


def flag(text: str, *, default: bool) -> Any:
    """Field that is true or false."""
    return field(default=default, metadata={"help": text})


class Checked:
    """A dataclass that refuses options outside what their fields allow."""

    __slots__ = ()
    name: ClassVar[str]
    __dataclass_fields__: ClassVar[dict[str, dataclasses.Field[Any]]]

    def __post_init__(self) -> None:
        """Refuse what is not possible."""
        for entry in dataclasses.fields(self):
            value = getattr(self, entry.name)
            if "choices" in entry.metadata:
                _check_choice(self.name, entry, value)
            elif "low" in entry.metadata and value is not None:
                _check_number(self.name, entry, value)
        self._check()

    def _check(self) -> None:
        """Refuse options that contradict each other; laws fill it in."""


class PairLaw(Checked):
    """A law of two particles: it checks its options and draws itself."""

    __slots__ = ()

    def plot(self, **options: Any) -> "Figure":
        """Draw loading and unloading; options of `pestle.bench.figure.draw_pair_law`.

        Without options: a particle of 50 um and a rigid wall, E = 5 GPa, nu = 0.3,
        Y = 20 MPa, W = 0.1 J/m^2.
        """
        from pestle.bench.figure import draw_pair_law

        return draw_pair_law(self, **options)


def _check_choice(law: str, entry: "dataclasses.Field[Any]", value: Any) -> None:
    options = entry.metadata["choices"]
    if value not in options:
        raise InputError(
            "unknown-option",
            f"{entry.name} of {law} cannot be {value!r}",
            f"{law}.{entry.name}",
            did_you_mean(str(value), options),
        )


def _check_number(law: str, entry: "dataclasses.Field[Any]", value: Any) -> None:
    low, high, unit, ends = (
        entry.metadata[key] for key in ("low", "high", "unit", "ends")
    )
    numbers = np.asarray(value, dtype=float)
    above = numbers >= low if ends[0] == "[" else numbers > low
    below = numbers <= high if ends[1] == "]" else numbers < high
    fits = np.isfinite(numbers) & above & below
    if not np.all(fits):
        raise InputError(
            "law-parameter-out-of-range",
            f"{entry.name} = {np.ravel(numbers[~fits])[0]:g} is not possible for {law}",
            f"{law}.{entry.name}",
            f"{entry.name} lies in {ends[0]}{low:g}, {high:g}{ends[1]}"
            f"{'' if unit == '1' else f' {unit}'}: {entry.metadata['help']}",
        )
