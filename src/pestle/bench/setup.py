"""Put a law on the bench by name, with one set of parameters.

A name is that of a pair law ("hertz") or of a law of a particle, with a law of
unloading behind a plus ("shahin2021+edmans2020"); a law that exists as both, such as
zunker2024, is the particle.
"""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pestle import laws
from pestle.bench.subject import PairContact, SingleParticle, Subject
from pestle.errors import InputError, did_you_mean
from pestle.particle import library
from pestle.particle.configuration import checked
from pestle.particle.law import LOADING, UNLOADING


@dataclass(frozen=True)
class Parameter:
    """A number or word that a law needs."""

    text: str
    unit: str  # SI; "1" for a plain number
    default: Any = None  # none: it must be given
    choices: tuple[str, ...] = ()
    required: bool = True
    kind: type = float


SOLID = {
    "youngs_modulus": Parameter("Young's modulus of the particles", "Pa"),
    "poisson_ratio": Parameter("Poisson ratio of the particles", "1"),
    "yield_stress": Parameter(
        "uniaxial yield stress of the particles", "Pa", float("inf"), required=False
    ),
    "work_of_adhesion": Parameter(
        "work of adhesion of the pair", "J/m^2", 0.0, required=False
    ),
}
"""Material of a pair law, besides the law's own options."""

DENSITY = Parameter("density of the solid, for impacts", "kg/m^3", 0.0, required=False)


def names() -> list[str]:
    """Names of all laws that can be put on the bench, without those of unloading."""
    return sorted({*laws.names(), *library.names()})


def is_particle_law(name: str) -> bool:
    """Whether a name is that of a law of a particle."""
    first = name.partition("+")[0]
    if first in library.names():
        return True
    if first != name:
        raise InputError(
            "unknown-law",
            f"{name}: only a law of a particle takes a law of unloading",
            hint=did_you_mean(first, library.names()),
        )
    if name not in laws.names() and not _is_alias(name):
        raise InputError(
            "unknown-law",
            f"there is no law {name!r} for the bench",
            hint=did_you_mean(name, names()),
        )
    return _pair_law(name).name in library.names()


def _is_alias(name: str) -> bool:
    try:
        laws.get(name)
    except InputError:
        return False
    return True


def _pair_law(name: str) -> Any:
    return laws.get(name)


def canonical(name: str) -> str:
    """Name of a law without aliases, such as zunker2024 for mdr."""
    if is_particle_law(name) and name.partition("+")[0] not in library.names():
        return str(_pair_law(name).name)
    return name


def parts_of(name: str) -> list[Any]:
    """Classes behind a name: a pair law, or loading and unloading of a particle."""
    if not is_particle_law(name):
        return [_pair_law(name)]
    return [part for part in library.find(canonical(name)) if part is not None]


def everything() -> dict[str, list[Any]]:
    """All laws for the bench, by what they are."""
    pairs = [_pair_law(name) for name in laws.names() if not is_particle_law(name)]
    return {
        "pairs of particles, or a particle and a wall": pairs,
        "a particle between flats, pressed": [LOADING[n] for n in library.names()],
        "a particle between flats, released; behind a plus": [
            UNLOADING[name] for name in library.unloading_names()
        ],
    }


def parameters(name: str) -> dict[str, Parameter]:
    """What a law needs, by name."""
    if is_particle_law(name):
        found = library.fields(canonical(name))
        own = {key: _of_field(entry) for key, entry in found.items()}
        return {**own, "density": DENSITY}
    fields = dataclasses.fields(_pair_law(name))
    return {**SOLID, "density": DENSITY, **{f.name: _of_field(f) for f in fields}}


def _of_field(entry: "dataclasses.Field[Any]") -> Parameter:
    required = entry.default is dataclasses.MISSING
    default = None if required else entry.default
    kind = type(default) if isinstance(default, bool | int | str) else float
    return Parameter(
        entry.metadata.get("help", ""),
        entry.metadata.get("unit", "1"),
        default,
        tuple(entry.metadata.get("choices", ())),
        required,
        kind,
    )


def subject(
    name: str,
    values: Mapping[str, Any],
    *,
    radius: float,
    configuration: str = "simple",
    other_radius: float = 0.0,
    flats: tuple[float, ...] = (),
) -> Subject:
    """Put a law on the bench.

    Parameters
    ----------
    name : str
        Name of the law.
    values : mapping
        Its parameters in SI units; those it does not know are an error.
    radius : float
        Radius of the particle [m].
    configuration : str
        How flats press a particle; pair laws do not look at it.
    other_radius : float
        Radius of the second particle of a pair; 0 is a rigid wall [m].
    flats : tuple of float
        Any set of flats in place of the configuration, see `SingleParticle` [-].
    """
    known = parameters(name)
    for key in values:
        if key not in known:
            raise InputError(
                "unknown-law-parameter",
                f"{name} has no parameter {key!r}",
                hint=did_you_mean(key, known),
            )
    missing = [k for k, p in known.items() if p.required and k not in values]
    if missing:
        raise InputError(
            "missing-law-parameter",
            f"{name} needs {', '.join(missing)}",
            hint="pestle bench LAW --help says what they mean",
        )
    own = {key: value for key, value in values.items() if key != "density"}
    density = float(values.get("density", 0.0))
    if is_particle_law(name):
        return SingleParticle(
            law=library.build(canonical(name), own),
            radius=radius,
            configuration=checked(configuration),
            density=density,
            flats=flats,
        )
    if flats:
        raise InputError(
            "configuration-without-law",
            f"{name} is a law of a pair: it knows no set of flats",
            "--flats",
            "take zunker2024",
        )
    law = _pair_law(name)(**{k: v for k, v in own.items() if k not in SOLID})
    keys = ("youngs_modulus", "poisson_ratio", "yield_stress")
    solid = laws.Solid(density=density, **{k: own[k] for k in keys if k in own})
    is_wall = other_radius == 0.0
    pair = laws.Pair(
        first=solid,
        second=laws.Solid() if is_wall else solid,
        work_of_adhesion=own.get("work_of_adhesion", 0.0),
        wall=is_wall,
    )
    return PairContact(law=law, pair=pair, radius=radius, other_radius=other_radius)
