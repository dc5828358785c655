"""What no single section can see: contradictions between sections."""

from typing import TYPE_CHECKING, Any

from pestle.config.base import problem
from pestle.config.contacts import ADHESION_ALIASES
from pestle.errors import did_you_mean

if TYPE_CHECKING:
    from pestle.config.case import Case

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
    powder = _material(case, case.particles.material, ("particles", "material"))
    if powder.rigid:
        raise problem(
            "contradiction",
            f'the particles are of the rigid material "{case.particles.material}"',
            "rigid is for walls",
            ("particles", "material"),
        )
    if case.die:
        _material(case, case.die.material, ("die", "material"))
    for name, wall in case.walls.items():
        _material(case, wall.material, ("walls", name, "material"))
    for number, pair in enumerate(case.contacts.pairs):
        for place, name in enumerate(pair.between):
            _material(case, name, ("contacts", "pairs", number, "between", place))
    needed = list(getattr(case.law.build(), "requires", ()))
    if case.particles.count is not None:
        needed.append("density")
    for key in needed:
        if getattr(powder, key, None) is None:
            why = "generated particles" if key == "density" else f"law {case.law.name}"
            raise problem(
                "missing-key",
                f'{key} of material "{case.particles.material}" is missing',
                f"needed by {why}",
                ("materials", case.particles.material, key),
            )


def _material(case: "Case", name: str, key: tuple[str | int, ...]) -> Any:
    if name not in case.materials:
        what = f'there is no material "{name}"'
        hint = did_you_mean(name, case.materials)
        raise problem("unknown-material", what, hint, key)
    return case.materials[name]


def _check_particles(case: "Case") -> None:
    particles = case.particles
    if particles.count is None or particles.radius is None:
        return
    where = ("particles", "count")
    if case.die is None and case.box is None:
        raise problem(
            "nowhere-to-put",
            "generated particles need a [die] to fall into or a [box] to lie in",
            "add [die], or read the particles with file",
            where,
        )
    volume = case.die.volume if case.die else case.box.volume if case.box else 0.0
    radius = particles.radius
    cubed = radius.mean**3 + 3.0 * radius.mean * radius.deviation**2
    fraction = particles.count * 4.18879 * cubed / volume
    if fraction > DENSEST_FILL:
        place = "die" if case.die else "box"
        raise problem(
            "overfull",
            f"{particles.count} particles of mean radius {radius.mean:g} m fill "
            f"{100 * fraction:.3g} % of the {place}; {100 * DENSEST_FILL:.0f} % is "
            "the most that fits before pressing",
            f"make the {place} larger or count smaller",
            where,
        )


def fill_contacts(data: Any) -> Any:
    """Take contact properties of the powder's material set where the case has none."""
    try:
        powder = data["particles"]["material"]
        name = data["materials"][powder]["set"]
        walls = [other for other in data["materials"] if other != powder]
        contacts = dict(data.get("contacts") or {})
        pairs = [dict(pair) for pair in contacts.get("pairs", ())]
    except (TypeError, KeyError, ValueError, AttributeError):
        return data  # the sections themselves report what is wrong
    from pestle.errors import InputError
    from pestle.materials import load

    try:
        material = load(name)
    except InputError:
        return data
    given = _canonical_names(contacts)
    for wall in walls:
        _fill_wall(pairs, (powder, wall), material.wall_contacts, given)
    for key, value in material.contacts.items():
        if key not in given:
            contacts[key] = value
    if pairs:
        contacts["pairs"] = pairs
    return {**data, "contacts": contacts}


def _fill_wall(
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
