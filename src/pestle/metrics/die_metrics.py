"""Numbers of a compaction in a die."""

import numpy as np

from pestle.metrics.compaction import ejection_stress, heckel, kawakita, work_of
from pestle.metrics.die_curves import LOWER, RELEASED, UPPER, DieCurves
from pestle.metrics.metric import Group, Metric
from pestle.results.folder import RunFolder

_PRESSING = Group("Pressing")
_FITS = Group("Compressibility (in-die)")
_RELEASE = Group("Unloading and ejection")


def pressing_metrics(curves: DieCurves) -> list[Metric]:
    """Numbers at the largest axial stress."""
    peak = curves.peak
    axial = float(curves.axial[peak])
    make = _PRESSING.metric
    found = [
        make(
            "peak_axial_stress",
            "Peak axial stress",
            axial,
            unit="Pa",
            definition="Largest force of the upper punch over π R² of the die.",
        ),
        make(
            "peak_relative_density",
            "Relative density at the peak",
            float(curves.density[peak]),
            unit="-",
            definition="True volume of the particles, elastic compression counted, "
            "over the volume between the punches, at the largest axial stress.",
        ),
        make(
            "peak_transmitted_stress",
            "Transmitted stress at the peak",
            float(curves.transmitted[peak]),
            unit="Pa",
            definition="Force of the lower punch over π R² of the die.",
        ),
        make(
            "axial_transmission",
            "Axial transmission",
            float(curves.transmitted[peak]) / axial,
            unit="-",
            definition="Transmitted over axial stress at the peak: 1 without wall "
            "friction.",
        ),
    ]
    radial = float(curves.radial[peak])
    if np.isfinite(radial):
        found += [
            make(
                "peak_radial_stress",
                "Radial stress at the peak",
                radial,
                unit="Pa",
                definition="Sum of the normal forces on the die over 2 π R h, h the "
                "distance of the punches.",
            ),
            make(
                "radial_transmission",
                "Radial transmission",
                radial / axial,
                unit="-",
                definition="Radial over axial stress at the peak.",
            ),
        ]
    return found


def fit_metrics(curves: DieCurves) -> list[Metric]:
    """Heckel and Kawakita constants with the ranges they were fitted over."""
    rows = curves.loading
    pressure, density = curves.axial[rows], curves.density[rows]
    make, found = _FITS.metric, []
    if line := heckel(pressure, density):
        where = f"in-die, {line.low / 1e6:.3g}–{line.high / 1e6:.3g} MPa"
        found += [
            make(
                "heckel_yield_pressure",
                "Mean yield pressure (Heckel)",
                line.yield_pressure,
                unit="Pa",
                definition=f"1/k of ln 1/(1−D) = k P + A; {where}, "
                f"R² = {line.r_squared:.4f}.",
            ),
            make(
                "heckel_intercept",
                "Heckel intercept A",
                line.intercept,
                unit="-",
                definition=f"A of the same line; {where}.",
            ),
        ]
    if curve := kawakita(pressure, density, float(density[0])):
        where = (
            f"in-die, {curve.low / 1e6:.3g}–{curve.high / 1e6:.3g} MPa, "
            f"D₀ = {curve.initial_density:.3f} when the punch meets the powder"
        )
        found += [
            make(
                "kawakita_a",
                "Kawakita a",
                curve.a,
                unit="-",
                definition=f"Limit of the volume reduction C; P/C = P/a + 1/(ab); "
                f"{where}, R² = {curve.r_squared:.4f}.",
            ),
            make(
                "kawakita_p",
                "Kawakita 1/b",
                1.0 / curve.b,
                unit="Pa",
                definition="Pressure at which half of that reduction is reached; the "
                "same fit.",
            ),
        ]
    return found


def release_metrics(curves: DieCurves, folder: RunFolder) -> list[Metric]:
    """Residual die-wall stress, ejection stress, work."""
    make, found = _RELEASE.metric, []
    released = curves.is_released and curves.release > curves.peak
    residual = float(curves.radial[curves.release])
    if released and np.isfinite(residual):
        found.append(
            make(
                "residual_die_wall_stress",
                "Residual die-wall stress",
                residual,
                unit="Pa",
                definition="Radial stress in the die when the upper punch leaves the "
                f"tablet (its stress has fallen to {100 * RELEASED:g} % of the peak).",
            )
        )
    rows = curves.rows_of("eject")
    height = float(curves.height[curves.release])
    if len(rows) and released and height > 0.0 and folder.history is not None:
        force = float(np.max(folder.history[f"{LOWER}.force_z [N]"][rows]))
        found.append(
            make(
                "ejection_stress",
                "Ejection stress",
                ejection_stress(force, curves.die_radius, height),
                unit="Pa",
                definition="Largest force of the lower punch while it ejects, over "
                f"π D h with h = {height * 1e3:.4g} mm of tablet in the die.",
            )
        )
    return found + _work(curves, folder, released=released)


def _work(curves: DieCurves, folder: RunFolder, *, released: bool) -> list[Metric]:
    history = folder.history
    if history is None:
        return []
    down = history[f"{UPPER}.displacement [m]"]
    force = -history[f"{UPPER}.force_z [N]"]
    rows = np.arange(curves.touch, curves.peak + 1)
    work = work_of(force[rows], down[rows])
    make = _RELEASE.metric
    found = [
        make(
            "work_of_compaction",
            "Work of compaction",
            work,
            unit="J",
            definition="Integral of upper punch force over its displacement up to the "
            "peak.",
        )
    ]
    if released and work > 0.0:
        back = -work_of(force[curves.unloading], down[curves.unloading])
        found.append(
            make(
                "work_recovered",
                "Work given back",
                back / work,
                unit="-",
                definition="The same integral while the punch leaves, over the work "
                "of compaction: the elastic part.",
            )
        )
    return found
