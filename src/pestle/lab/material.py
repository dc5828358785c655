"""Material of the lab: Young's modulus is 1, stresses are in moduli."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import inf, isfinite

import numpy as np
from numpy.typing import NDArray

from pestle.errors import InputError
from pestle.lab._constitutive import PERFECT, POWER, TABLE

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Hardening:
    """Flow stress against plastic strain, in initial yield stresses.

    Parameters
    ----------
    exponent : float
        n of the power law (1 + strain/reference)^n [-]; 0 is perfectly plastic.
    reference : float, optional
        Reference strain of the power law [-], by default the yield strain Y/E.
    table : sequence of pairs, optional
        Plastic strain [-] and flow stress in initial yield stresses [-], instead of the
        power law; straight in between, constant beyond the last pair.

    Examples
    --------
    >>> Hardening(table=((0.0, 1.0), (0.1, 1.5))).table
    ((0.0, 1.0), (0.1, 1.5))
    """

    exponent: float = 0.0
    reference: float | None = None
    table: tuple[tuple[float, float], ...] | None = None

    def __post_init__(self) -> None:
        if self.table is not None:
            _check_table(self.table)
            if self.exponent != 0.0 or self.reference is not None:
                raise InputError(
                    "two-hardening-laws",
                    "a table and a power law of hardening are given",
                    hint="keep one of them",
                )
        if not 0.0 <= self.exponent <= 1.0:
            raise InputError(
                "hardening-exponent-out-of-range",
                f"a hardening exponent of {self.exponent!r} is not possible",
                hint="0 is perfectly plastic, 1 is linear",
            )
        if self.reference is not None and not 0.0 < self.reference < inf:
            raise InputError(
                "reference-strain-out-of-range",
                f"a reference strain of {self.reference!r} is not possible",
                hint="give a positive number, such as 0.002",
            )


def _check_table(table: Sequence[tuple[float, float]]) -> None:
    rows = np.array(table, dtype=float)
    if rows.ndim != 2 or rows.shape[1] != 2 or not np.isfinite(rows).all():
        raise InputError(
            "hardening-table-unreadable",
            "a hardening table needs pairs of plastic strain and flow stress",
            hint="such as 0:1,0.1:1.4,0.5:1.9",
        )
    if rows[0, 0] != 0.0 or (np.diff(rows[:, 0]) <= 0.0).any():
        raise InputError(
            "hardening-table-order",
            f"plastic strains {rows[:, 0].tolist()} do not rise from 0",
            hint="begin with 0 and let every strain exceed the one before",
        )
    if rows[0, 1] != 1.0 or (np.diff(rows[:, 1]) < 0.0).any():
        raise InputError(
            "hardening-table-softens",
            f"flow stresses {rows[:, 1].tolist()} do not rise from 1",
            hint="they are in initial yield stresses: the first is 1, none is smaller "
            "than the one before (softening has no unique answer)",
        )


@dataclass(frozen=True)
class Material:
    """Elastic-plastic material with Young's modulus 1.

    Parameters
    ----------
    modulus_ratio : float
        Young's modulus over yield stress, E/Y [-].
    poisson_ratio : float
        nu [-].
    hardening : Hardening
        By default none: perfectly plastic.

    Examples
    --------
    >>> Material(200.0, 0.25).yield_stress
    0.005
    """

    modulus_ratio: float
    poisson_ratio: float
    hardening: Hardening = field(default_factory=Hardening)

    def __post_init__(self) -> None:
        if not (isfinite(self.modulus_ratio) and self.modulus_ratio > 0.0):
            raise InputError(
                "modulus-ratio-out-of-range",
                f"a modulus ratio E/Y of {self.modulus_ratio!r} is not possible",
                hint="moduli and yield stresses are positive; metals and powders have "
                "E/Y of 5 to 1000",
            )
        if not -1.0 < self.poisson_ratio <= 0.495:
            raise InputError(
                "poisson-ratio-out-of-range",
                f"a Poisson ratio of {self.poisson_ratio!r} is not possible here",
                hint="-1 < nu < 0.5, and at most 0.495: the bulk modulus is finite",
            )

    def stiffening(self) -> Iterator["Material"]:
        """Yield softer materials up to this one: E/Y from 25 on, times 1.5.

        A first touch that does not converge is approached through them.
        """
        ratio = 25.0
        while ratio < self.modulus_ratio:
            yield replace(self, modulus_ratio=ratio)
            ratio *= 1.5
        yield self

    @property
    def yield_stress(self) -> float:
        """Initial yield stress [E]."""
        return 1.0 / self.modulus_ratio

    @property
    def bulk(self) -> float:
        """Bulk modulus [E]."""
        return 1.0 / (3.0 * (1.0 - 2.0 * self.poisson_ratio))

    @property
    def shear(self) -> float:
        """Shear modulus [E]."""
        return 0.5 / (1.0 + self.poisson_ratio)

    @property
    def plane_strain_modulus(self) -> float:
        """E* of the sphere on a rigid flat [E]."""
        return 1.0 / (1.0 - self.poisson_ratio**2)

    def kernel_constants(self) -> tuple[Floats, Floats]:
        """Constants and table as the element loop reads them."""
        h, y = self.hardening, self.yield_stress
        if h.table is not None:
            kind, rows = TABLE, [(e, y * s) for e, s in h.table]
        elif h.exponent == 0.0:
            kind, rows = PERFECT, [(0.0, y)]
        else:
            kind = POWER
            rows = [(y if h.reference is None else h.reference, y), (h.exponent, 0.0)]
        return np.array([self.bulk, self.shear, float(kind)]), np.array(rows)

    def flow_stress(self, strain: Floats) -> Floats:
        """Flow stress at plastic strains [E]."""
        h, y = self.hardening, self.yield_stress
        if h.table is not None:
            strains, stresses = np.array(h.table).T
            return np.asarray(y * np.interp(strain, strains, stresses))
        reference = y if h.reference is None else h.reference
        return np.asarray(y * (1.0 + strain / reference) ** h.exponent)
