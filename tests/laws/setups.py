"""One law of each kind, with options that suit the contact of `pestle.testing`."""

from pestle.laws import (
    DMT,
    EEPA2014,
    JKR,
    Hertz,
    Luding2008,
    Nan2022,
    Pasha2014,
    Pasha2014Simplified,
    Storakers1997,
    ThorntonNing1998,
    WaltonBraun1986,
)

LAWS = {
    "hertz": Hertz(),
    "jkr": JKR(),
    "dmt": DMT(),
    "nan2022": Nan2022(),
    "nan2022 tn64": Nan2022(pull_off="tn64", plastic_ratio=0.5),
    "nan2022 energy67": Nan2022(pull_off="energy67", plastic_ratio=0.6),
    "nan2022 elastic": Nan2022(yields=False),
    "nan2022 remembers": Nan2022(alpha_forget=-2e-6),
    "thornton_ning1998": ThorntonNing1998(),
    "thornton_ning1998 exact": ThorntonNing1998(variant="exact"),
    "thornton_ning1998 ay_over_a": ThorntonNing1998(variant="ay_over_a"),
    "walton_braun1986": WaltonBraun1986(
        loading_stiffness=500.0, unloading_stiffness=2000.0
    ),
    "walton_braun1986 variable": WaltonBraun1986(
        loading_stiffness=500.0, steepening=1e6
    ),
    "luding2008": Luding2008(
        loading_stiffness=500.0, unloading_stiffness=2500.0, cohesive_stiffness=300.0
    ),
    "luding2008 depth": Luding2008(
        loading_stiffness=500.0,
        unloading_stiffness=2500.0,
        cohesive_stiffness=500.0,
        plasticity_depth=0.02,
    ),
    "pasha2014": Pasha2014(
        elastic_stiffness=3000.0, plastic_stiffness=600.0, yield_force=1e-4
    ),
    "pasha2014_simplified": Pasha2014Simplified(
        plastic_stiffness=600.0,
        cohesive_stiffness=50.0,
        touch_force=1e-5,
        pull_off_force=4e-5,
        elastic_stiffness=3000.0,
    ),
    "pasha2014_simplified growing": Pasha2014Simplified(
        plastic_stiffness=600.0, pull_off_force=3e-5, stiffest=9000.0
    ),
    "eepa2014": EEPA2014(),
    "eepa2014 sticky": EEPA2014(
        plasticity_ratio=0.8, tensile_exponent=4.5, touch_force=2e-6
    ),
    "eepa2014 linear": EEPA2014(loading_stiffness=800.0, tensile_exponent=1.0),
    "storakers1997": Storakers1997(),
    "storakers1997 hardening": Storakers1997(hardening_exponent=0.4),
}
NAMES = list(LAWS)
