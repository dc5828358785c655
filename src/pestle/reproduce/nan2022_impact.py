"""Nan, Goh and Rahman (2022), section 4 and 5: critical velocities and CY."""

from math import pi

import numpy as np

from pestle.laws import Pair, Solid
from pestle.reference import nan2022 as theory
from pestle.reference import nan2022_energy as energy
from pestle.reference import nan2022_impact as impacts
from pestle.reproduce.item import LIMIT, POINTS, Line, Panel, Result
from pestle.reproduce.nan2022 import NAN2022

PARTICLE = Solid(youngs_modulus=1.2e9, poisson_ratio=0.33, density=1350.0)
WALL = Solid(youngs_modulus=166e9, poisson_ratio=0.28)
ADHESION = 0.24
MODULUS = Pair(first=PARTICLE, second=WALL).modulus
RADII = (3.445e-6, 2.45e-6, 1.72e-6, 1.29e-6)
MEASURED = (1.18, 1.96, 3.25, 4.63)
"""Wall and others (1990), as Table 6 quotes them [m/s]."""

TABLE_6 = {
    "V_s": (0.49, 0.66, 0.88, 1.12),
    "V_ys, 25 MPa": (1.51, 2.25, 3.40, 4.76),
    "V_ys, 30 MPa": (1.24, 1.86, 2.83, 3.96),
    "V_ys, 30 MPa, e_0 = 0.81": (1.38, 2.08, 3.16, 4.43),
}


def contact(radius: float, pressure: float) -> theory.Contact:
    """Particle and wall of Table 5 with k_p = k_el of (52)."""
    elastic = energy.elastic_stiffness(pressure, radius)
    ratio = theory.stiffness_ratio(MODULUS, radius, ADHESION, elastic)
    return theory.contact(MODULUS, radius, ADHESION, pressure, elastic, elastic, ratio)


def mass(radius: float) -> float:
    """Mass of the particle [kg]."""
    return 4.0 / 3.0 * pi * radius**3 * PARTICLE.density


@NAN2022.item("figure-9", "Critical velocities against yield pressure")
def figure_9() -> Result:
    """V_ys, V_y0 and V_y over V_s, R = 2.45 um."""
    radius = 2.45e-6
    pressures = np.linspace(20e6, 90e6, 141)
    found = [energy.velocities(contact(radius, p), mass(radius)) for p in pressures]
    x, unit = pressures / 1e6, [v.sticking for v in found]
    rows = {
        r"$V_{ys}/V_s$": [v.plastic_sticking for v in found],
        r"$V_{y0}/V_s$": [v.plain_yield for v in found],
        r"$V_y/V_s$": [
            np.sqrt(v.yield_squared) if v.yield_squared > 0 else np.nan for v in found
        ],
    }
    lines = [
        Line(x, np.array(y) / np.array(unit), label, "ours", n)
        for n, (label, y) in enumerate(rows.items())
    ]
    jump = energy.critical_pressure(MODULUS, radius, ADHESION)
    stick = energy.critical_pressure_sticking(MODULUS, radius, ADHESION)
    for n, (p, label) in enumerate(
        ((jump, r"$f_y = f_0$ (80)"), (stick, r"$V_y = V_s$ (77)"))
    ):
        lines.append(Line([p / 1e6] * 2, [0.0, 3.0], label, LIMIT, n + 1))
    panel = Panel(r"$p_y$ [MPa]", "velocity over $V_s$ [-]", lines, ylim=(0.0, 4.5))
    said = (
        f"V_s is {unit[0]:.3f} m/s (printed: 0.66). Jumping in yields below "
        f"{jump / 1e6:.1f} MPa, and V_y reaches V_s at {stick / 1e6:.1f} MPa; the "
        "paper marks both without numbers."
    )
    return Result(said, [panel], across=1)


@NAN2022.item("figure-10", "Critical velocity against size")
def figure_10() -> Result:
    """V_ys for both yield pressures, with the numbers of Table 6."""
    radii = np.geomspace(1.1e-6, 4e-6, 60)
    lines = []
    for n, pressure in enumerate((25e6, 30e6)):
        v = [
            energy.velocities(
                contact(float(r), pressure), mass(float(r))
            ).plastic_sticking
            for r in radii
        ]
        lines.append(
            Line(radii * 1e6, v, rf"$p_y$ = {pressure / 1e6:g} MPa", "ours", n)
        )
    damped = [
        impacts.critical_velocity(
            contact(float(r), 30e6), mass(float(r)), restitution=0.81
        )
        for r in radii[::6]
    ]
    lines.append(Line(radii[::6] * 1e6, damped, r"30 MPa, $e_0$ = 0.81", "ours", 2))
    plain = [
        energy.velocities(contact(float(r), 30e6), mass(float(r))).sticking
        for r in radii
    ]
    lines.append(Line(radii * 1e6, plain, r"JKR, $V_s$", LIMIT, 3))
    points = np.array(RADII) * 1e6
    lines.append(Line(points, MEASURED, "Wall and others, Table 6", POINTS, 5))
    panel = Panel(r"$R$ [µm]", r"$V_{ys}$ [m/s]", lines)
    said = "The numbers are in Table 6; the measured points are those that it quotes."
    return Result(said, [panel], across=1)


@NAN2022.item("table-6", "Critical sticking velocities")
def table_6() -> Result:
    """All three rows of the law, and V_s."""
    rows: dict[str, list[float]] = {name: [] for name in TABLE_6}
    for radius in RADII:
        soft, hard = (
            energy.velocities(contact(radius, p), mass(radius)) for p in (25e6, 30e6)
        )
        damped = impacts.critical_velocity(
            contact(radius, 30e6), mass(radius), restitution=0.81
        )
        values = (hard.sticking, soft.plastic_sticking, hard.plastic_sticking, damped)
        for name, value in zip(rows, values, strict=True):
            rows[name].append(value)
    columns: dict[str, list[object]] = {
        "velocity [m/s]": [],
        "radius [um]": [],
        "value [m/s]": [],
        "printed [m/s]": [],
    }
    for name, column_of in rows.items():
        for radius, value, printed in zip(RADII, column_of, TABLE_6[name], strict=True):
            cells = (name, radius * 1e6, value, printed)
            for column, cell in zip(columns.values(), cells, strict=True):
                column.append(cell)
    over = [
        100.0 * (a / b - 1.0)
        for a, b in zip(
            rows["V_ys, 30 MPa, e_0 = 0.81"],
            TABLE_6["V_ys, 30 MPa, e_0 = 0.81"],
            strict=True,
        )
    ]
    errors = [
        100.0 * float(np.mean(np.abs(np.array(TABLE_6[name]) / MEASURED - 1.0)))
        for name in list(TABLE_6)[1:]
    ]
    said = (
        "Without damping every printed digit comes out. With e_0 = 0.81 ours is "
        f"{min(over):.1f} to {max(over):.1f} % above print, whose run stepped in time. "
        "The mean errors against the measurement, from printed digits, are "
        + ", ".join(f"{e:.1f}" for e in errors)
        + " % (printed: 12.5, 9.4, 7.5 %). Both bodies count in E*."
    )
    return Result(said, columns=columns)


@NAN2022.item("table-cy", "Cohesion-yield numbers")
def table_cy() -> Result:
    """Of the rheometer's powders, and the critical ones."""
    solid = Solid(youngs_modulus=63e6, poisson_ratio=0.2)
    modulus = Pair(first=solid, second=solid).modulus
    rows: list[tuple[str, float, object]] = []
    for adhesion, printed in ((3.5e-3, 4.2), (27e-3, 0.5)):
        for size, name in ((0.25e-3, "mean radius"), (0.2533e-3, "volume-mean radius")):
            value = energy.cohesion_yield_number(modulus, 0.5 * size, adhesion, 0.5e6)
            rows.append(
                (f"FT4, Gamma = {adhesion * 1e3:g} mJ/m^2, {name}", value, printed)
            )
    rows.append(
        ("a resting contact yields below (f_y = f_0)", energy.CRITICAL_NUMBER, 1.0)
    )
    radius = 2.45e-6
    pressure = energy.critical_pressure_sticking(MODULUS, radius, ADHESION)
    number = energy.cohesion_yield_number(MODULUS, radius, ADHESION, pressure)
    rows.append(("V_y = V_s", number, ""))
    plain = theory.yield_force_hertz(MODULUS, radius, pressure)
    tension = 1.5 * pi * ADHESION * radius
    rows.append(("f_y0/f_ce over CY", plain / tension / number, 1.1))
    said = (
        "The printed 4.2 and 0.5 of the rheometer come out with 0.2 to 0.3 mm read as "
        "the radius: 4.15 and 0.54 with its mean. The printed limit CY < 1 is nominal: "
        f"a resting contact yields below {energy.CRITICAL_NUMBER:.3f}."
    )
    columns: dict[str, list[object]] = {
        "number": [row[0] for row in rows],
        "CY": [row[1] for row in rows],
        "printed": [row[2] for row in rows],
    }
    return Result(said, columns=columns)
