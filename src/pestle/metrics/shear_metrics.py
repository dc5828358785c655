"""What a shear cell says of the powder: friction, cohesion, strength, flow function."""

from math import sqrt

import numpy as np

from pestle.metrics.metric import Group, Metric
from pestle.metrics.shear_cell import ShearTest, shear_curves, shear_test
from pestle.results.folder import RunFolder

_SHEAR = Group("Shear cell")


def shear_metrics(folder: RunFolder) -> list[Metric]:
    """Numbers of the steps `shear`, as far as they go."""
    test = shear_test(shear_curves(folder))
    found = _steady(test) if len(test.steady) else []
    if test.locus is not None:
        found += _locus(test)
    return found


def _steady(test: ShearTest) -> list[Metric]:
    ratio = test.steady[:, 1] / test.steady[:, 0]
    error = float(np.std(ratio, ddof=1)) / sqrt(len(ratio)) if len(ratio) > 1 else None
    if error is None:
        error = float(test.steady[0, 2] / test.steady[0, 0])
    return [
        _SHEAR.metric(
            "steady_friction",
            "Steady friction",
            float(ratio.mean()),
            unit="-",
            definition="Shear over normal stress over the last half of the pre-shears, "
            "mean.",
        ),
        _SHEAR.metric(
            "steady_friction_error",
            "Error of the steady friction",
            error,
            unit="-",
            definition="Standard error, from the scatter of the pre-shears; of a "
            "single one, from five blocks of it.",
        ),
    ]


def _locus(test: ShearTest) -> list[Metric]:
    locus = test.locus
    assert locus is not None
    angle, angle_error = locus.friction_angle
    strength, strength_error = locus.strength
    found = [
        _SHEAR.metric(
            "internal_friction_angle",
            "Angle of internal friction",
            angle,
            unit="deg",
            definition="Inclination of the straight line through the yield points, "
            "each the largest shear stress averaged over a fifth of its step.",
        ),
        _SHEAR.metric(
            "internal_friction_angle_error",
            "Error of the angle of internal friction",
            angle_error,
            unit="deg",
            definition="Standard error, from how far averages over a fifth of a step "
            "scatter and the points lie off the line.",
        ),
        _SHEAR.metric(
            "cohesion",
            "Cohesion",
            locus.cohesion,
            unit="Pa",
            definition="Shear stress of that line without normal stress.",
        ),
        _SHEAR.metric(
            "cohesion_error",
            "Error of the cohesion",
            locus.cohesion_error,
            unit="Pa",
            definition="Standard error, from how far averages over a fifth of a step "
            "scatter and the points lie off the line.",
        ),
        _SHEAR.metric(
            "unconfined_yield_strength",
            "Unconfined yield strength",
            strength,
            unit="Pa",
            definition="Largest stress of the Mohr circle through the origin that "
            "touches the line.",
        ),
        _SHEAR.metric(
            "unconfined_yield_strength_error",
            "Error of the unconfined yield strength",
            strength_error,
            unit="Pa",
            definition="Standard error, from those of cohesion and slope.",
        ),
    ]
    if len(test.steady):
        normal, shear = test.steady[:, :2].mean(axis=0)
        _, major = locus.consolidation(normal, shear)
        found.append(
            _SHEAR.metric(
                "major_consolidation_stress",
                "Major consolidation stress",
                major,
                unit="Pa",
                definition="Largest stress of the Mohr circle through the mean "
                "pre-shear point that touches the line.",
            )
        )
        if strength > 2.0 * strength_error:
            found.append(
                _SHEAR.metric(
                    "flow_function_coefficient",
                    "Flow function coefficient",
                    major / strength,
                    unit="-",
                    definition="Major consolidation stress over unconfined yield "
                    "strength; left out where the strength is below two of its errors.",
                )
            )
    return found
