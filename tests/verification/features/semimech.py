"""Features of semimech.json: similarity and hardening here, Shahin's laws beside."""

from math import pi

from pestle.particle import biwa1995, hardening
from verification.features import Features
from verification.features._semimech_hardening import register_hardening
from verification.features._semimech_plastic import register_plastic

FEATURES = Features(atol=1e-12)
register_plastic(FEATURES)
register_hardening(FEATURES)


@FEATURES.register("similarity_law")
def similarity_law(i):
    h, pair = i["h"], biwa1995.two(i["R1"], i["R2"])
    a = float(biwa1995.contact_radius(i["gamma"], pair, h))
    eta = biwa1995.force_factor(h, i["kappa1"], i["kappa2"], pair.a)
    return {
        "a": a,
        "eta_P": eta,
        "P": eta * a ** (2.0 + h),
        "A": pair.a,
        "c2": biwa1995.area_ratio(h),
        "k": biwa1995.pressure_factor(h),
    }


@FEATURES.register("similarity_H")
def similarity_hardness(i):
    return {"H": float(biwa1995.hardness(i["x"], i["h"]))}


@FEATURES.register("curvature_radius")
def curvature_radius(i):
    at = i["gamma"], biwa1995.two(i["R1"], i["R2"]), i["h"]
    return {
        "a_closed_B24": float(biwa1995.contact_radius_closed(*at)),
        "a_series_B25": float(biwa1995.contact_radius_series(*at)),
    }


@FEATURES.register("hollomon_from_ludwik")
def hollomon_from_ludwik(i):
    strains = hardening.strains(i["eps_pl_max"], int(i["N"]))
    given = hardening.Ludwik(i["sigma_y"], i["K"], 1.0 / i["n"], i["E"])
    fit = hardening.hollomon_from_ludwik(given, strains)
    return {"kappa": fit.strength, "h": fit.exponent}


@FEATURES.register("ludwik_from_hollomon")
def ludwik_from_hollomon(i):
    strains = hardening.strains(i["eps_pl_max"], int(i["N"]))
    fit = hardening.ludwik_from_hollomon(
        hardening.Hollomon(i["kappa"], i["h"]),
        strains,
        yield_stress=i["sigma_y"],
        youngs_modulus=i["E"],
    )
    return {"K": fit.strength, "one_over_n": fit.exponent}


def similarity_pressures(x, h, kappa):
    """Contact pressure and force over pi R^2 of the similarity law, equal spheres."""
    pair = biwa1995.two(1.0, 1.0)
    a = float(biwa1995.contact_radius(2.0 * x, pair, h))
    pressure = kappa * float(biwa1995.hardness(x, h))
    eta = biwa1995.force_factor(h, kappa, kappa, pair.a)
    return pressure, eta * a ** (2.0 + h) / pi


@FEATURES.register("mcc_SC", "mcc_DC", "mcc_HC")
def microcrystalline_cellulose(i):
    law = FEATURES.functions["hardening_SC_fp"](i)
    kappa, a = i["kappa_MPa"], law["a_over_R"]
    pressure, force = similarity_pressures(i["x"], i["h"], kappa)
    return {
        "a_over_R": a,
        "H": law["H"],
        "p_contact_MPa": kappa * law["H"],
        "P_over_piR2_MPa": kappa * law["H"] * a**2,
        "similarity_p_MPa": pressure,
        "similarity_P_over_piR2_MPa": force,
    }
