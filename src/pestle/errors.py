"""Every error a user can see: what is wrong, where, and what to do.

``str(error)`` is the text that the command line prints::

    error[yield-above-modulus]: yield_stress 9 GPa of "MCC" exceeds youngs_modulus 5 GPa
      --> case.toml:12  materials.MCC.yield_stress
      hint: a yield stress is usually 0.1-5 % of the modulus; did you mean "9 MPa"?
"""

from collections.abc import Iterable
from typing import ClassVar


class PestleError(Exception):
    """An error with an explanation; the base class of all of them.

    Parameters
    ----------
    id : str
        Stable name in kebab-case, documented on one page.
    what : str
        What is wrong, with the actual value.
    where : str, optional
        File, line, key, step or particles.
    hint : str, optional
        What to change.
    """

    exit_code: ClassVar[int] = 1

    def __init__(
        self, id: str, what: str, where: str | None = None, hint: str | None = None
    ) -> None:
        super().__init__(id, what, where, hint)
        self.id = id
        self.what = what
        self.where = where
        self.hint = hint
        self.others: tuple[PestleError, ...] = ()
        """Further errors found in the same input."""

    def __str__(self) -> str:
        lines = [f"error[{self.id}]: {self.what}"]
        if self.where:
            lines.append(f"  --> {self.where}")
        if self.hint:
            lines.append(f"  hint: {self.hint}")
        return "\n".join([*lines, *(str(other) for other in self.others)])


class InputError(PestleError):
    """A case file, option or result file cannot be used as it is."""

    exit_code: ClassVar[int] = 2


class SimulationError(PestleError):
    """A run had to stop before its end."""

    exit_code: ClassVar[int] = 1


class EnergyWarning(UserWarning):
    """A rule was chosen that is known to create energy."""


def nearest(name: str, options: Iterable[str]) -> str | None:
    """Return the option that looks most like `name`, if any does.

    Examples
    --------
    >>> nearest("youngs_modul", ["poisson_ratio", "youngs_modulus"])
    'youngs_modulus'
    >>> nearest("colour", ["radius", "height"]) is None
    True
    """
    from difflib import get_close_matches

    by_lower = {option.lower(): option for option in options}
    found = get_close_matches(name.lower(), by_lower, n=1, cutoff=0.6)
    return by_lower[found[0]] if found else None


def did_you_mean(name: str, options: Iterable[str]) -> str:
    """Hint for an unknown name: the nearest option, else the list of all.

    Examples
    --------
    >>> did_you_mean("herz", ["hertz", "zunker2024"])
    'did you mean "hertz"?'
    >>> did_you_mean("x", ["hertz", "zunker2024"])
    'known: hertz, zunker2024'
    """
    known = sorted(options)
    match = nearest(name, known)
    if match:
        return f'did you mean "{match}"?'
    return "known: " + ", ".join(known) if known else "nothing is known here"
