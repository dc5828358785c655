"""What no single section can see: contradictions between sections."""

from typing import TYPE_CHECKING, Any

from pestle.config.base import problem
from pestle.config.contacts import ADHESION_ALIASES
from pestle.errors import did_you_mean

if TYPE_CHECKING:
    from pestle.config.case import Case

MOST_PARTICLES = 10**8
"""Largest number of particles in one case [-]."""

DENSEST_FILL = 0.64
"""Random close packing of spheres [-]: no more fits between the punches."""


def check_case(case: "Case") -> None:
    """Run all checks between sections."""
    from pestle.config.checks_geometry import check_geometry
    from pestle.config.checks_process import check_process

    _check_materials(case)
    check_geometry(case)
    _check_particles(case)
    check_process(case)


def _check_materials(case: "Case") -> None:
    for number, group in enumerate(case.particles):
        if group.material is not None:
            check_powder(case, group.material, group_key(case, number, "material"))
    if case.die:
        _material(case, case.die.material, ("die", "material"))
    for name, wall in case.walls.items():
        _material(case, wall.material, ("walls", name, "material"))
    for number, pair in enumerate(case.contacts.pairs):
        for place, name in enumerate(pair.between):
            _material(case, name, ("contacts", "pairs", number, "between", place))


def check_powder(case: "Case", name: str, key: tuple[str | int, ...]) -> None:
    """Refuse a material that particles cannot have; `key` says where it is named."""
    powder = _material(case, name, key)
    if powder.rigid:
        raise problem(
            "contradiction",
            f'the particles are of the rigid material "{name}"',
            "rigid is for walls",
            key,
        )
    needed = list(getattr(case.law.build(), "requires", ()))
    if case.is_generated:
        needed.append("density")
    for constant in needed:
        if getattr(powder, constant, None) is None:
            why = f"the law {case.law.name} needs it"
            if constant == "density":
                why = "generated particles need it"
            raise problem(
                "missing-key",
                f'{constant} of material "{name}" is missing',
                f"{why}: add {constant} to [materials.{name}]",
                ("materials", name, constant) if key else (),
            )


def group_key(case: "Case", number: int, *rest: str) -> tuple[str | int, ...]:
    """Path of a key of a powder; a single powder is a table of its own."""
    several = (number,) if len(case.particles) > 1 else ()
    return ("particles", *several, *rest)


def _material(case: "Case", name: str, key: tuple[str | int, ...]) -> Any:
    if name not in case.materials:
        what = f'there is no material "{name}"'
        hint = did_you_mean(name, case.materials)
        raise problem("unknown-material", what, hint, key)
    return case.materials[name]


def _check_particles(case: "Case") -> None:
    if not case.is_generated:
        _check_one_source(case)
        return
    total = sum(case.generated)
    where = group_key(case, len(case.particles) - 1, "count")
    if total > MOST_PARTICLES:
        what = f"{total} particles are more than {MOST_PARTICLES:.10g}"
        raise problem("out-of-range", what, "make count smaller", where)
    if case.die is None and case.box is None:
        raise problem(
            "nowhere-to-put",
            "generated particles need a [die] to fall into or a [box] to lie in",
            "add [die], or read the particles with file",
            where,
        )
    volume = case.die.volume if case.die else case.box.volume if case.box else 0.0
    solid = sum(
        number * 4.18879 * group.radius.mean_cube
        for number, group in zip(case.generated, case.particles, strict=True)
        if group.radius
    )
    fraction = solid / volume
    if fraction > DENSEST_FILL:
        place = "die" if case.die else "box"
        means = ", ".join(f"{g.radius.mean:g} m" for g in case.particles if g.radius)
        raise problem(
            "overfull",
            f"{total} particles of mean radius {means} fill "
            f"{100 * fraction:.3g} % of the {place}; {100 * DENSEST_FILL:.0f} % is "
            "the most that fits before pressing",
            f"make the {place} larger or count smaller",
            where,
        )


def _check_one_source(case: "Case") -> None:
    """Particles that are read come from one place and are not mixed with others."""
    for number, group in enumerate(case.particles):
        if not group.is_generated and len(case.particles) > 1:
            key = "start_from" if group.file is None else "file"
            raise problem(
                "contradiction",
                f"{key} is given beside other powders",
                "particles are all generated, or all read from one place: a file names "
                "each particle's powder in a column material",
                group_key(case, number, key),
            )


def fill_contacts(data: Any) -> Any:
    """Take contact properties of the powders' material sets where the case has none.

    What a set says of its particles is the default of a case with one powder; of
    several, each brings its own to the contacts of its like.
    """
    try:
        powders = _powders_in(data["particles"])
        sets = {p: data["materials"][p]["set"] for p in powders if p in _with_set(data)}
        walls = [name for name in data["materials"] if name not in powders]
        contacts = dict(data.get("contacts") or {})
        pairs = [dict(pair) for pair in contacts.get("pairs", ())]
    except (TypeError, KeyError, ValueError, AttributeError):
        return data  # the sections themselves report what is wrong
    if not sets:
        return data
    from pestle.errors import InputError
    from pestle.materials import load

    given = _canonical_names(contacts)
    for powder, name in sets.items():
        try:
            material = load(name)
        except InputError:
            return data
        for wall in walls:
            _fill_pair(pairs, (powder, wall), material.wall_contacts, given)
        if len(powders) > 1:
            _fill_pair(pairs, (powder, powder), material.contacts, given)
            continue
        for key, value in material.contacts.items():
            if key not in given:
                contacts[key] = value
    if pairs:
        contacts["pairs"] = pairs
    return {**data, "contacts": contacts}


def _powders_in(particles: Any) -> list[str]:
    groups = [particles] if isinstance(particles, dict) else particles
    return list(dict.fromkeys(group["material"] for group in groups))


def _with_set(data: Any) -> set[str]:
    return {name for name, m in data["materials"].items() if "set" in m}


def _fill_pair(
    pairs: list[dict[str, Any]],
    names: tuple[str, str],
    values: dict[str, float],
    given: set[str],
) -> None:
    own: dict[str, Any] = {}
    for pair in pairs:
        between = pair.get("between")
        if isinstance(between, list | tuple) and set(map(str, between)) == set(names):
            own = pair
    known = given | _canonical_names(own)
    new = {key: value for key, value in values.items() if key not in known}
    if new and own:
        own.update(new)
    elif new:
        pairs.append({"between": list(names), **new})


def _canonical_names(section: dict[str, Any]) -> set[str]:
    names = set(section)
    if names & set(ADHESION_ALIASES):
        names.add("work_of_adhesion")
    return names
