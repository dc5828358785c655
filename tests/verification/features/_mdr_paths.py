"""Paths of one particle between flats: the features that the exact solver computes."""

import warnings

from pestle.particle import (
    EnergyWarning,
    Particle,
    ParticleMaterial,
    Resolution,
    follow,
    pull_off,
)
from pestle.particle.pull_off import indenter
from pestle.reference import elasticity, mdr, peeling, validity

# The reference paths step by 0.002 radii and resolve events to 1e-10 radii, the return
# to the running maximum less.  Where an unloaded contact is loaded again this leaves up
# to 1e-8 of the largest force in them, so that their tolerance of 1e-9 needs the same
# resolution.  tests/particle compares the limit.
RESOLUTION = Resolution(step=0.002, event=1e-10, maximum=1e-7)

PATHS = (
    "uniaxial",
    "uniaxial_plastic",
    "uniaxial_loading",
    "uniaxial_eq37",
    "uniaxial_frozen",
    "uniaxial_SI",
    "uniaxial_adhesive",
    "volume",
    "hydrostatic",
    "die",
    "asymmetric",
    "adhesive_path",
    "adhesive_elastic",
)


def register_paths(features):
    """Add the features of this module to a file's."""
    features.register(*PATHS)(path)
    features.register("pull_off")(pull_off_curve)
    features.register("phase")(phase)


def material(i):
    """Material of a case."""
    return ParticleMaterial(
        youngs_modulus=i["E"],
        poisson_ratio=i["nu"],
        yield_stress=i["Y"],
        work_of_adhesion=i.get("dgamma", 0.0) if i.get("adhesion", True) else 0.0,
    )


def particle(i, counts):
    """Particle of a case, in the radius mode of the case."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", EnergyWarning)
        return Particle(
            material(i),
            i.get("Ro", 1.0),
            counts=counts,
            radius_rule=i.get("radius_mode", "plastic"),
            resolution=RESOLUTION,
        )


def columns(flats):
    """History of one flat as the reference files write it."""
    return {
        "F": [f.force for f in flats],
        "a": [f.contact_radius for f in flats],
        "A_C": [f.area for f in flats],
        "pmean": [f.pressure for f in flats],
        "delta": [f.overlap for f in flats],
        "delta_max": [f.largest for f in flats],
        "de": [f.penetration for f in flats],
        "yielded": [f.yielded for f in flats],
        "case": [int(f.peel) for f in flats],
    }


def path(i):
    """Follow the path of a case: waypoints, primary and secondary, or all alike."""
    if "waypoints" in i:
        names, counts, goals = _waypoints(i)
    elif "delta_o_primary" in i:
        names, counts, goals = _die(i)
    else:
        names, counts = ["flat"], (i["N"],)
        goals = [(d,) for d in i["delta_o"]]
    states = follow(particle(i, counts), goals)
    if "waypoints" not in i and len(names) == 2 and goals[0] == (0.0, goals[0][1]):
        states = states[1:]
    out = {
        "R": [s.radius for s in states],
        "V_over_Vo": [s.volume_ratio for s in states],
    }
    for n, name in enumerate(names):
        out[name] = columns([s.flats[n] for s in states])
    return out


def _waypoints(i):
    """Flats in pairs x, y, z; flat by flat if a pair does not move alike."""
    points = i["waypoints"]
    n = len(points[0])
    start = 1 if not any(points[0]) else 0
    paired = n % 2 == 0 and all(p[0::2] == p[1::2] for p in points)
    if paired:
        names, counts = ["x", "y", "z"][: n // 2], (2,) * (n // 2)
        goals = [p[0::2] for p in points[start:]]
    else:
        names, counts = [f"flat{k}" for k in range(n)], (1,) * n
        goals = points[start:]
    return names, counts, goals


def _die(i):
    """Two moving flats, the others resting, at another place or on a path."""
    primary = i["delta_o_primary"]
    secondary = i.get("delta_o_secondary", 0.0)
    if not isinstance(secondary, list):
        resting = [(0.0, secondary)] if secondary else []
        secondary = [secondary] * len(primary)
    else:
        resting = []
    goals = resting + list(zip(primary, secondary, strict=True))
    return ["primary", "secondary"], (2, i["N"] - 2), goals


def pull_off_curve(i):
    """Pull-off after uniaxial loading to several displacements."""
    names = {
        "F_c": "force",
        "F_sep": "force_separation",
        "a_at_F_c": "radius",
        "a_sep": "radius_separation",
        "do_at_F_c": "displacement",
        "do_sep": "displacement_separation",
    }
    out = {name: [] for name in (*names, "a_load", "yielded")}
    loaded = particle(i, (i.get("N", 2),))
    for goal in i["delta_o_max"]:
        flat = loaded.move((goal,)).flats[0]
        found = pull_off(loaded)
        for name, field in names.items():
            out[name].append(getattr(found, field))
        out["a_load"].append(flat.contact_radius)
        out["yielded"].append(flat.yielded)
    return out


def phase(i):
    """Whether the adhesive contact can be trusted, for Ro = W = 1."""
    es, y, nu = i["EsRo_over_dgamma"], i["YRo_over_dgamma"], i["nu"]
    goal = i["delta_o_max_over_Ro"]
    case = {
        "E": es * (1 - nu**2),
        "nu": nu,
        "Y": y,
        "dgamma": 1.0,
        "radius_mode": i.get("radius_mode", "plastic"),
    }
    loaded = particle(case, (i.get("N", 2),))
    state = loaded.move((goal,))
    shape = indenter(loaded)
    es = elasticity.plane_strain_modulus(case["E"], nu)
    delta_y = mdr.yield_overlap(1.0, modulus=es, yield_stress=y)
    a_c = peeling.critical_radius(shape, modulus=es, work_of_adhesion=1.0)
    peak = validity.peak_radius(goal, 1.0, yield_overlap=delta_y)
    zone = validity.plastic_zone(modulus=es, work_of_adhesion=1.0, yield_stress=y)
    why = validity.reason(a_c, peak, zone)
    return {
        "a_c": a_c,
        "r_peak": peak,
        "r_Ip": zone,
        "a_c_over_r_peak": a_c / peak if peak > 0.0 else None,
        "two_a_c_over_r_Ip": 2 * a_c / zone,
        "delta_Y": delta_y,
        "yielded": state.flats[0].yielded,
        "A": shape.height,
        "B": shape.width,
        "R": state.radius,
        "valid": why == "ok",
        "reason": why,
    }
