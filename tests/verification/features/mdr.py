"""Features of mdr.json: closed forms here, paths and transforms beside."""

from pestle.reference import (
    elasticity,
    ellipse,
    hertz,
    jkr,
    mdr,
    peeling,
    validity,
    volume,
)
from pestle.reference.ellipse import Ellipse
from verification.features import Features
from verification.features._mdr_paths import register_paths
from verification.features._mdr_transforms import transform

FEATURES = Features(atol=1e-12)
register_paths(FEATURES)
FEATURES.register("mdr_transform")(transform)


@FEATURES.register("moduli")
def moduli(i):
    sides = [(i["E1"], i["nu1"]), (i.get("E2"), i.get("nu2"))]
    out = {}
    plane = [e and elasticity.plane_strain_modulus(e, nu) for e, nu in sides]
    out["Es"] = elasticity.composite_modulus(*plane)
    for n, (e, nu) in enumerate(sides, 1):
        if e is not None:
            out[f"G{n}"] = elasticity.shear_modulus(e, nu)
            out[f"kappa{n}"] = elasticity.bulk_modulus(e, nu)
    return out


@FEATURES.register("hertz")
def hertz_contact(i):
    delta, r, es = i["delta"], i["R"], i["Es"]
    a = hertz.contact_radius(delta, r)
    return {
        "F": hertz.force(delta, r, modulus=es),
        "a": a,
        "p_H": hertz.mean_pressure(delta, r, modulus=es),
        "p_at_half_radius": hertz.pressure(a / 2, delta, r, modulus=es),
    }


@FEATURES.register("p_Y")
def hardening(i):
    value = mdr.hardening_pressure(i["delta_max"], i["R"], yield_stress=i["Y"])
    return {"p_Y": value}


@FEATURES.register("yield")
def first_yield(i):
    es = elasticity.plane_strain_modulus(i["E"], i["nu"])
    y = mdr.yield_point(i["R"], modulus=es, yield_stress=i["Y"])
    return {
        "delta_Y": y.overlap,
        "c_A": y.area_offset,
        "a_at_yield_hertz": y.radius,
        "p_Y_at_yield": y.pressure,
        "F_plastic_side": y.force_plastic,
        "F_elastic_side_ellipse": y.force_elastic,
        "a_elastic_side_ellipse": y.radius_elastic,
    }


@FEATURES.register("ellipse")
def indenter(i):
    shape, es = Ellipse(i["A"], i["B"]), i["Es"]
    return {
        "F": [ellipse.force(shape, d, modulus=es) for d in i["de"]],
        "a": [ellipse.contact_radius(shape, d) for d in i["de"]],
        "F_max": ellipse.largest_force(shape, modulus=es),
        "g_1D": [ellipse.profile(shape, x) for x in i.get("x", [])],
        "dg_1D": [ellipse.slope(shape, x) for x in i.get("x", [])],
    }


@FEATURES.register("plastic_contact")
def plastic_contact(i):
    e, nu = i["E"], i["nu"]
    k = mdr.Constants(
        elasticity.plane_strain_modulus(e, nu),
        elasticity.shear_modulus(e, nu),
        elasticity.bulk_modulus(e, nu),
        nu,
        i["Y"],
    )
    largest = i["delta_max"]
    c = mdr.plastic_contact(largest, i["R"], area_offset=i["c_A"], constants=k)
    depths = [mdr.penetration(d, largest, c) for d in i["delta"]]
    forces = [ellipse.force(c.shape, d, modulus=k.modulus) for d in depths]
    radii = [ellipse.contact_radius(c.shape, d) for d in depths]
    return {
        "p_Y": c.pressure,
        "a_max": c.radius,
        "A": c.shape.height,
        "B": c.shape.width,
        "F_max": c.largest_force,
        "z_R": c.depth,
        "delta_R": c.correction,
        "delta_p": c.plastic_overlap,
        "de": depths,
        "F": forces,
        "a": radii,
        "pmean": [
            f / (3.141592653589793 * a * a) if a > 0.0 else 0.0
            for f, a in zip(forces, radii, strict=True)
        ],
    }


@FEATURES.register("adhesion_closed")
def adhesion_closed(i):
    shape = Ellipse(i["A"], i["B"])
    k = {"modulus": i["Es"], "work_of_adhesion": i["dgamma"]}
    result = peeling.pull_off(shape, i["a_load"], **k)
    return {
        "delta_l_at_a_load": peeling.detachment_length(i["a_load"], **k),
        "a_c_disp": peeling.critical_radius(shape, **k),
        "a_c_force": peeling.critical_radius(shape, **k, control="force"),
        "F_c": result.force,
        "de_at_F_c": result.penetration,
        "a_at_F_c": result.radius,
        "F_sep": result.force_separation,
        "de_sep": result.penetration_separation,
        "a_sep": result.radius_separation,
    }


@FEATURES.register("jkr")
def jkr_sphere(i):
    r = i["R"]
    k = {"modulus": i["Es"], "work_of_adhesion": i["dgamma"]}
    force = jkr.critical_radius(r, **k, control="force")
    moved = jkr.critical_radius(r, **k, control="displacement")
    return {
        "F": [jkr.force(a, r, **k) for a in i.get("a", [])],
        "delta": [jkr.overlap(a, r, **k) for a in i.get("a", [])],
        "F_pull_off_force_control": jkr.pull_off(r, work_of_adhesion=i["dgamma"]),
        "F_at_displacement_limit": jkr.force(moved, r, **k),
        "a_force": force,
        "d_force": jkr.overlap(force, r, **k),
        "a_disp": moved,
        "d_disp": jkr.overlap(moved, r, **k),
    }


@FEATURES.register("adhesion_states")
def adhesion_states(i):
    shape, a = Ellipse(i["A"], i["B"]), i.get("a_start", 0.0)
    k = {"modulus": i["Es"], "work_of_adhesion": i["dgamma"]}
    out = []
    for depth in i["de_sequence"]:
        out.append(peeling.adhere(shape, depth, a, **k))
        a = out[-1].radius
    return {
        "F": [x.force for x in out],
        "a": [x.radius for x in out],
        "case": [int(x.state) for x in out],
    }


@FEATURES.register("radius_step")
def radius_step(i):
    step = volume.radius_step(
        i["R"],
        i["V_n"],
        flats=list(zip(i["delta_o"], i["ddelta_o"], i["F"], strict=True)),
        initial_radius=i["Ro"],
        bulk=i["kappa"],
    )
    return {"V": step.volume, "dVe": step.lost, "dR": max(step.growth, 0.0)}


@FEATURES.register("r_peak")
def r_peak(i):
    value = validity.peak_radius(
        i["delta_o_max"], i.get("Ro", 1.0), yield_overlap=i["delta_Y"]
    )
    fraction = validity.peak_fraction(
        i["delta_o_max"], i.get("Ro", 1.0), yield_overlap=i["delta_Y"]
    )
    return {"r_peak": value, "r_peak_over_a_max": fraction}


@FEATURES.register("r_Ip")
def r_ip(i):
    value = validity.plastic_zone(
        modulus=i["Es"], work_of_adhesion=i["dgamma"], yield_stress=i["Y"]
    )
    return {"r_Ip": value}
