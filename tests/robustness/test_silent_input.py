"""No input is without effect in silence, and no set of constants contradicts itself in silence:
every solver refuses it or warns of it by name. Each input stands for a kind; sizes are drawn by a
seed."""
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import zlib

BOLIDE = os.environ["BOLIDE"]
DRAW = random.Random(20)

SOLVERS = {
    "sph": "sph", "mpm": "mpm", "gas": "gas",
    "cfdmp": "{cfdmp: {region: {low: [0.3 m, 0 m], high: [0.6 m, 0.3 m]}, mpm: {cell: 10 mm}}}",
    "afdmp": "{afdmp: {region: {low: [0.36 m, 0 m], high: [0.6 m, 0.3 m]}, mpm: {cell: 10 mm}}}"}
AIR = "{material: air, density: 1.225 kg/m^3, pressure: 101.35 kPa, box: {from: %s, to: %s}}"
TNT = {"density": "1630 kg/m^3", "a": "371.2 GPa", "b": "3.231 GPa", "r1": "4.15", "r2": "0.95",
       "omega": "0.3", "energy": "7e9 J/m^3"}


def case(solver, burn="{programmed: {speed: 6930 m/s}}", at="[0 m, 0 m]", more="", **jwl):
    """A charge, in air with a plate beside it where the solver has room for them."""
    constants = ", ".join(f"{key}: {value}" for key, value in {**TNT, **jwl}.items())
    gas, coupled = solver == "gas", solver in ("cfdmp", "afdmp")
    text = f"""format: 1
dimension: 2
resolution: {'5 mm' if coupled else '10 mm'}
solver: {SOLVERS[solver]}
materials:
  explosive: {{eos: {{jwl: {{{constants}}}}}, burn: {burn}}}
"""
    if gas or coupled:
        text += "  air: {library: air}\n"
    if coupled:
        text += "  steel: {library: steel-1006}\n"
    text += "bodies:\n"
    replaces = ", replaces: air" if gas or coupled else ""
    if gas or coupled:
        text += f"  air: {AIR % ('[-0.2 m, 0 m]', '[0.6 m, 0.3 m]')}\n"
    text += (f"  charge: {{material: explosive{replaces}, "
             "box: {from: [-0.05 m, 0 m], to: [0.05 m, 0.05 m]}}\n")
    if coupled:
        text += ("  plate: {material: steel, replaces: air, "
                 "box: {from: [0.42 m, 0 m], to: [0.45 m, 0.15 m]}}\n")
    if gas or coupled:
        text += "domain: {low: [-0.2 m, 0 m], high: [0.6 m, 0.3 m]}\n"
    detonations = f"detonations: {{d: {{at: {at}}}}}\n" if at else ""
    return text + detonations + f"run: {{until: 20 us}}\n{more}"


def gas(more="", dimension=2, until="20 us", bodies=None):
    low, high = ("[0 m, 0 m]", "[1 m, 0.2 m]") if dimension == 2 else ("[0 m]", "[1 m]")
    if dimension == 3:
        low, high = "[0 m, 0 m, 0 m]", "[1 m, 0.2 m, 0.2 m]"
    bodies = bodies or f"{{air: {AIR % (low, high)}}}"
    return f"""format: 1
dimension: {dimension}
resolution: 10 mm
solver: gas
materials: {{air: {{library: air}}, tnt: {{library: tnt}}}}
bodies: {bodies}
run: {{until: {until}}}
{more}"""


def solid(solver, more="", geometry=""):
    return f"""format: 1
dimension: 2
{geometry}resolution: 10 mm
solver: {solver}
materials: {{al: {{library: aluminium}}}}
bodies: {{block: {{material: al, box: {{from: [0 m, 0 m], to: [0.1 m, 0.1 m]}}}}}}
run: {{until: 20 us}}
{more}"""


def png(indices, entries=2):
    """An image with a palette of grey ENTRIES, one row of 8-bit pixels."""
    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data +
                struct.pack(">I", zlib.crc32(name + data)))
    palette = b"".join(bytes([200 * k // max(entries - 1, 1)] * 3) for k in range(entries))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(indices), 1, 8, 3, 0,
                                                               0, 0)) +
            chunk(b"PLTE", palette) + chunk(b"IDAT", zlib.compress(b"\0" + bytes(indices))) +
            chunk(b"IEND", b""))


def cube(corner, size):
    """The triangles of a cube, normals outward."""
    x, y, z = corner
    point = [(x + size * (k & 1), y + size * (k >> 1 & 1), z + size * (k >> 2)) for k in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [[point[i] for i in corners] for a, b, c, d in faces
            for corners in ((a, b, c), (a, c, d))]


def stl(triangles):
    facets = ("facet normal 0 0 0\nouter loop\n" +
              "".join("vertex %.9g %.9g %.9g\n" % p for p in t) + "endloop\nendfacet\n"
              for t in triangles)
    return ("solid s\n" + "".join(facets) + "endsolid s\n").encode()


BLAST = """format: 1
dimension: 1
geometry: %s
resolution: 5 mm
solver: gas
materials: {air: {library: air}, tnt: {library: tnt}}
bodies:
  air: {material: air, density: 1.225 kg/m^3, pressure: 101.35 kPa, box: {from: [0 m], to: [1 m]}}
  charge: {material: tnt, replaces: air, box: {from: [0 m], to: [0.05 m]}}
detonations: {d: {at: [0 m]}}
run: {until: 30 us}
"""
FILES = {
    "blast.yaml": (BLAST % "cylindrical").encode(), "ball.yaml": (BLAST % "spherical").encode(),
    "missing.png": png([0, 1, 2, 1]), "far.png": png([0, 1, 255, 1], 3),
    "cubes.stl": stl(cube((0, 0, 0), 1) + cube((0.5, 0.5, 0), 1)),
    "start-b.yaml": gas("start: {from: start-a.yaml, material: tnt}\n").encode(),
    "start-a.yaml": gas("start: {from: start-b.yaml, material: tnt}\n").encode(),
    "start-3.yaml": gas("start: {from: start-1.yaml, material: tnt}\n").encode(),
    "start-2.yaml": gas("start: {from: start-3.yaml, material: tnt}\n").encode(),
    "start-1.yaml": gas("start: {from: start-2.yaml, material: tnt}\n").encode(),
    "self.yaml": gas("start: {from: self.yaml, material: tnt}\n").encode()}


def inputs():
    """Name, text or file of the case, and the words that must come."""
    far, late = DRAW.uniform(0.5, 50), DRAW.uniform(30, 300)
    for solver in SOLVERS:
        place = 0.2 if solver == "afdmp" else far  # it has room for the products of a short burn
        yield f"ignition at {place:.3g} m, {solver}", case(solver, at=f"[{place} m, 0 m]"), (
            r"detonations\.d: it is [\d.]+ m outside the nearest explosive, \"charge\"")
        yield f"ignition late, {solver}", case(solver).replace(
            "{at: [0 m, 0 m]}", f"{{at: [0 m, 0 m], time: {late} us}}"), "it ignites nothing"
        yield f"ignition absurdly far, {solver}", case(solver, at="[1e155 m, 0 m]"), (
            r"expected a place within 1e\+09 m")
        yield f"no ignition, {solver}", case(solver, at=""), "nothing ignites this explosive"
        yield f"R1 and R2 exchanged, {solver}", case(solver, r1="0.95", r2="4.15"), (
            "Chapman and Jouguet|detonation speed of")
        yield f"A negative, {solver}", case(solver, a="-371 GPa"), "Chapman and Jouguet"
        yield f"B negative, {solver}", case(solver, b="-3.2 GPa"), (
            "no negative constants|gases that never pull|both must be gases")
        yield f"D too low, {solver}", case(solver, burn="{programmed: {speed: 1 km/s}}"), (
            "detonation speed of 1000 m/s")
    for solver in ("sph", "mpm"):
        yield f"p_CJ absurd, {solver}", case(
            solver, burn="{beta: {speed: 6930 m/s, pressure: 1e15 Pa}}"), "Chapman-Jouguet pressure"
        yield f"gauge behind a wall, {solver}", solid(
            solver, "boundaries: {w: {kind: reflecting, axis: x, at: -20 mm, side: low}}\n"
            f"probes: {{g: {{gauge: {{at: [-{DRAW.uniform(0.1, 9)} m, 0 m]}}}}}}\n"), (
                "outside the wall, axis or periodic face at x = -0.02 m")
        yield f"gauge behind the axis, {solver}", solid(
            solver, "probes: {g: {gauge: {at: [-0.1 m, 0 m]}}}\n", "geometry: axisymmetric\n"), (
                "outside the wall, axis or periodic face at x = 0 m")
        yield f"palette, {solver}", solid(solver).replace(
            "box: {from: [0 m, 0 m], to: [0.1 m, 0.1 m]}",
            "image: {file: missing.png, pixel: 20 mm, grey: [0, 255]}"), "its palette lacks"
    yield "palette of a gas", gas(bodies="{air: {material: air, pressure: 1 bar, image: "
                                  "{file: far.png, pixel: 20 mm, grey: [0, 255]}}}"), (
                                      "its palette lacks")
    gauge = "probes: {g: {gauge: {at: [%s]}}}\n"
    block = "boundaries: {block: {kind: rigid-body, part: {box: {from: [0.5 m, -0.1 m], to: [0.7 m, 0.3 m]}}}}\n"
    yield "gauge off the grid", gas(gauge % "1.5 m, 0.1 m"), "outside the domain, which goes from"
    yield "gauge off the grid, 1-D", gas(gauge % "-0.2 m", 1), "outside the domain, which goes from"
    yield "gauge in an obstacle", gas(block + gauge % "0.6 m, 0.1 m"), "in the rigid body \"block\""
    yield "gauge too small", gas(
        "probes: {g: {gauge: {at: [0.5 m, 0.1 m], radius: 1 mm}}}\n"), "centre within 0.001 m"
    yield "gauge off the grid, cfdmp", case("cfdmp", more="probes: {g: {gauge: {at: [3 m, 0 m]}, "
                                            "of: gas}}\n"), "outside the domain, which goes from"
    thin = DRAW.uniform(0.5, 9)
    far_side = 0.2 + 1e-3 * thin
    plate = f"obstacles: {{plate: {{box: {{from: [0.2 m, %s], to: [{far_side} m, %s]}}}}}}\n"
    for dimension, low, high in ((2, "-0.1 m", "0.3 m"), (3, "-0.1 m, -1 m", "0.3 m, 1 m")):
        yield f"thin obstacle, {dimension}-D", gas(plate % (low, high), dimension), (
            r"boundaries\.plate: [\d.]+ m thick along x, thinner than a cell of 0\.01 m")
    yield "thin obstacle, 1-D", gas(plate.replace(", %s", "") , 1), "thinner than a cell"
    tilted = ("obstacles: {plate: {polygon: {points: [[0.3 m, -1 m], [0.305 m, -1 m], "
              "[0.905 m, 1 m], [0.9 m, 1 m]]}}}\n")
    yield "thin obstacle, tilted", gas(tilted), "thinner than a cell"
    yield "thin obstacle beside a thick one", gas(
        "obstacles: {plate: {union: [{box: {from: [0.2 m, -1 m], to: [0.3 m, 0.1 m]}}, "
        "{box: {from: [0.242 m, 0.1 m], to: [0.244 m, 1 m]}}]}}\n"), "thinner than a cell"
    yield "obstacle outside", gas(
        "obstacles: {o: {box: {from: [2 m, 0 m], to: [3 m, 1 m]}}}\n"), "it blocks nothing"
    yield "obstacle between centres", gas(
        "obstacles: {o: {ball: {center: [0.5 m, 0.1 m], radius: 3 mm}}}\n"), (
            "it blocks nothing|thinner than a cell")
    for solver, words in (("cfdmp", "thinner than a cell"), ("afdmp", "no rigid-body boundaries")):
        yield f"thin obstacle, {solver}", case(
            solver, more="obstacles: {plate: {box: {from: [-0.184 m, 0 m], "
            "to: [-0.181 m, 0.3 m]}}}\n"), words
    yield "gap between gases", gas(
        dimension=1, bodies=f"{{l: {AIR % ('[0 m]', '[0.4 m]')}, r: {AIR % ('[0.7 m]', '[1 m]')}}}"
    ), "no body fills the domain here"
    yield "gap between gases, 2-D", gas(
        bodies=f"{{l: {AIR % ('[0 m, 0 m]', '[0.4 m, 0.2 m]')}, "
        f"r: {AIR % ('[0.45 m, 0 m]', '[1 m, 0.2 m]')}}}"), "no body fills the domain here"
    inflow = ("boundaries: {in: {axis: x, side: low, kind: inflow, density: 1.2 kg/m^3, "
              "pressure: 1 bar, velocity: [%s, 0 m/s]}}\n")
    yield "inflow not a number", gas(inflow % "100 m/s*sqrt(0.1 - y/(1 m))"), (
        r"boundaries\.in.*not finite")
    yield "overlapping surfaces of a mesh", """format: 1
dimension: 3
resolution: 0.1 m
solver: sph
materials: {al: {library: aluminium}}
bodies: {part: {material: al, mesh: {file: cubes.stl, unit: 1 m}}}
run: {until: 1 us}
""", r"1750 particles, 4725 kg"
    start = "start: {from: %s, material: tnt%s}\n"
    yield "start from itself", "self.yaml", r"cannot start from itself.*self\.yaml -> .*self\.yaml"
    yield "two that start from each other", "start-a.yaml", "start-a.yaml -> .*b.yaml -> .*a.yaml"
    yield "three that start from each other", "start-1.yaml", "1.yaml -> .*2.yaml -> .*3.yaml -> "
    yield "centre outside", gas(start % ("blast.yaml", ", center: [-3 m, 0 m]")), (
        r"start\.center: the centre of the blast, x = -3 m, is outside the domain")
    yield "wrong material of a start", gas(start.replace("tnt", "air") % ("blast.yaml", "")), (
        "that case has two materials")
    yield "start too late", gas(start % ("blast.yaml", ", center: [0.5 m, 0.1 m], at: 300 us")), (
        "which the domain does not hold")
    yield "start of another shape", gas(start % ("ball.yaml", "")), "needs `geometry: cylindrical`"


def main():
    for name, data in FILES.items():
        pathlib.Path(name).write_bytes(data)
    status = count = 0
    for name, text, words in inputs():
        path = pathlib.Path(text if text in FILES else "input.yaml")
        if text not in FILES:
            path.write_text(text)
        ran = subprocess.run([BOLIDE, "check", str(path)], capture_output=True, text=True,
                             check=False, timeout=300)
        said = ran.stdout + ran.stderr
        count += 1
        if ran.returncode not in (0, 2) or not re.search(words, said):
            print(f"FAILED: {name}: exit status {ran.returncode}, wanted {words!r} in\n{said}")
            status = 1
        elif ran.returncode == 0 and "warning: " not in said and "mesh" not in name:
            print(f"FAILED: {name}: no warning:\n{said}")
            status = 1
    if count < 60:
        print(f"FAILED: {count} inputs, fewer than 60")
        status = 1
    print(f"{count} inputs")
    return status


sys.exit(main())
