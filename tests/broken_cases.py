"""A good case file and the many ways to break it, for config/test_broken_cases.py."""

CASE = """\
schema_version = 1
title = "press"
seed = 1

[law]
name = "zunker2024"
psi_b = 0.5

[materials.powder]
youngs_modulus = "8.75 GPa"
poisson_ratio = 0.3
density = "1560 kg/m^3"
yield_stress = "150 MPa"
[materials.tool]
rigid = true

[contacts]
sliding_friction = 0.5
restitution = 0.5
work_of_adhesion = "300 J/m^2"
[[contacts.pairs]]
between = ["powder", "tool"]
sliding_friction = 0.1

[particles]
material = "powder"
count = 1000
radius = "150 um"

[die]
radius = "1.6 mm"
height = "8 mm"
material = "tool"

[engine]
gravity = [0, 0, -9.81]
time_step = "auto"

[[process]]
step = "fill"
[[process]]
step = "press"
to = "150 MPa"
at = "1 m/s"
[[process]]
step = "hold"
for = "0.1 ms"
[[process]]
step = "unload"
at = "1 m/s"

[output]
frames = 10
"""

PLANE = """
[walls.{name}]
kind = "plane"
point = {point}
normal = {normal}
material = "tool"
"""

MOVE = '\n[[process]]\nstep = "move"\n'


def plane(name, point, normal):
    return PLANE.format(name=name, point=point, normal=normal)


# name of the case, text in the file, text instead of it, words of the error
REPLACED = [
    # missing
    ("no law", '[law]\nname = "zunker2024"\npsi_b = 0.5\n', "", "law is missing"),
    ("no law name", 'name = "zunker2024"\n', "", "law.name"),
    ("no material", 'material = "powder"\n', "", "particles.material"),
    ("no modulus", 'youngs_modulus = "8.75 GPa"\n', "", "youngs_modulus is missing"),
    ("no density", 'density = "1560 kg/m^3"\n', "", "density of material"),
    ("no damping", "restitution = 0.5\n", "", "contacts.restitution"),
    ("no count", "count = 1000\n", "", "particles.count"),
    ("no radius", 'radius = "150 um"\n', "", "particles.radius"),
    ("no die height", 'height = "8 mm"\n', "", "die.height"),
    ("no target", 'to = "150 MPa"\n', "", "process.1.to"),
    ("no speed", 'at = "1 m/s"\n[[process]]\nstep = "hold"', "", "process.1.at"),
    ("no step", 'step = "fill"\n', "", "process.0.step"),
    ("no duration", 'for = "0.1 ms"\n', "", "process.2.for"),
    ("no fill", '[[process]]\nstep = "fill"\n', "", "no step fill"),
    # mistyped names
    ("key at the top", "seed = 1", "sead = 1", 'unknown key "sead"', '"seed"'),
    ("key of a law", "psi_b", "psib", 'unknown key "psib"', '"psi_b"'),
    ("key of a material", "youngs_mod", "young_mod", '"young_modulus"', ":10"),
    ("key of contacts", "restitution", "restituton", '"restituton"', ":19"),
    ("key of a pair", "between", "betwen", '"betwen"', '"between"'),
    ("key of particles", "count", "cuont", '"cuont"', '"count"'),
    ("key of the die", "height", "heigth", '"heigth"', '"height"'),
    ("key of the engine", "gravity", "gravty", '"gravty"', '"gravity"'),
    ("key of a step", 'to = "150', 'two = "150', '"two"', ':43  process.1.two'),
    ("key of the output", "frames", "frame", '"frame"', '"frames"'),
    ("key in a distribution", '"150 um"', '{ distribution = "normal", men = 1 }', '"men"'),
    ("a section", "[engine]", "[engin]", '"engin"', '"engine"'),
    ("name of a law", '"zunker2024"', '"zunker2042"', "zunker2042", "zunker2024"),
    ("name of a step", 'step = "press"', 'step = "pres"', '"pres"', '"press"'),
    ("name of a material", 'material = "tool"', 'material = "tol"', '"tol"', '"tool"'),
    ("name in a pair", '"powder", "tool"', '"powder", "tol"', '"tol"', "contacts.pairs.0"),
    ("name of a set", 'density = "1560 kg/m^3"', 'set = "avicel"', '"avicel"', "set"),
    # wrong type
    ("text for a number", "seed = 1", 'seed = "one"', 'seed = "one"', "whole number"),
    ("fraction of a count", "count = 1000", "count = 10.5", "count = 10.5"),
    ("true for a number", "count = 1000", "count = true", "count = true"),
    ("number for a text", 'title = "press"', "title = 5", "title = 5", "text"),
    ("number for a flag", "rigid = true", "rigid = 1", "rigid = 1", "true or false"),
    ("array for a number", '"8.75 GPa"', "[8.75e9]", "youngs_modulus = [", ":10"),
    ("date for a length", '"8 mm"', "2026-01-01", "height"),
    ("table for a length", '"8 mm"', "{ value = 8 }", "height"),
    ("value for a section", "[engine]", "engin = 1\n[engine]", "engin"),
    ("two numbers for gravity", "[0, 0, -9.81]", "[0, -9.81]", "gravity"),
    ("four numbers for gravity", "[0, 0, -9.81]", "[0, 0, 0, 1]", "gravity"),
    ("one name in a pair", '["powder", "tool"]', '["powder"]', "between"),
    ("text for a law option", "psi_b = 0.5", 'psi_b = "half"', 'psi_b = "half"'),
    # wrong unit
    ("length for a modulus", '"8.75 GPa"', '"8.75 mm"', '"8.75 mm" is a length'),
    ("stress for a speed", 'at = "1 m/s"', 'at = "1 MPa"', '"1 MPa" is a stress'),
    ("time for a target", 'to = "150 MPa"', 'to = "150 s"', "process.1.to"),
    ("target without a unit", 'to = "150 MPa"', "to = 150e6", "needs a unit"),
    ("unknown unit", '"8 mm"', '"8 furlongz"', "furlongz"),
    ("wrong case of a unit", '"8.75 GPa"', '"8.75 gpa"', "gpa", '"GPa"'),
    ("text without a unit", '"8 mm"', '"8"', 'height = "8"', "no unit"),
    ("words for a quantity", '"8 mm"', '"about 8 mm"', "about 8 mm"),
    ("an expression", '"8 mm"', "\"__import__('os').getcwd() m\"", "height"),
    ("a tower of powers", '"8 mm"', '"9**9**9**9 m"', "height = "),
    # out of range
    ("negative modulus", '"8.75 GPa"', '"-8.75 GPa"', '"-8.75 GPa"', "greater than 0"),
    ("zero radius", '"150 um"', '"0 um"', 'radius', "greater than 0"),
    ("Poisson ratio of a half", "ratio = 0.3", "ratio = 0.5", "poisson_ratio = 0.5"),
    ("negative friction", "friction = 0.5", "friction = -1", "sliding_friction = -1"),
    ("restitution above one", "restitution = 0.5", "restitution = 1.5", "= 1.5"),
    ("negative adhesion", '"300 J/m^2"', '"-3 J/m^2"', '"-3 J/m^2"'),
    ("negative density", '"1560 kg/m^3"', "-1560", "density = -1560"),
    ("count of zero", "count = 1000", "count = 0", "count = 0"),
    ("negative seed", "seed = 1", "seed = -1", "seed = -1"),
    ("negative speed", 'at = "1 m/s"', 'at = "-1 m/s"', '"-1 m/s"', ":44"),
    ("psi_b of two", "psi_b = 0.5", "psi_b = 2.0", "psi_b = 2"),
    ("no such schema", "version = 1", "version = 99", "schema_version = 99"),
    ("time step of zero", '"auto"', "0.0", "time_step"),
    ("frames of zero", "frames = 10", "frames = 0", "frames = 0"),
    ("not a number", '"8.75 GPa"', "nan", "youngs_modulus = nan"),
    ("infinite", '"8.75 GPa"', "inf", "youngs_modulus = inf"),
    ("infinite with a unit", '"8.75 GPa"', '"inf GPa"', '"inf GPa"'),
    ("huge number", '"8.75 GPa"', "1e300", "youngs_modulus = 1e+300"),
    ("beyond a float", '"8.75 GPa"', "1" + "0" * 400, "youngs_modulus"),
    ("beyond an integer", "seed = 1", "seed = 1" + "0" * 5000, "TOML"),
    ("huge count", "count = 1000", "count = 1e12", "count = 1000000000000"),
    ("huge time", '"0.1 ms"', '"1e30 s"', '"1e30 s"'),
    # contradictory
    ("yield above modulus", '"150 MPa"\n[mat', '"150 GPa"\n[mat', "yield_stress 1.5e+11"),
    ("two dampings", "restitution = 0.5", "restitution = 0.5\ndamping_ratio = 0.2", "both"),
    ("two adhesions", "[[con", "surface_energy = 1\n[[con", "two names", "surface_energy"),
    ("rigid with a modulus", "rigid = true", "rigid = true\nyoungs_modulus = 1e9", "rigid"),
    ("rigid with a set", "rigid = true", 'rigid = true\nset = "avicel_ph102_zunker2025"',
     "rigid"),
    ("rigid particles", 'material = "powder"', 'material = "tool"', "rigid"),
    ("count and file", "count = 1000", 'count = 1000\nfile = "a.csv"', "count and file"),
    ("radius and file", "count = 1000", 'file = "a.csv"', "radius"),
    ("two targets", 'to = "150 MPa"', 'to = "150 MPa"\nto_stress = 1e6', "to_stress"),
    ("a pair twice", "[particles]", '[[contacts.pairs]]\nbetween = ["tool", "powder"]\n'
     "[particles]", "twice"),
    ("overfull die", "count = 1000", "count = 100000", "count", "%"),
    ("particle above die", '"150 um"', '"2 mm"', "die radius 0.0016 m", "0.002 m"),
    ("diameter confused", '"150 um"', '{ distribution = "uniform", minimum = "3 um", '
     'maximum = "1 um" }', "mean", "minimum"),
    ("fill in the middle", 'step = "hold"\nfor = "0.1 ms"', 'step = "fill"', "fill"),
    ("crush before eject", 'step = "hold"\nfor = "0.1 ms"', 'step = "crush"\nat = 1',
     "crush", "eject"),
    ("no die", '[die]\nradius = "1.6 mm"\nheight = "8 mm"\nmaterial = "tool"\n', "",
     "die"),
    ("unknown wall", 'for = "0.1 ms"', 'for = "0.1 ms"\nwall = "uper_punch"',
     '"uper_punch"', '"upper_punch"'),
    ("cylinder driven", 'for = "0.1 ms"', 'for = "0.1 ms"\nwall = "die"', "cylinder"),
    ("deform without box", 'step = "hold"', 'step = "deform"\nstrain_rate = [1, 0, 0]',
     "deform", "box"),
    # TOML
    ("no quotes", '"8 mm"', "8 mm", "TOML", ":32"),
    ("key twice", "seed = 1", "seed = 1\nseed = 2", "TOML", ":4"),
    ("open bracket", "[engine]", "[engine", "TOML"),
    ("deep nesting", "seed = 1", "seed = " + "[" * 5000, "TOML"),
    ("deep table", "[engine]", "[" + ".".join("a" * 40) + "]\nx = 1\n[engine]", "nested"),
]  # fmt: skip

# name of the case, text added at the end, words of the error
ADDED = [
    ("planes too close", plane("a", [0, 0, 0], [1, 0, 0])
     + plane("b", [1e-4, 0, 0], [-1, 0, 0]), '"a"', '"b"', "0.0001 m"),
    ("planes face away", plane("a", [1e-4, 0, 0], [1, 0, 0])
     + plane("b", [0, 0, 0], [-1, 0, 0]), '"a"', '"b"', "-0.0001 m"),
    ("planes are the same", plane("a", [0, 0, 0], [1, 0, 0])
     + plane("b", [0, 1, 0], [2, 0, 0]), "same plane"),
    ("plane shuts the die", plane("a", [5, 0, 0], [1, 0, 0]), '"die"', "no room"),
    ("zero normal", plane("a", [0, 0, 0], [0, 0, 0]), "normal", "zero"),
    ("reserved wall name", plane("die", [0, 0, 0], [1, 0, 0]), "walls.die"),
    ("bad wall name", plane('"a b"', [0, 0, 0], [1, 0, 0]), "a b"),
    ("unknown kind of wall", plane("a", [0, 0, 0], [1, 0, 0]).replace('"plane"', '"plain"'),
     '"plain"', '"plane"'),
    ("cylinder upside down", '[walls.c]\nkind = "cylinder"\npoint = [0, 0, 0]\n'
     'radius = "1 m"\nbottom = "2 m"\ntop = "1 m"\nmaterial = "tool"\n', "top 1 m"),
    ("box smaller than a particle", "[box]\nlengths = [1, 1, 1e-4]\n", "0.0001 m"),
    ("box without period", "[box]\nlengths = [1, 1, 1]\n"
     "periodic = [false, false, false]\n", "periodic"),
    ("move without speed", MOVE + 'to = "1 mm"\n', "process.4.at"),
    ("move without target", MOVE + 'at = "1 m/s"\n', "process.4.to"),
    ("move of an unknown wall", MOVE + 'at = 1\nto = 1\nwalls = ["x"]\n', '"x"'),
    ("program not in order", MOVE + "program = [[1, 0], [0, 1]]\n", "program"),
    ("program of one row", MOVE + "program = [[0, 0]]\n", "program"),
    ("sine with a speed", MOVE + 'profile = "sine"\nto = 1\nduration = 1\nat = 1\n', "at"),
    ("unknown profile", MOVE + 'profile = "cosine"\nat = 1\nto = 1\n', '"cosine"'),
    ("servo without target", '\n[[process]]\nstep = "servo"\nwall = "upper_punch"\nfor = 1',
     "force"),
    ("two names alike", '\n[[process]]\nstep = "relax"\nname = "a"\nfor = 1\n'
     '[[process]]\nstep = "relax"\nname = "a"\nfor = 1\n', '"a"'),
]  # fmt: skip

WHOLE = [
    ("empty", b"", "is missing"),
    ("spaces", b"   \n\n", "is missing"),
    ("binary", bytes(range(256)) * 20, "not a text file"),
    ("null bytes", b"\x00" * 100, "TOML"),
    ("UTF-16", CASE.encode("utf-16"), "not a text file"),
    ("JSON", b'{"law": "hertz"}', "TOML"),
    ("five megabytes", b"# padding\n" * 500_000, "more than 4 MB"),
    ("list at the top", b'[[law]]\nname = "hertz"\n', "law"),
    ("values for sections", b"law = 1\nmaterials = 2\ncontacts = 3\nparticles = 4\n"
     b"process = 5\n", "materials = 2"),
]  # fmt: skip

SET = [
    ("law.psib=0.4", "law.psib", '"law.psi_b"'),
    ("nonsense=1", "nonsense"),
    ("radius=1", '"radius" means 2 keys'),
    ("law.psi_b", "not key=value"),
    ("law.psi_b=", "not key=value"),
    ("=3", "not key=value"),
    ("law.psi_b=[1, 2", "not TOML"),
    ("law.psi_b=-1", "psi_b = -1"),
    ("particles.radius=3 Pa", '"3 Pa" is a stress'),
    ("process.9.at=1", "process.9.at"),
    ("process.prss.at=1", "process.prss.at"),
    ("seed=1\nlaw=2", "TOML"),
]

PARTICLES = "id,radius_m,density_kg_m3,x_m,y_m,z_m\n"

PARTICLE_FILES = [
    ("missing", None, "a.csv", "does not exist"),
    ("empty", "", "id is missing"),
    ("no rows", PARTICLES, "no particles"),
    ("column missing", PARTICLES.replace("z_m", ""), "z_m is missing"),
    ("unknown column", "id,radius_m,density_kg_m3,x_m,y_m,z_m,w\n", '"w"'),
    ("short row", PARTICLES + "1,1e-4,1500,0,0\n", ":2", "5 values instead of 6"),
    ("words", PARTICLES + "1,small,1500,0,0,1e-3\n", 'radius_m = "small"', ":2"),
    ("negative radius", PARTICLES + "1,-1e-4,1500,0,0,1e-3\n", 'radius_m = "-1e-4"'),
    ("not a number", PARTICLES + "1,1e-4,1500,nan,0,1e-3\n", 'x_m = "nan"'),
    ("an id twice", PARTICLES + "7,1e-4,1500,0,0,1e-3\n" * 2, "id 7"),
    ("behind a wall", PARTICLES + "7,1e-4,1500,0,0,-1\n", "particle 7", "lower_punch"),
    ("outside the die", PARTICLES + "7,1e-4,1500,1,0,1e-3\n", "particle 7", '"die"'),
]
