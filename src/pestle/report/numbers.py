"""Numbers for people: SI values in units that suit their size."""

import math

from pestle.metrics import Metric

_SCALES: dict[str, tuple[tuple[float, str], ...]] = {
    "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")),
    "m": ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")),
    "N": ((1e6, "MN"), (1e3, "kN"), (1.0, "N"), (1e-3, "mN"), (1e-6, "µN")),
    "J": (
        (1e6, "MJ"),
        (1e3, "kJ"),
        (1.0, "J"),
        (1e-3, "mJ"),
        (1e-6, "µJ"),
        (1e-9, "nJ"),
    ),
    "s": ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns")),
    "kg": ((1.0, "kg"), (1e-3, "g"), (1e-6, "mg"), (1e-9, "µg")),
}

_PERCENT = {
    "axial_spring_back",
    "radial_spring_back",
    "ledger_residual",
    "contact_imbalance",
    "negative_dissipation",
    "tablet_share",
    "work_recovered",
    "contact_area_fraction_pressed",
    "contact_area_fraction_ejected",
}


def quantity(value: float, unit: str, digits: int = 3) -> tuple[str, str]:
    """Text of a number and its unit.

    Examples
    --------
    >>> quantity(1.5e8, "Pa")
    ('150', 'MPa')
    >>> quantity(6.9e-4, "m")
    ('690', 'µm')
    >>> quantity(0.94, "-")
    ('0.940', '')
    """
    if unit in ("-", ""):
        return plain(value, digits), ""
    for scale, name in _SCALES.get(unit, ()):
        if abs(value) >= 0.9995 * scale:
            return plain(value / scale, digits), name
    scales = _SCALES.get(unit)
    if scales and value != 0.0:
        scale, name = scales[-1]
        return plain(value / scale, digits), name
    return plain(value, digits), unit


def plain(value: float, digits: int = 3) -> str:
    """Text of a number with so many significant digits, without exponents.

    Examples
    --------
    >>> plain(1234.5), plain(0.0012345), plain(120, 3), plain(0.0)
    ('1,234', '0.00123', '120', '0')
    >>> plain(1.2e-7)
    '1.20 × 10⁻⁷'
    """
    if not math.isfinite(value):
        return "—"
    if value == 0.0:
        return "0"
    power = math.floor(math.log10(abs(value)))
    if power < -4 or power > 8:
        text = f"{value:.{digits - 1}e}"
        mantissa, _, exponent = text.partition("e")
        return f"{mantissa} × 10{_superscript(int(exponent))}"
    return f"{value:,.{max(digits - 1 - power, 0)}f}"


def _superscript(number: int) -> str:
    return str(number).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def shown(metric: Metric) -> tuple[str, str]:
    """Text and unit of a metric."""
    if metric.key in _PERCENT:
        return plain(100.0 * metric.value, 3 if metric.value >= 0.1 else 2), "%"
    if metric.key == "particles":
        return f"{metric.value:,.0f}", ""
    return quantity(metric.value, metric.unit)


def with_unit(value: float | None, unit: str, digits: int = 4) -> str:
    """Number and unit in one text; a dash if there is none.

    Examples
    --------
    >>> with_unit(1.5e-4, "m"), with_unit(None, "m")
    ('150 µm', '—')
    """
    if value is None:
        return "—"
    text, name = quantity(value, unit, digits)
    if "." in text and "×" not in text:
        text = text.rstrip("0").rstrip(".")
    return f"{text} {name}".strip()


def duration(seconds: float) -> str:
    """Wall time in words.

    Examples
    --------
    >>> duration(0.4), duration(75.0), duration(7300.0)
    ('0.4 s', '1 min 15 s', '2 h 1 min')
    """
    if seconds < 10.0:
        return f"{seconds:.1f} s"
    if seconds < 60.0:
        return f"{seconds:.0f} s"
    minutes = round(seconds) // 60
    if minutes < 60:
        return f"{minutes} min {round(seconds) % 60} s"
    return f"{minutes // 60} h {minutes % 60} min"
