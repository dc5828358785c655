"""What a contact law is: facts, constants, state and one pure function.

A law is a frozen dataclass of its options plus pure functions of floats, brought
together by `register`.  The engine's loop knows no law: it is compiled anew for each.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Any, NamedTuple

from pestle.errors import InputError, nearest


class Geometry(NamedTuple):
    """How two particles, or a particle and a wall, stand to each other."""

    overlap: float  # R_i + R_j - distance, positive in compression [m]
    radius: float  # R* = R_i R_j / (R_i + R_j); R_i against a wall [m]
    radius_i: float  # apparent radius of the first particle [m]
    radius_j: float  # apparent radius of the second particle, 0 for a wall [m]
    weight: float  # screening weight of the pair, 1 unless the law is screened [-]
    force: float  # normal force without damping of the step before [N]


class Response(NamedTuple):
    """What a law answers to a geometry and a state."""

    force: float  # normal force without damping, repulsion positive [N]
    radius: float  # contact radius [m]
    stiffness: float  # |dF/d overlap| [N/m]: damping and time step use it
    stored: float  # recoverable energy of the contact [J]
    damping: float  # factor on the viscous damping of the pair [-]


class Nothing(NamedTuple):
    """State of a law that remembers nothing, fields of one that needs none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Solid:
    """Constants of one material as a law reads them; a rigid tool has infinite modulus."""

    youngs_modulus: float = inf  # E [Pa]
    poisson_ratio: float = 0.0  # nu [-]
    yield_stress: float = inf  # Y [Pa]
    density: float = 0.0  # [kg/m^3]

    @property
    def compliance(self) -> float:
        """Plane-strain compliance (1 - nu^2)/E [1/Pa]."""
        return (1.0 - self.poisson_ratio**2) / self.youngs_modulus

    @property
    def shear_modulus(self) -> float:
        """G = E/(2(1 + nu)) [Pa]."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def bulk_modulus(self) -> float:
        """kappa = E/(3(1 - 2 nu)) [Pa]."""
        return self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poisson_ratio))


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Two materials that meet, and what belongs to the pair; `wall` if the second is one."""

    first: Solid
    second: Solid
    work_of_adhesion: float = 0.0  # W [J/m^2]
    wall: bool = False

    @property
    def modulus(self) -> float:
        """E* of the pair, 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 [Pa]."""
        return 1.0 / (self.first.compliance + self.second.compliance)

    @property
    def shear_modulus(self) -> float:
        """G* of the pair, 1/G* = (2 - nu_1)/G_1 + (2 - nu_2)/G_2 [Pa]."""
        one, two = self.first, self.second
        return 1.0 / (
            (2.0 - one.poisson_ratio) / one.shear_modulus
            + (2.0 - two.poisson_ratio) / two.shear_modulus
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Parts:
    """The compiled parts of a law: what `register` was given."""

    law: type
    constants: type
    state: type
    contact: Callable[..., Any]
    reach: Callable[..., Any]
    wall: Callable[..., Any] | None = None
    particle: type = Nothing
    sums: type = Nothing
    update: Callable[..., Any] | None = None
    screened: bool = False


_REGISTRY: dict[str, Parts] = {}


def no_reach(k: Any, g: Geometry) -> float:
    """Reach of a law that neither pulls nor remembers beyond touch [m]."""
    return 0.0


def register(law: type, *, aliases: tuple[str, ...] = (), **parts: Any) -> None:
    """Make a law known under its `name` and `aliases`.

    Parameters
    ----------
    law : type
        Frozen dataclass whose fields are the law's options, with ``name``,
        ``citation`` and ``constants(pair)``.
    aliases : tuple of str
        Further names.
    **parts
        ``constants`` and ``state`` (NamedTuples of floats), ``contact(k, g, s)`` and,
        where the law pulls beyond touch, ``reach(k, g)`` [m].  A multi-neighbour law
        adds ``particle``, ``sums``, ``wall`` and ``update``, see `zunker2024`.
    """
    parts.setdefault("reach", no_reach)
    entry = Parts(law=law, **parts)
    for name in (law.name, *aliases):  # type: ignore[attr-defined]
        _REGISTRY[name] = entry


def parts_of(law: Any) -> Parts:
    """Return the compiled parts of a law object, class or name."""
    if isinstance(law, Parts):
        return law
    if isinstance(law, str):
        return _lookup(law)
    name = law.name
    if name not in _REGISTRY:
        raise InputError(
            "law-not-registered",
            f"the law {name!r} has no registered functions",
            hint="call pestle.laws.register(...) at the end of the law's file",
        )
    return _REGISTRY[name]


def _lookup(name: str) -> Parts:
    if name not in _REGISTRY:
        close = nearest(name, list(_REGISTRY))
        raise InputError(
            "unknown-law",
            f"there is no contact law {name!r}",
            hint=f"did you mean {close!r}?"
            if close
            else f"known laws: {', '.join(names())}",
        )
    return _REGISTRY[name]


def get(name: str) -> type:
    """Return the law class of a name or alias."""
    return _lookup(name).law


def names() -> list[str]:
    """Names of all laws, without aliases."""
    return sorted({parts.law.name for parts in _REGISTRY.values()})  # type: ignore[attr-defined]
