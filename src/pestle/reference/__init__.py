"""Closed forms of contact mechanics: plain functions of floats in SI units.

Tests, documentation and users take them from here; the engine does not, so that they
remain an independent check of its compiled laws.  Any consistent set of units works.

- `elasticity`: moduli of bodies and pairs
- `hertz`, `jkr`: spheres, elastic without and with adhesion
- `ellipse`: the elliptical indenter of the MDR space, with its adhesion in `peeling`
- `mdr`: yield and plastic contact; `volume`: radius update; `validity`: limits
- `abel`: the transforms between the 3-D and the 1-D contact problem
"""
