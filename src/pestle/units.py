"""Quantities with units at the edge: "150 MPa" becomes 1.5e8.

Only this module knows pint. Text is split by a pattern of our own before pint
sees the unit alone, so that nothing in a case file is ever evaluated.
"""

import math
import re
from decimal import Decimal
from functools import cache
from typing import Any

from pestle.errors import InputError, nearest

DIMENSIONS = {
    "1": "number",
    "m": "length",
    "m^2": "area",
    "s": "time",
    "1/s": "rate",
    "m/s": "speed",
    "m/s^2": "acceleration",
    "kg/m^3": "density",
    "N": "force",
    "Pa": "stress",
    "J/m^2": "energy per area",
    "N/m": "stiffness",
    "1/m": "stiffening",
    "kg": "mass",
    "rad": "angle",
}
"""SI units in use and what they measure."""

EXAMPLES = {
    "m": "150 um",
    "s": "0.1 ms",
    "1/s": "10 1/s",
    "m/s": "1 m/s",
    "m/s^2": "9.81 m/s^2",
    "kg/m^3": "1560 kg/m^3",
    "kg": "12 g",
    "N": "30 N",
    "Pa": "150 MPa",
    "J/m^2": "300 J/m^2",
    "1/m": "5e5 1/m",
}
"""How a person would write a value of each SI unit."""

_PREFIXED = ("um", "mm", "cm", "kPa", "MPa", "GPa", "ns", "us", "ms", "min", "kN")
_COMMON = (*DIMENSIONS, *_PREFIXED, "mN", "mm/s", "g/cm^3")
_NUMBER = r"[+-]?(?:\d+(?:_\d+)*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[+-]?(?:inf|nan)"
_TERM = r"[A-Za-zµμ°%]+(?:(?:\^|\*\*)?[+-]?[1-9]|[²³])?"
_UNIT = rf"(?:1\s*/\s*)?{_TERM}(?:\s*[*/·]\s*{_TERM}|\s+{_TERM})*"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*({_UNIT})?\s*", re.IGNORECASE)
_LONGEST = 60


def to_si(value: object, unit: str) -> float:
    """Convert a number or a text with a unit to a float in the SI unit `unit`.

    Parameters
    ----------
    value : float or str
        A number, taken to be in `unit`, or a text such as ``"150 MPa"``.
    unit : str
        SI unit of the result; one of `DIMENSIONS`.

    Returns
    -------
    float
        The value [`unit`].

    Raises
    ------
    InputError
        With the id ``bad-quantity``, ``unknown-unit``, ``wrong-unit`` or
        ``not-finite``.

    Examples
    --------
    >>> to_si("150 MPa", "Pa")
    150000000.0
    >>> to_si(0.3, "1")
    0.3
    >>> to_si("3 mm", "Pa")
    Traceback (most recent call last):
        ...
    pestle.errors.InputError: error[wrong-unit]: "3 mm" is a length, not a stress
      hint: write it like "150 MPa" or as a number in Pa
    """
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise InputError(
            "bad-quantity",
            f"{shown(value)} is not a {DIMENSIONS[unit]}",
            hint=_advice(unit),
        )
    if isinstance(value, str):
        number, text = split(value, unit)
        result = _convert(number, text, value, unit)
    else:
        result = _as_float(value)
    if not math.isfinite(result):
        raise InputError(
            "not-finite", f"{shown(value)} is not a finite number", hint=_advice(unit)
        )
    return result


def split(text: str, unit: str = "1") -> tuple[float, str]:
    """Split a text into its number and its unit, ``"3 mm"`` into 3.0 and "mm"."""
    match = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST else None
    if match is None:
        raise InputError(
            "bad-quantity",
            f"{shown(text)} is not a number" + ("" if unit == "1" else " with a unit"),
            hint=_advice(unit),
        )
    return float(match[1]), match[2] or ""


def dimension(text: str) -> str | None:
    """Return the SI unit of `DIMENSIONS` that a text has the dimension of.

    Examples
    --------
    >>> dimension("30 kN")
    'N'
    >>> dimension("3") is None
    True
    """
    _, unit = split(text)
    if not unit:
        return None
    _, dimensions = _base(unit)
    for known in DIMENSIONS:
        if known not in ("1", "rad") and _base(known)[1] == dimensions:
            return known
    return None


def _convert(number: float, text: str, value: str, unit: str) -> float:
    if not text:
        if unit == "1":
            return number
        raise InputError("bad-quantity", f'"{value}" has no unit', hint=_advice(unit))
    factor, dimensions = _base(text)
    if dimensions != _base("dimensionless" if unit == "1" else unit)[1]:
        is_now = dimension(value)
        kind = f"a {DIMENSIONS[is_now]}" if is_now else f"in {text}"
        raise InputError(
            "wrong-unit",
            f'"{value}" is {kind}, not a {DIMENSIONS[unit]}',
            hint=_advice(unit),
        )
    return _tidy(number, factor)


def _tidy(number: float, factor: float) -> float:
    """Multiply so that decimal prefixes stay exact: 150 um is 0.00015 m."""
    exponent = round(math.log10(factor)) if factor > 0.0 else 0
    is_prefix = math.isclose(factor, 10.0**exponent, rel_tol=1e-12)
    if is_prefix and math.isfinite(number):
        return float(Decimal(repr(number)).scaleb(exponent))
    return number * factor


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry(autoconvert_offset_to_baseunit=False, cache_folder=None)


@cache
def _base(unit: str) -> tuple[float, str]:
    """Return how many SI base units a unit is, and its dimensions."""
    from pint.errors import PintError

    text = unit.replace("µ", "u").replace("μ", "u").replace("·", "*")
    text = text.replace("²", "^2").replace("³", "^3").replace("%", "percent")
    text = re.sub(r"(?<=[A-Za-z])(?=[+-]?\d)", "^", text)
    text = re.sub(r"(?<=[A-Za-z\d])\s+(?=[A-Za-z])", "*", text)
    text = re.sub(r"^1\s*/\s*", "dimensionless/", text)
    try:
        quantity = (1.0 * _registry().parse_units(text)).to_base_units()
        return float(quantity.magnitude), str(quantity.dimensionality)
    except (PintError, ArithmeticError, LookupError, TypeError, ValueError) as error:
        match = nearest(unit, _COMMON)
        hint = f'did you mean "{match}"?' if match else "case matters: MPa, um, J/m^2"
        what = f'"{unit}" is not a unit that a case file can use'
        raise InputError("unknown-unit", what, hint=hint) from error


def _as_float(value: int | float) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _advice(unit: str) -> str:
    if unit == "1":
        return "write a plain number"
    return f'write it like "{EXAMPLES.get(unit, "1 " + unit)}" or as a number in {unit}'


def shown(value: object) -> str:
    """Show a value as the case file would, cut to a readable length."""
    if isinstance(value, bool):
        text = "true" if value else "false"
    elif isinstance(value, str):
        text = f'"{value}"'
    elif isinstance(value, int) and abs(value) > 10**30:
        text = "a number of more than 30 digits"
    elif isinstance(value, int | float | list | tuple | dict):
        text = repr(value)
    else:
        text = str(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."
