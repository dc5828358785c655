"""Features of nan.json: the laws that Nan 2022 is compared with."""

from pestle.laws import Geometry, luding2008, walton_braun1986
from pestle.reference import pasha2014
from pestle.reference import thornton_ning1998 as tn


def register_others(features):
    """Add the features of this module to a file's."""
    features.register("thornton_ning")(thornton_ning)
    features.register("thornton_ning_Vys")(thornton_ning_vys)
    features.register("thornton_ning_closed")(thornton_ning_closed)
    features.register("luding")(luding)
    features.register("walton_braun")(walton_braun)
    features.register("pasha_full")(pasha_full)
    features.register("pasha_simple")(pasha_simple)


def forces(law, k, path, radius):
    """Forces of a law along a path of overlaps, from a fresh contact."""
    state, out = law.State(*[0.0] * len(law.State._fields)), []
    for overlap in path:
        g = Geometry(overlap, radius, 2 * radius, 2 * radius, 1.0, 0.0)
        answer, state = law.contact(k, g, state)
        out.append(answer.force)
    return out


def sphere(i):
    return tn.sphere(
        i["E_star"], i["R_star"], i["Gamma"], i["p_y"], i.get("variant", "tangent")
    )


def thornton_ning(i):
    s = sphere(i)
    restitution, peak = tn.impact(s, i["m_star"], i["V_i"])
    return {
        "a_y": s.yields,
        "e": restitution,
        "a_star": peak.radius,
        "alpha_max": peak.overlap,
        "f_max": peak.force,
        "R_p": peak.flattened,
        "alpha_zero_force": peak.rest,
        "f_cp": peak.pull_off,
    }


def thornton_ning_vys(i):
    return {"V_ys": tn.plastic_sticking_velocity(sphere(i), i["m_star"])}


def thornton_ning_closed(i):
    ratio, sticking = i["V_y"] / i["V_i"], i["V_s"] / i["V_i"]
    return {
        "e_44": tn.restitution_without_adhesion(ratio),
        "e_46": tn.restitution_fast(ratio),
        "e_78": tn.restitution_with_adhesion(ratio, sticking),
    }


def luding(i):
    radius = 1.0
    k = luding2008.Constants(
        i["k1"], i["k2hat"], i["kc"], i["dstar"] / (2 * radius), 0.0, 1.0
    )
    return {
        "f": forces(luding2008, k, i["delta"], radius),
        "e": luding2008.restitution(k, radius, i["m_star"], i["V_i"]),
    }


def walton_braun(i):
    first = i["K1"]
    k = walton_braun1986.Constants(
        first, i.get("K2") or first, i.get("S", 0.0) * first, 1.0
    )
    return {
        "f": forces(walton_braun1986, k, i["alpha"], 1.0),
        "e": walton_braun1986.restitution(k, i["m_star"], i["V_i"]),
    }


def pasha_full(i):
    k = pasha2014.Full(i["k_e"], i["k_p"], i["Gamma"], i["R_star"], i["f_y"])
    line = pasha2014.full_line(k, i["alpha_max"])
    return {
        "alpha_y": pasha2014.full_yield_overlap(k),
        "alpha_p": line.rest,
        "f_cp": line.pull_off,
        "e": pasha2014.full_restitution(k, i["m_star"], i["V_i"]),
    }


def pasha_simple(i):
    k = pasha2014.Simple(
        i["k_p"],
        i["k_cp"],
        i["f_0"],
        i["f_0p"],
        i.get("k_e") or 0.0,
        i.get("khat") or 0.0,
        i["R_star"],
    )
    peak = pasha2014.simple_peak(k, i["m_star"], i["V_i"])
    line = pasha2014.simple_line(k, peak)
    return {
        "alpha_max": peak,
        "alpha_p": line.rest,
        "f_cp": line.pull_off,
        "e": pasha2014.simple_restitution(k, i["m_star"], i["V_i"]),
    }
