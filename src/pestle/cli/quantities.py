"""Numbers with units, and KEY=VALUE, as options of the command line."""

from pestle.errors import InputError


def quantity(text: str, unit: str, where: str) -> float:
    """Number with a unit as a float in `unit`; a plain number is in it already.

    Units that no dimension has a name for, such as N/m, are plain numbers.
    """
    from pestle.units import DIMENSIONS, to_si

    try:
        return to_si(_number(text), unit if unit in DIMENSIONS else "1")
    except InputError as error:
        raise InputError(error.id, error.what, where, error.hint) from None


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def pair(text: str, where: str) -> tuple[str, str]:
    """Key and value of a setting.

    Examples
    --------
    >>> pair("yield_stress = 20 MPa", "--set")
    ('yield_stress', '20 MPa')
    """
    key, equals, value = text.partition("=")
    if not equals:
        raise InputError(
            "bad-setting",
            f"{text!r} is no KEY=VALUE",
            where,
            'such as "poisson_ratio=0.3"',
        )
    return key.strip(), value.strip()
