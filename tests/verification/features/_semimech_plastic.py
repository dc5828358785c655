"""Chapter 2 of the thesis: elastic-perfectly plastic spheres."""

from math import pi

import numpy as np

from pestle.particle import shahin2021_hardness as law
from pestle.particle import shahin2021_radius as radius
from pestle.particle import shahin2021_secondary as secondary
from pestle.particle.shahin2021_plastic import density_product, softening
from verification.features import Features
from verification.features._semimech_hardening import CONFIGURATIONS

CONTACTS = {"DC": "die", "HC": "hydrostatic", "DS": "die_secondary"}
LAWS = [f"law_{lc}_{regime}" for lc in CONFIGURATIONS for regime in law.REGIMES]


def register_plastic(features: Features) -> None:
    """Register the features of chapter 2."""
    features.register(*LAWS)(regimes)
    features.register(*(f"law_parameters_{lc}" for lc in CONFIGURATIONS))(parameters)
    for function in (
        material_numbers,
        D_coefficients,
        contact_radius_equal,
        contact_radius_unequal,
        unequal_radii_hardness,
        fp_generic,
        dimensional_force,
        validity_c2,
        density_product_feature,
        secondary_displacement,
        secondary_small,
        secondary_large,
    ):
        features.register(function.__name__.removesuffix("_feature"))(function)


def parameters_of(i):
    return law.parameters(i["lam"], i.get("zeta", 1.0), CONFIGURATIONS[i["LC"]])


def material_numbers(i):
    lam, zeta = law.material_numbers(i["E"], i["nu"], i["sigma_y"])
    return {"lambda": lam, "zeta": zeta}


def D_coefficients(i):
    d = radius.coefficients(i["lam"], CONFIGURATIONS[i["LC"]])
    return {"D1": float(d.d1), "D3": float(d.d3), "D5": float(d.d5)}


def contact_radius_equal(i):
    d = radius.coefficients(i["lam"], CONFIGURATIONS[i["LC"]])
    return {"a_over_R": float(radius.relative_radius(i["x"], d))}


def contact_radius_unequal(i):
    d = radius.coefficients(i["lam"], CONFIGURATIONS[i["LC"]])
    return {"a": float(radius.contact_radius(i["gamma"], i["R1"], i["R2"], d))}


def unequal_radii_hardness(i):
    both = i["R1"] + i["R2"]
    k = law.onset(i["lam"], both**2 / (4.0 * i["R1"] * i["R2"]))
    x = i["gamma"] / both
    plastic = law.parameters(i["lam"], 1.0, "simple").plastic
    branches = [law.elastic(x, k), law.elastic_plastic(min(x, k.at_max), k)]
    branches.append(law.softened(max(x, k.at_max), plastic))
    regime = int(x > k.at_yield) + int(x > k.at_max)
    return {
        "gamma_y": float(k.at_yield * both),
        "gamma_Hmax": float(k.at_max * both),
        "regime": law.REGIMES[regime],
        "H": float(branches[regime][0]),
        "c1": float(k.c1),
        "c2": float(k.c2),
    }


def fp_generic(i):
    soft = softening(i["xM"], i["xmin"], i["q"], i["r"])
    return {"H": float(i["Hm"] - i["p"] * soft.value(i["x"]))}


def parameters(i):
    k = parameters_of(i)
    start, middle, end = k.onset, k.plastic, k.compaction
    out = {
        "Hmax": start.hardness_max,
        "x_Hmax": start.at_max,
        "x_y": start.at_yield,
        "q": middle.softening.q,
        "r": middle.softening.r,
        "D1": k.radius.d1,
        "D3": k.radius.d3,
        "D5": k.radius.d5,
        "p_SC": middle.p_simple,
        "s_SC": middle.simple.s,
        "x_infl_SC": middle.simple.inflection,
        "x_Hmin": middle.lowest,
        "Hmin": middle.hardness_min,
        "p": middle.p,
        "s": middle.softening.s,
        "c1": start.c1,
        "c2": start.c2,
    }
    if end is not None:
        out |= {
            "x_infl": middle.softening.inflection,
            "p_o": middle.p_o,
            "Hmin1": middle.estimates[0],
            "Hmin2": middle.estimates[1],
            "chi_Hmin": end.chi_min,
            "l": end.l,
            "u": end.u,
            "Vel_over_Vp": end.volume_loss,
            "chi_zp": end.chi_zero,
            "x_zp": end.zero_porosity,
        }
    return {name: float(value) for name, value in out.items()}


def regimes(i):
    k = parameters_of(i)
    h = law.hardness(i["x"], k)
    a, value = float(radius.relative_radius(i["x"], k.radius)), float(h.value)
    return {
        "regime": law.REGIMES[int(h.regime)],
        "H": value,
        "dH_dx": float(h.slope),
        "a_over_R": a,
        "P_over_sigmay_R2": pi * value * a**2,
    }


def dimensional_force(i):
    lam, zeta = law.material_numbers(i["E"], i["nu"], i["sigma_y"])
    x, scale = i["gamma"] / (2.0 * i["R"]), i["R"]
    at_x = regimes({"lam": lam, "zeta": zeta, "LC": i["LC"], "x": x})
    return {
        "a": at_x["a_over_R"] * scale,
        "H": at_x["H"],
        "P": at_x["P_over_sigmay_R2"] * i["sigma_y"] * scale**2,
        "regime": at_x["regime"],
        "x": x,
    }


def validity_c2(i):
    with np.errstate(invalid="ignore", divide="ignore"):
        k = law.onset(i["lam"])
    return {
        "c1": float(k.c1),
        "c2": float(k.c2),
        "valid": bool(k.c2 >= 1.0),
        "lambda_min": law.smallest_lambda(),
    }


def density_product_feature(i):
    value = density_product(i["x"], i["a_over_R"], CONTACTS[i["config"]])
    return {"product": value}


def secondary_displacement(i):
    k, both = secondary.growth(i["lam"]), 2.0 * i["R"]
    x = i["gamma"] / both
    return {
        "gamma_s": float(both * k.relative * x**k.omega),
        "tau_mm": float(k.tau),
        "omega": float(k.omega),
        "tau_hat": float(k.relative),
    }


def secondary_small(i):
    d = radius.coefficients(i["lam"], CONFIGURATIONS[i.get("LC_for_radius", "DC")])
    contact = secondary.small(i["x"], law.onset(i["lam"]), d)
    a, h = float(contact.radius), float(contact.hardness.value)
    return {
        "x_s": float(contact.overlap),
        "a_s": a,
        "H_s": h,
        "P_s": pi * h * a**2,
        "regime": law.REGIMES[int(contact.hardness.regime)],
    }


def secondary_large(i):
    k = law.parameters(i["lam"], i["zeta"], "die")
    h = secondary.large(i["x"], k, onset=i["x_onset"])
    return {
        "H": float(h.value),
        "a_s_over_R_at_onset": secondary.radius_at_onset(i["x_onset"]),
    }
