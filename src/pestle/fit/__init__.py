"""Fit laws of a particle to measured curves of force against displacement."""
