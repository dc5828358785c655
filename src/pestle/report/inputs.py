"""What went into the run, as rows of a table."""

from dataclasses import dataclass
from itertools import combinations_with_replacement, product
from typing import TYPE_CHECKING

from pestle.report.numbers import with_unit

if TYPE_CHECKING:
    from pestle.config import Case, ParticleSettings

Rows = list[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Inputs:
    """Rows (name, value) under a heading."""

    heading: str
    rows: Rows


def input_tables(case: "Case") -> list[Inputs]:
    """Tables of the inputs, in the order that a reader asks for them."""
    tables = [
        Inputs(f"Material “{name}”", rows) for name, rows in _materials(case) if rows
    ]
    tables += _contacts(case)
    tables += _particles(case)
    if case.die is not None:
        tables.append(Inputs("Die", _die(case)))
    tables += [Inputs("Contact law", _law(case)), Inputs("Engine", _engine(case))]
    return tables


def _materials(case: "Case") -> list[tuple[str, Rows]]:
    found = []
    for name, material in case.materials.items():
        rows: Rows = []
        if material.set:
            rows.append(("material set", material.set))
        if material.rigid:
            rows.append(("deforms", "no: rigid tool"))
        for label, value, unit in (
            ("Young’s modulus E", material.youngs_modulus, "Pa"),
            ("Poisson ratio ν", material.poisson_ratio, "-"),
            ("yield stress Y", material.yield_stress, "Pa"),
            ("true density", material.density, "kg/m³"),
        ):
            if value is not None:
                rows.append((label, with_unit(value, unit)))
        found.append((name, rows))
    return found


def _contacts(case: "Case") -> list[Inputs]:
    powders = case.powders
    walls = sorted({w.material for w in case.all_walls.values()} - set(powders))
    couples = [*combinations_with_replacement(powders, 2), *product(powders, walls)]
    tables = []
    for powder, partner in couples:
        pair = case.pair(powder, partner)
        rows: Rows = [
            ("sliding friction µ", with_unit(pair.sliding_friction, "-")),
            ("rolling friction", with_unit(pair.rolling_friction, "-")),
            ("work of adhesion W", with_unit(pair.work_of_adhesion, "J/m²")),
        ]
        if pair.restitution is not None:
            rows.append(("restitution", with_unit(pair.restitution, "-")))
        if pair.damping_ratio is not None:
            rows.append(("damping ratio", with_unit(pair.damping_ratio, "-")))
        tables.append(Inputs(f"Contacts {powder} – {partner}", rows))
    return tables


def _particles(case: "Case") -> list[Inputs]:
    if len(case.particles) == 1:
        rows = [*_powder(case, case.particles[0]), ("seed", str(case.seed))]
        return [Inputs("Particles", rows)]
    tables = [
        Inputs(f"Particles of “{powder.material}”", _powder(case, powder))
        for powder in case.particles
    ]
    return [*tables, Inputs("Particles together", [("seed", str(case.seed))])]


def _powder(case: "Case", particles: "ParticleSettings") -> Rows:
    material = particles.material or ", ".join(case.powders)
    rows: Rows = [("material", material)]
    if particles.count is not None:
        rows.append(("count", f"{particles.count:,}"))
    if particles.mass is not None:
        rows.append(("mass", with_unit(particles.mass, "kg")))
    if particles.radius is not None:
        radius = particles.radius
        rows.append(("mean radius", with_unit(radius.mean, "m")))
        if radius.distribution != "single":
            spread = (
                f"{with_unit(radius.minimum, 'm')} – {with_unit(radius.maximum, 'm')}"
            )
            rows.append(("distribution of radii", radius.distribution))
            rows.append(("deviation", with_unit(radius.deviation, "m")))
            rows.append(("smallest – largest", spread))
    if particles.file:
        rows.append(("read from", particles.file.rpartition("/")[2]))
    if particles.start_from:
        rows.append(("continued from", particles.start_from.rpartition("/")[2]))
    return rows


def _die(case: "Case") -> Rows:
    assert case.die is not None
    return [
        ("diameter", with_unit(2.0 * case.die.radius, "m")),
        ("height", with_unit(case.die.height, "m")),
        ("material", case.die.material),
    ]


def _law(case: "Case") -> Rows:
    rows: Rows = [("name", case.law.name)]
    for name, value in case.law.options.items():
        text = with_unit(value, "-") if isinstance(value, float) else str(value)
        rows.append((name, text))
    return rows


def _engine(case: "Case") -> Rows:
    engine = case.engine
    if engine.time_step == "auto":
        step = f"automatic, {with_unit(engine.safety, '-')} of the critical one"
    else:
        step = with_unit(float(engine.time_step), "s")
    gravity = ", ".join(with_unit(g, "-") for g in engine.gravity)
    rows: Rows = [("time step", step), ("gravity", f"({gravity}) m/s²")]
    if engine.mass_scaling != 1.0:
        rows.append(("mass scaling", with_unit(engine.mass_scaling, "-")))
    if case.contacts.sliding_rule != "spring":
        rows.append(("sliding rule", case.contacts.sliding_rule))
    return rows
