"""Find laws of a single particle by name and make them from one set of parameters."""

import dataclasses
from collections.abc import Mapping
from typing import Any

from pestle.errors import InputError, did_you_mean
from pestle.particle.cycle import Cycle
from pestle.particle.law import LOADING, UNLOADING, Loading, Unloading
from pestle.particle.zunker2024 import Zunker2024

WholeLaw = Cycle | Zunker2024
"""A law that follows any path."""


def names() -> list[str]:
    """Names of all loading laws."""
    return sorted(LOADING)


def unloading_names() -> list[str]:
    """Names of all unloading laws."""
    return sorted(UNLOADING)


def find(name: str) -> tuple[type[Loading], type[Unloading] | None]:
    """Loading and unloading law of a name such as "shahin2021+edmans2020"."""
    first, plus, second = name.partition("+")
    if first not in LOADING:
        raise InputError(
            "unknown-particle-law",
            f"there is no loading law {first!r} of a particle",
            hint=did_you_mean(first, LOADING),
        )
    if not plus:
        return LOADING[first], None
    if issubclass(LOADING[first], Zunker2024):
        raise InputError(
            "law-unloads-itself",
            f"{first} unloads by itself and takes no other law for it",
            hint=f'write "{first}" alone',
        )
    if second not in UNLOADING:
        raise InputError(
            "unknown-particle-law",
            f"there is no unloading law {second!r}",
            hint=did_you_mean(second, UNLOADING),
        )
    return LOADING[first], UNLOADING[second]


def fields(name: str) -> "dict[str, dataclasses.Field[Any]]":
    """Parameters of a law by name; loading and unloading share those they both have."""
    parts = [part for part in find(name) if part is not None]
    return {f.name: f for part in reversed(parts) for f in dataclasses.fields(part)}


def build(name: str, parameters: Mapping[str, Any]) -> WholeLaw:
    """Make a law such as "shahin2021+edmans2020" from one set of parameters.

    Examples
    --------
    >>> law = build("biwa1995", {"strength": 6e6, "hardening_exponent": 0.65})
    >>> law.name
    'biwa1995'
    """
    known = fields(name)
    for key in parameters:
        if key not in known:
            raise InputError(
                "unknown-law-parameter",
                f"{name} has no parameter {key!r}",
                hint=did_you_mean(key, known),
            )
    missing = [
        key
        for key, entry in known.items()
        if key not in parameters and entry.default is dataclasses.MISSING
    ]
    if missing:
        raise InputError(
            "missing-law-parameter",
            f"{name} needs {', '.join(missing)}",
            hint="give them with --set; pestle bench LAW --help says what they mean",
        )
    first, second = find(name)
    loading = _make(first, parameters)
    if isinstance(loading, Zunker2024):
        return loading
    return Cycle(
        loading=loading, unloading=None if second is None else _make(second, parameters)
    )


def _make(part: type[Any], parameters: Mapping[str, Any]) -> Any:
    own = {f.name for f in dataclasses.fields(part)}
    return part(**{key: value for key, value in parameters.items() if key in own})
