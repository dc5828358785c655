"""Fit laws of a particle to measured curves of force against displacement."""

from pestle.fit.least_squares import Curve, Fit, fit
from pestle.fit.output import draw_fit, material_set, save, summary

__all__ = ["Curve", "Fit", "draw_fit", "fit", "material_set", "save", "summary"]
