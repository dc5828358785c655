"""Features of nan.json: Nan 2022 here, the laws it is compared with beside."""

from math import inf, sqrt

from pestle.laws import Pair, Solid
from pestle.reference import jkr, jkr_contact
from pestle.reference import nan2022 as nan
from pestle.reference import nan2022_energy as energy
from pestle.reference import nan2022_impact as impacts
from verification.features import Features
from verification.features._nan_others import register_others

FEATURES = Features(atol=0.0)
register_others(FEATURES)


def contact(i):
    """Contact of a case; what it leaves out follows from the paper's defaults."""
    e, r, adhesion, pressure = i["E_star"], i["R_star"], i["Gamma"], i["p_y"]
    elastic = i.get("k_el") or energy.elastic_stiffness(pressure, r)
    ratio = (
        elastic / i["k_cl"]
        if i.get("k_cl")
        else nan.stiffness_ratio(e, r, adhesion, elastic)
    )
    rule = float(nan.RULES.index(i.get("fcp_law", "nan59")))
    plastic = i.get("k_p") or elastic
    return nan.contact(e, r, adhesion, pressure, elastic, plastic, ratio, rule)


def reduced(one, two):
    """Reduced value of two, of which the second may be missing: infinite."""
    return one if two is None else one * two / (one + two)


@FEATURES.register("effective")
def effective(i):
    sides = [(i["E1"], i["nu1"]), (i["E2"], i["nu2"])]
    solids = [
        Solid() if e is None else Solid(youngs_modulus=e, poisson_ratio=nu)
        for e, nu in sides
    ]
    pair = Pair(first=solids[0], second=solids[1])
    return {
        "E_star": pair.modulus,
        "R_star": reduced(i["R1"], i["R2"]),
        "m_star": reduced(i["m1"], i["m2"]),
        "G_star": pair.shear_modulus,
    }


@FEATURES.register("yield_pressure")
def yield_pressure(i):
    return {
        "p_y_32": energy.yield_pressure(i["sigma_y"], i["nu"]),
        "p_y_33": energy.yield_pressure_chang(i["sigma_y"], i["nu"]),
    }


@FEATURES.register("rate")
def rate(i):
    value = energy.rate_yield_stress(i["sigma_s"], i["Y"], i["Vi"], i["V0"])
    return {"sigma_y": value}


@FEATURES.register("adhesion")
def adhesion(i):
    k = (i["E_star"], i["R_star"], i["Gamma"])
    tension = -jkr.pull_off(i["R_star"], work_of_adhesion=i["Gamma"])
    return {
        "f_ce": tension,
        "f_0": 8 / 9 * tension,
        "W_JKR_paper": nan.jkr_work(*k),
        "W_JKR_exact": nan.jkr_work(*k, nan.WORK_EXACT),
    }


@FEATURES.register("yield_point")
def yield_point(i):
    k = (i["E_star"], i["R_star"], i["p_y"])
    default = energy.elastic_stiffness(i["p_y"], i["R_star"])
    force = nan.yield_force(*k, i.get("k_el") or default)
    return {
        "W_y": nan.yield_work(*k),
        "f_y0": nan.yield_force_hertz(*k),
        "alpha_y0": nan.yield_overlap_hertz(*k),
        "f_y": force,
        "alpha_y_minus_alpha_0": force / (i.get("k_el") or default),
        "k_el_default": default,
    }


@FEATURES.register("stiffness_ratio")
def stiffness_ratio(i):
    k = (i["E_star"], i["R_star"], i["Gamma"])
    ratio = nan.stiffness_ratio(*k, i["k_el"])
    rounded = nan.stiffness_ratio_rounded(*k, i["k_el"])
    return {
        "kel_over_kcl": ratio,
        "k_cl": i["k_el"] / ratio,
        "kel_over_kcl_eq38_rounded": rounded[0],
        "kel_over_kcl_eq39_rounded": rounded[1],
        "A": 96 / (56 * ratio + 17),
    }


@FEATURES.register("kel_iteration")
def kel_iteration(i):
    plastic = i["k_p"] if i["law"] == "kp_sqrt" else 0.0
    elastic, overlap = energy.elastic_stiffness_from_unloading(
        i["E_star"], i["R_star"], i["Gamma"], i["p_y"],
        measured=i["k_e0"], overlap=i["alpha_max0"], plastic=plastic,
    )  # fmt: skip
    return {"k_el": elastic, "alpha_y": overlap}


@FEATURES.register("derived")
def derived(i):
    c = contact(i)
    u = nan.unloading(c, 0.0)
    return {
        "k_el": c.elastic,
        "k_p": c.plastic,
        "k_cl": u.adhesive,
        "f_ce": c.pull_off,
        "f_0": 8 / 9 * c.pull_off,
        "f_y": c.yield_force,
        "alpha_0": c.rest,
        "alpha_y": c.yield_overlap,
        "alpha_ce": u.turn,
        "alpha_je": u.leave,
        "A": c.flattening,
    }


@FEATURES.register("alpha_max_functions")
def alpha_max_functions(i):
    c, peak = contact(i["contact"]), i["alpha_max"]
    u = nan.unloading(c, peak)
    out = {
        "k_e": u.elastic,
        "k_c": u.adhesive,
        "f_max": u.force,
        "alpha_p": u.rest,
        "alpha_c0": u.touch,
        "alpha_cp": u.turn,
        "alpha_jp": u.leave,
        "f_cp": u.pull_off,
    }
    for rule, name in enumerate(nan.RULES):
        other = nan.unloading(c._replace(rule=float(rule)), peak)
        out[f"fcp_ratio_{name[-2:]}"] = other.pull_off / c.pull_off
    return out


@FEATURES.register("path")
def path(i):
    c, forget = contact(i["contact"]), i.get("alpha_forget", 0.0)
    forget = -inf if forget is None else forget
    peak = attached = 0.0
    answers = []
    for overlap in i["alpha"]:
        answers.append(nan.respond(c, overlap, peak, attached, forget))
        peak, attached = answers[-1].peak, answers[-1].attached
    return {
        "f": [a.force for a in answers],
        "cs": [int(a.attached) for a in answers],
        "branch": "".join("fepc"[int(a.branch)] for a in answers),
        "alpha_max": [max(a.peak, c.yield_overlap) for a in answers],
        "k_n": [a.stiffness for a in answers],
    }


@FEATURES.register("works")
def works(i):
    return energy.works(contact(i["contact"]), i["alpha_max"])._asdict()


@FEATURES.register("velocities")
def velocities(i):
    c = contact(i["contact"])
    v = energy.velocities(c, i["m_star"])
    k = (c.modulus, c.radius, c.adhesion, c.pressure)
    return {
        "V_s": v.sticking,
        "V_y0": v.plain_yield,
        "V_y": sqrt(max(v.yield_squared, 0.0)),
        "V_y_squared_signed": v.yield_squared,
        "V_ys": v.plastic_sticking,
        "CY": energy.cohesion_yield_number(*k),
    }


@FEATURES.register("closed_wall")
def closed_wall(i):
    e, rho = i["E_star"], i["rho"]
    return {
        "V_s_eq73": energy.sticking_velocity(e, i["R"], i["Gamma"], rho),
        "V_y0_eq74": energy.yield_velocity(e, rho, i["p_y"]),
    }


@FEATURES.register("critical_pressure")
def critical_pressure(i):
    k = (i["E_star"], i["R_star"], i["Gamma"])
    pressure = energy.critical_pressure(*k)
    return {
        "p_y_eq80": pressure,
        "p_y_eq77": energy.critical_pressure_sticking(*k),
        "CY_at_eq80": energy.cohesion_yield_number(*k, pressure),
    }


def impact_options(i):
    return {
        "restitution": i.get("e0", 1.0),
        "beta": i.get("beta", 1.0),
        "beta_yielded": i.get("beta_y", 0.1),
    }


@FEATURES.register("impact")
def impact(i):
    r = impacts.impact(
        contact(i["contact"]), i["m_star"], i["V_i"], **impact_options(i)
    )
    return {
        "e": r.restitution,
        "stuck": r.stuck,
        "alpha_max": r.peak,
        "f_max": r.force,
        "alpha_p": r.rest,
        "f_cp": r.pull_off,
        "t_contact": r.time,
        "E_viscous": r.viscous,
    }


@FEATURES.register("critical_velocity")
def critical_velocity(i):
    c = contact(i["contact"])
    found = impacts.critical_velocity(c, i["m_star"], **impact_options(i))
    return {"V_crit": found}


@FEATURES.register("time_step")
def time_step(i):
    k, depth = (i["R"], i["rho"], i["E"]), i["amax_over_R"]
    step = energy.critical_time_step(*k, depth)
    return {
        "dt_rayleigh": energy.rayleigh_time_step(*k, i["nu"]),
        "dt_crit_70": step,
        "ratio_72": energy.time_step_ratio(i["nu"], depth),
        "dt_crit_68": step,
    }


@FEATURES.register("damping")
def damping(i):
    gamma = energy.damping_factor(i["e0"], i["beta"])
    return {"gamma": gamma, "c": 2 * gamma * sqrt(i["m_star"] * i["k_n"])}


@FEATURES.register("kt_over_kn")
def kt_over_kn(i):
    solids = [
        Solid() if e is None else Solid(youngs_modulus=e, poisson_ratio=nu)
        for e, nu in ((i["E1"], i["nu1"]), (i.get("E2"), i.get("nu2")))
    ]
    pair = Pair(first=solids[0], second=solids[1])
    return {"kt_over_kn": 4 * pair.shear_modulus / pair.modulus}


@FEATURES.register("tangential")
def tangential(i):
    force, spring, slides = nan.tangential(
        i["k_t"], i["delta_t"], i["v_t"], i["f"],
        friction=i["mu"], damping=i["gamma"], mass=i["m_star"],
        cap={"abs": "abs", "pulloff": "pull_off"}.get(i["cap"], "positive"),
        pull_off=i.get("f_cp", 0.0),
    )  # fmt: skip
    return {"F_t": force, "delta_new": spring, "sliding": slides}


@FEATURES.register("hertz_jkr")
def hertz_jkr(i):
    e, r, w, x = i["E_star"], i["R_star"], i["Gamma"], i["alpha"]
    k = (e, r, w)
    a = jkr_contact.contact_radius(x, *k)
    at_zero = jkr_contact.contact_radius(0.0, *k)
    at_rest = jkr.self_contact_radius(r, modulus=e, work_of_adhesion=w)
    free = jkr_contact.overlap_at(at_rest, *k)
    depth = max(x, 0.0)
    return {
        "a": a,
        "f_jkr": jkr_contact.force_at(a, *k),
        "k_jkr": jkr_contact.slope_at(a, *k),
        "f_hertz": 4 / 3 * e * sqrt(r) * depth**1.5,
        "k_hertz": 2 * e * sqrt(r * depth),
        "alpha_zero_force": free,
        "alpha_detach": -jkr_contact.separation_length(*k),
        "k_at_alpha0": jkr_contact.slope_at(at_zero, *k),
        "k_at_f0": jkr_contact.slope_at(at_rest, *k),
        "k_hertz_at_f0": 2 * e * sqrt(r * free),
    }


@FEATURES.register("jkr_restitution")
def jkr_restitution(i):
    work = nan.jkr_work(i["E_star"], i["R_star"], i["Gamma"], nan.WORK_EXACT)
    lost = 2 * work / (i["m_star"] * i["V_i"] ** 2)
    return {"e": sqrt(max(1 - lost, 0.0))}
