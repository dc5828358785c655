"""Published material sets: data files with a source for every value."""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from pestle.errors import InputError, did_you_mean

CONSTANTS = ("youngs_modulus", "poisson_ratio", "density", "yield_stress")
"""Values that belong to the material alone."""


@dataclass(frozen=True, slots=True)
class Value:
    """One value of a material set.

    Parameters
    ----------
    value : float
        The value that is used, in `unit`.
    unit : str
        SI unit; "1" for a plain number.
    source : str
        DOI.
    low, high : float, optional
        Range that the source gives.
    note : str
        How the value was obtained or chosen.
    """

    value: float
    unit: str
    source: str
    low: float | None = None
    high: float | None = None
    note: str = ""


@dataclass(frozen=True, slots=True)
class Material:
    """A published set of constants; `name` is how a case file calls it.

    Parameters
    ----------
    name, title : str
        Name of the set, and what it is in words.
    citation : str
        BibTeX of the sources.
    material : dict of str to Value
        Constants of the material alone, see `CONSTANTS`.
    between : dict of str to Value
        Properties of a pair of its particles.
    walls : dict of str to Value
        Properties of a particle and a wall, where they differ.
    suggested : dict of str to Value
        What else the source used: law options, particle sizes.
    """

    name: str
    title: str
    citation: str
    material: dict[str, Value]
    between: dict[str, Value]
    walls: dict[str, Value]
    suggested: dict[str, Value]

    def constants(self) -> dict[str, float]:
        """Constants of the material by name, in SI units."""
        return {key: entry.value for key, entry in self.material.items()}

    @property
    def contacts(self) -> dict[str, float]:
        """Properties of a pair of its particles by name, in SI units."""
        return {key: entry.value for key, entry in self.between.items()}

    @property
    def wall_contacts(self) -> dict[str, float]:
        """Properties of a particle and a wall by name, in SI units."""
        return {key: entry.value for key, entry in self.walls.items()}

    def values(self) -> dict[str, Value]:
        """All values, keyed by group and name such as "walls.sliding_friction"."""
        groups = ("material", "between", "walls", "suggested")
        return {
            f"{group}.{key}": entry
            for group in groups
            for key, entry in getattr(self, group).items()
        }


def names() -> list[str]:
    """Names of all packaged material sets."""
    entries = files(__name__).iterdir()
    return sorted(
        e.name.removesuffix(".toml") for e in entries if e.name[-5:] == ".toml"
    )


@cache
def load(name: str) -> Material:
    """Read a packaged material set.

    Examples
    --------
    >>> load("avicel_ph102_zunker2025").constants()["density"]
    1560.0
    """
    known = names()
    if name not in known:
        raise InputError(
            "unknown-material-set",
            f'there is no material set "{name}"',
            hint=did_you_mean(name, known),
        )
    text = (files(__name__) / f"{name}.toml").read_text(encoding="utf-8")
    data = tomllib.loads(text)
    groups = {
        group: {key: Value(**entry) for key, entry in data.get(group, {}).items()}
        for group in ("material", "between", "walls", "suggested")
    }
    return Material(
        name=name, title=data["title"], citation=data["citation"].strip(), **groups
    )
