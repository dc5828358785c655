r"""EEPA (Morrissey 2013, Thakur et al. 2014): Edinburgh elastic-plastic adhesive law.

With x = delta^n, n = 3/2 and k_1 = 4/3 E* sqrt(R*), or n = 1 and a given k_1:

.. math::
    f = -f_0 + \begin{cases} k_1 x & k_2(x-x_p) \ge k_1 x \\
    k_2(x-x_p) & k_1 x > k_2(x-x_p) > -k_{adh}\delta^\chi \\
    -k_{adh}\delta^\chi & \text{else} \end{cases}, \quad
    k_2 = \frac{k_1}{1-\lambda_p}, \quad x_p = \lambda_p x_{max}

The pull-off force beyond f_0 is 3/2 pi W a with a^2 = 2 R* delta_max: it grows with the
patch pressed flat; k_adh follows from the overlap delta_min where the unloading line
meets it, which is kept above half of delta_p.  On the adhesive branch delta_max is
lowered and k_adh kept, so that a contact loaded again follows k_2.  Contacts part at
zero overlap; there is no elastic range.  The tangential spring takes a = k/(2 E*).

Sources: the public documentation of codes that offer the law, and the thesis' equations
as quoted there; the patch radius and the lower limit of delta_min differ between codes.

References: J. P. Morrissey, PhD thesis, University of Edinburgh (2013); S. C. Thakur et
al., Granul. Matter 16 (2014) 383-400.
"""

from dataclasses import dataclass
from math import pi, sqrt
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.errors import InputError
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, parameter
from pestle.reference.roots import cube_root


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    modulus: float  # E* [Pa]
    linear: float  # k_1 where n = 1, 0 where n = 3/2 [N/m]
    plasticity: float  # lambda_p [-]
    adhesion: float  # W [J/m^2]
    touch: float  # f_0 [N]
    exponent: float  # chi [-]
    half: float  # 1 if chi holds a half
    one: float  # 1 if chi holds a one
    two: float  # 1 if chi holds a two
    four: float  # 1 if chi holds a four


class State(NamedTuple):
    """What a contact remembers; zero at first touch."""

    opens: float  # x_p [m^n]
    turn: float  # delta_min, where the adhesive branch begins [m]
    tension: float  # k_adh delta_min^chi, tension there beyond f_0 [N]


@dataclass(frozen=True, slots=True, kw_only=True)
class EEPA2014(PairLaw):
    """Elastic-plastic adhesive contacts for cohesive powders in bulk."""

    plasticity_ratio: float = parameter(
        "lambda_p = 1 - k_1/k_2; 0 is elastic", "1", 0.0, 1.0, "[)", default=0.5
    )
    tensile_exponent: float = parameter(
        "chi, a multiple of 0.5", "1", 1.0, 7.5, "[]", default=1.5
    )
    touch_force: float = parameter(
        "f_0, constant attraction in contact", "N", ends="[)", default=0.0
    )
    loading_stiffness: float | None = parameter(
        "k_1 of the linear version; none: Hertzian", "N/m", default=None
    )

    name: ClassVar[str] = "eepa2014"
    summary: ClassVar[str] = "Edinburgh elastic-plastic adhesive law (EEPA)"
    validity: ClassVar[str] = "a rule: parameters are calibrated"
    citation: ClassVar[str] = cite("thakur2014")

    def _check(self) -> None:
        chi = self.tensile_exponent
        if not (2.0 * chi).is_integer():
            raise InputError(
                "bad-exponent",
                f"tensile_exponent {chi:g} is not a multiple of 0.5",
                "law.tensile_exponent",
            )

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        halves = int(2.0 * self.tensile_exponent)
        return Constants(
            pair.modulus,
            self.loading_stiffness or 0.0,
            self.plasticity_ratio,
            pair.work_of_adhesion,
            self.touch_force,
            self.tensile_exponent,
            *(float(halves >> bit & 1) for bit in range(4)),
        )


def power(k: Constants, q: float) -> float:
    """q^chi [-]."""
    q2 = q * q
    low = (sqrt(q) if k.half > 0.0 else 1.0) * (q if k.one > 0.0 else 1.0)
    return low * (q2 if k.two > 0.0 else 1.0) * (q2 * q2 if k.four > 0.0 else 1.0)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, contact radius, stiffness and energy at an overlap."""
    if g.overlap <= 0.0:
        return Response(0.0, 0.0, 0.0, 0.0, 1.0), State(0.0, 0.0, 0.0)
    hertz = k.linear == 0.0
    n = 1.5 if hertz else 1.0
    d = g.overlap
    k1 = 4.0 / 3.0 * k.modulus * sqrt(g.radius) if hertz else k.linear
    k2 = k1 / (1.0 - k.plasticity)
    x = d * sqrt(d) if hertz else d
    loads = k.plasticity * x >= s.opens
    # loading: the patch grows
    opens = k.plasticity * x
    most = (1.0 - (0.3535533905932738 if hertz else 0.5)) * k2 * opens
    tension = min(1.5 * pi * k.adhesion * sqrt(2.0 * g.radius * d), most)
    part = max(k.plasticity - tension / (k2 * x + 1e-300), 0.0)
    root = cube_root(part)
    turn = d * (root * root if hertz else part)
    opens = opens if loads else s.opens
    turn = turn if loads else s.turn
    tension = tension if loads else s.tension
    # below the turning point: the patch shrinks
    pulls = d < turn
    q = d / turn if pulls else 1.0
    tension = tension * power(k, q)
    turn = d if pulls else turn
    opens = x + tension / k2 if pulls else opens
    line = k1 * x if loads else k2 * (x - opens)
    force = (-tension if pulls else line) - k.touch
    level = turn * sqrt(turn) if hertz else turn
    raised = k2 * ((x * d - level * turn) / (n + 1.0) - opens * (d - turn))
    stored = raised - tension * turn / (k.exponent + 1.0) - k.touch * d
    steep = n * (k1 if loads else k2) * (sqrt(d) if hertz else 1.0)
    slope = k.exponent * tension / d if pulls else steep
    return (
        Response(force, 0.5 * slope / k.modulus, slope, stored, 1.0),
        State(opens, turn, tension),
    )


register(EEPA2014, constants=Constants, state=State, contact=contact)
