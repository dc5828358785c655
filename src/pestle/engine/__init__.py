"""Compiled DEM engine: arrays in, arrays out; it knows no units, files or case."""
