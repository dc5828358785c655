"""Features of edmans.json: unloading laws of a single particle."""

from pestle.particle import (
    cylinders2020,
    edmans2020,
    etsion2005,
    linear_unloading,
    mesarovic2000,
)
from verification.features import Features

FEATURES = Features(atol=1e-12)


@FEATURES.register("delta_c")
def first_yield(i):
    return {"delta_c": edmans2020.first_yield(i["E"], i["nu"])}


@FEATURES.register("phi")
def yielded_fraction(i):
    return {"phi": float(edmans2020.yielded_fraction(i["d_max"], i["d_c"]))}


@FEATURES.register("rho")
def secant_stiffness(i):
    largest = i["d_max"]
    rho = float(edmans2020.secant_stiffness(largest, i["E"], i["nu"]))
    return {
        "rho": rho,
        "delta_0": largest - 1.0 / rho,
        "k2_over_k1": rho * largest,
        "yielded": largest > edmans2020.first_yield(i["E"], i["nu"]),
    }


@FEATURES.register("F_unload")
def unloading(i):
    at = i["d_max"], i["E"], i["nu"]
    alpha = i.get("alpha")
    law = edmans2020.Unloading(
        float(edmans2020.secant_stiffness(*at)),
        float(edmans2020.exponent(*at)) if alpha is None else alpha,
    )
    state = i["d"], i["d_max"], i["F_max"], law
    return {
        "F": float(edmans2020.force(*state)),
        "dF_dd": float(edmans2020.stiffness(*state)),
        "work": edmans2020.work(i["F_max"], law),
    }


@FEATURES.register("alpha_option")
def exponent(i):
    d_c = edmans2020.first_yield(i["E"], i["nu"])
    return {
        "alpha_etsion_eq6": etsion2005.exponent(i["d_max"], d_c),
        "alpha_option_A1": float(edmans2020.exponent(i["d_max"], i["E"], i["nu"])),
    }


@FEATURES.register("rho_etsion")
def rho_etsion(i):
    d_c = edmans2020.first_yield(i["E"], i["nu"])
    return {"rho": float(etsion2005.secant_stiffness(i["d_max"], d_c))}


@FEATURES.register("luding_k2")
def luding(i):
    k2 = linear_unloading.luding_stiffness(
        i["k1"], i["k2max"], i["d_max"], i["d_cstar"]
    )
    return {"k2": float(k2)}


@FEATURES.register("mesarovic_johnson")
def mesarovic_johnson(i):
    return {"F_ratio": float(mesarovic2000.force_ratio(i["a_hat"]))}


@FEATURES.register("cyl_geometry_load")
def cylinders(i):
    d, e = i["d"], i["E"]
    return {
        "r_m": float(cylinders2020.outer_radius(d)),
        "r_p": float(cylinders2020.plastic_radius(d, e)),
        "F": float(cylinders2020.loading_force(d, e)),
    }


@FEATURES.register("cyl_strain")
def strains(i):
    core = cylinders2020.core_strain(i["r"], i["d"], i["d_max"], i["E"])
    return {
        "eps_elastic_12": float(cylinders2020.elastic_strain(i["r"], i["d"])),
        "eps_core_18": float(core),
    }


@FEATURES.register(
    "cyl_F_unload_published", "cyl_F_unload_consistent", "cyl_F_unload_no_tension"
)
def cylinders_unload(i):
    force = cylinders2020.unloading_force(i["d"], i["d_max"], i["E"], i["variant"])
    return {"F": float(force)}


@FEATURES.register("cyl_rho_published", "cyl_rho_consistent", "cyl_rho_no_tension")
def cylinders_rho(i):
    rho = float(cylinders2020.secant_stiffness(i["d_max"], i["E"], i["variant"]))
    return {"rho": rho, "delta_0": i["d_max"] - 1.0 / rho}
