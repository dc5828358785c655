"""Chapter 3 of the thesis: power-law hardening."""

from math import pi

from pestle.particle import shahin2021_hardening, shahin2021_hardness
from pestle.particle.shahin2021_radius import (
    contact_radius,
    relative_radius,
    rigid_coefficients,
)
from verification.features import Features

CONFIGURATIONS = {"SC": "simple", "DC": "die", "HC": "hydrostatic"}
HARDENING_LAWS = (
    "hardening_SC_fp",
    "hardening_DC_fp",
    "hardening_DC_lc",
    "hardening_DC_ev",
    "hardening_HC_fp",
    "hardening_HC_lc",
    "hardening_HC_ev",
)


def parameters(i):
    """Parameters of chapter 3, with a reading other than the default where named."""
    return shahin2021_hardening.parameters(
        i["h"],
        CONFIGURATIONS[i["LC"]],
        reading=i.get("reading", "consistent"),
        lc_sign=int(i.get("lc_sign", -1)),
    )


def register_hardening(features: Features) -> None:
    """Register the features of chapter 3."""
    features.register(
        "hardening_parameters_SC", "hardening_parameters_DC", "hardening_parameters_HC"
    )(hardening_parameters)
    features.register(*HARDENING_LAWS)(hardening_law)
    features.register("hardening_radius_unequal")(hardening_radius)


def hardening_parameters(i):
    k = parameters(i)
    rigid = rigid_coefficients(k.configuration)
    out = {
        "Hmax_h": k.hardness_max,
        "x_Hmin": float(k.rigid.lowest),
        "s": float(k.rigid.softening.s),
        "Hmin": k.hardness_min,
        "p": k.p,
        "D1": rigid.d1,
        "D3": rigid.d3,
        "D5": rigid.d5,
        "k_LC": k.k,
        "x_infl": float(k.rigid.softening.inflection),
    }
    if k.configuration != "simple":
        out |= {"chi_Hmin": k.chi_min, "u": k.u, "x_zp": k.zero_porosity}
    return out


def hardening_law(i):
    k = parameters(i)
    h = shahin2021_hardening.hardness(i["x"], k)
    a, value = float(relative_radius(i["x"], k.radius)), float(h.value)
    return {
        "regime": shahin2021_hardness.REGIMES[int(h.regime)],
        "H": value,
        "dH_dx": float(h.slope),
        "a_over_R": a,
        "P_over_kappa_R2": pi * value * a**2,
    }


def hardening_radius(i):
    d = rigid_coefficients(CONFIGURATIONS[i["LC"]], i["h"])
    return {"a": float(contact_radius(i["gamma"], i["R1"], i["R2"], d))}
