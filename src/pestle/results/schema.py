"""Names, units and layout of the results file.

``/VTKHDF`` is what VTK and ParaView read: a PolyData time series in which every
particle is a vertex, every contact a line between two particles and every triangle of a
wall a polygon. ``/pestle`` holds what belongs to us: schema version, provenance, case
text and the table of frames.
"""

from dataclasses import dataclass

SCHEMA_VERSION = 1
"""Version of the layout below. A reader refuses files of a newer one."""

VTKHDF_VERSION = (2, 2)
"""Version of the VTKHDF specification that the file follows."""

TOPOLOGIES = ("Vertices", "Lines", "Polygons", "Strips")
"""Kinds of PolyData cells, in the order that VTK expects."""

STAGE_LENGTH = 64
"""Longest stage name [bytes]."""


@dataclass(frozen=True, slots=True)
class Field:
    """What a column of the results file means."""

    unit: str
    description: str


PARTICLE_FIELDS: dict[str, Field] = {
    "id": Field("-", "number of the particle, the same in every frame"),
    "position": Field("m", "centre"),
    "radius": Field("m", "apparent radius: grows while the particle is squeezed"),
    "radius_initial": Field("m", "radius of the undeformed particle"),
    "velocity": Field("m/s", "velocity of the centre"),
    "angular_velocity": Field("rad/s", "angular velocity"),
    "material": Field("-", "number of the material in the order of the case file"),
    "stress": Field("Pa", "mean stress in the particle, compression positive"),
    "plastic_contacts": Field("-", "number of contacts that have yielded"),
    "psi": Field("-", "free part of the particle's surface"),
}

CONTACT_FIELDS: dict[str, Field] = {
    "first": Field("-", "id of the first particle"),
    "second": Field("-", "id of the second particle, -1 - w for wall number w"),
    "force": Field("N", "force on the first particle"),
    "normal": Field("-", "unit vector from the second to the first"),
    "overlap": Field("m", "overlap, positive in compression"),
    "flat": Field("m", "distance from the first centre to the contact plane"),
    "area": Field("m^2", "contact area"),
    "pressure": Field("Pa", "mean normal pressure over the contact area"),
    "yielded": Field("-", "1 after first yield"),
}

MESH_FIELDS: dict[str, Field] = {
    "corner": Field("m", "corners of all triangles"),
    "triangle": Field("-", "rows of the three corners of each triangle"),
    "wall": Field("-", "number of the wall that a triangle belongs to"),
}

KIND = "kind"
"""Cell array of the file: 0 particle, 1 pair, 2 particle and wall, 3 triangle."""
