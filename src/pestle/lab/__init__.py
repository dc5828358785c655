"""Finite elements: one elastic-plastic sphere between rigid frictionless flats.

Lengths are in initial radii, stresses in Young's moduli.
"""
