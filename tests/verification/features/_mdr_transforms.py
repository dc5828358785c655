"""The `mdr_transform` feature: transforms of fields whose image is known."""

from math import asin, pi, sqrt

from pestle.reference import abel, ellipse, hertz
from pestle.reference.ellipse import Ellipse


def transform(i):
    """Outputs of a transform; `kind` names the field and what is known of it."""
    kind = i["kind"].lower()
    if "ellip" in kind:
        return _ellipse(i)
    if "uniform" in kind:
        return _pressed(i, lambda r: i["p"], i["a"])
    if "punch" in kind:
        return _punch(i)
    if "hertz" in kind or "parabol" in kind or "sphere" in kind:
        return _sphere(i)
    raise NotImplementedError(f"transform of {i['kind']!r}")


def _positions(i, name):
    return i.get(name, [])


def _pressed(i, pressure, a):
    """Springs, and their force, under a known pressure: (17), (18)."""
    q = [abel.line_load(pressure, a, x) for x in _positions(i, "x")]
    out = {"q_1D": q, "a": a}
    out["F"] = _force(lambda x: abel.line_load(pressure, a, x), a)
    if "Es" in i:
        out["w_1D"] = [value / i["Es"] for value in q]
    return out


def _force(line_load, a):
    """Integral of a line load over the contact, smooth in the angle."""
    from math import cos, sin

    from scipy.integrate import quad

    def integrand(t):
        return line_load(a * sin(t)) * cos(t)

    return 2 * a * quad(integrand, 0.0, pi / 2, epsabs=0.0, epsrel=1e-12)[0]


def _sphere(i):
    """Hertz: from the pressure to the springs, and the parabola both ways."""
    r, delta, es = i["R"], i.get("delta"), i.get("Es", 1.0)
    out = {
        "g_1D": [abel.profile(lambda s: s / r, x) for x in _positions(i, "x")],
        "g_3D": [abel.gap(lambda x: x * x / r, s) for s in _positions(i, "r")],
    }
    if delta is None:
        return out
    a = hertz.contact_radius(delta, r)
    out |= _pressed(i, lambda s: hertz.pressure(s, delta, r, modulus=es), a)
    inside = [s for s in _positions(i, "r") if s < a]
    out["p_3D"] = [abel.pressure(lambda x: -2 * es * x / r, a, s) for s in inside]
    out["w_3D"] = [
        abel.surface(lambda x: delta - x * x / r, a, s) for s in _positions(i, "r")
    ]
    return out


def _ellipse(i):
    """The elliptical indenter: gap (5), back (4), pressure (9)."""
    shape = Ellipse(i["A"], i["B"])
    es, depth = i.get("Es", 1.0), i.get("de", i["A"] / 2)
    a = ellipse.contact_radius(shape, depth)

    def line_slope(x):
        return -es * ellipse.slope(shape, x)

    out = {"g_3D": [], "g_1D": [], "p_3D": [], "w_3D": []}
    for r in _positions(i, "r"):
        out["g_3D"].append(abel.gap(lambda x: ellipse.profile(shape, x), r))
        if r < a:
            out["p_3D"].append(abel.pressure(line_slope, a, r))
        out["w_3D"].append(
            abel.surface(lambda x: depth - ellipse.profile(shape, x), a, r)
        )
    out["g_1D"] = [ellipse.profile(shape, x) for x in _positions(i, "x")]
    out["q_1D"] = [es * max(depth - g, 0.0) for g in out["g_1D"]]
    out["w_1D"] = [max(depth - g, 0.0) for g in out["g_1D"]]
    out["F"] = ellipse.force(shape, depth, modulus=es)
    return out


def _punch(i):
    """The flat punch (A.1)-(A.4), whose springs move together."""
    a, es = i["a"], i.get("Es", 1.0)
    delta = i.get("delta", i.get("delta_o", 1.0))

    def slope(r):
        return -2 / pi * delta * a / (r * sqrt(r * r - a * a)) if r > a else 0.0

    def displaced(r):
        return delta if r <= a else 2 / pi * delta * asin(a / r)

    x = _positions(i, "x")
    w_1d = [abel.spring(slope, delta, s, breaks=(a,)) if s < a else 0.0 for s in x]
    return {
        "w_1D": w_1d,
        "q_1D": [es * w for w in w_1d],
        "w_3D": [displaced(r) for r in _positions(i, "r")],
        "p_3D": [
            abel.pressure(lambda _: 0.0, a, r, edge=es * delta)
            for r in _positions(i, "r")
            if r < a
        ],
        "F": 2 * es * a * delta,
        "k_z": 2 * es * a,
    }
