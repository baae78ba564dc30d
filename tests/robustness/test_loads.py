"""Loads arrive, or the program says that they do not: the impulse that a blast gives to plates beside
an integral of its pressure over their faces that is computed here, and loads without effect.

Without arguments a few cases. `test_loads.py --campaign [SEED] [COUNT]` draws COUNT (24) plates by
SEED (1): charge, angle, thickness, geometry, motion, solver, with 20 and with 80 particles an edge."""
import csv
import itertools
import math
import os
import pathlib
import random
import re
import subprocess
import sys

import numpy

SOURCE = pathlib.Path(os.environ["BOLIDE_SOURCE_DIR"])
BOLIDE = os.environ["BOLIDE"]


def read_curves():
    """{(charge, quantity): [(nearest, farthest, a, b, coefficients)]} as the program has them."""
    text = (SOURCE / "src/exact/kingery_curves.c").read_text()
    curves = {}
    for match in re.finditer(r"\{KINGERY_(FREE_AIR|SURFACE),\s*KINGERY_(\w+),([^{]*)\{([^}]*)\}\}", text):
        numbers = [float(word) for word in match[3].split(",") if word.strip()]
        terms = [float(word) for word in match[4].split(",")]
        curves.setdefault((match[1], match[2]), []).append((*numbers[:4], terms))
    return curves


CURVES = read_curves()


def curve(quantity, z):
    value = numpy.full_like(z, numpy.nan)
    for nearest, farthest, a, b, terms in CURVES["FREE_AIR", quantity]:
        within = (z >= nearest) & (z <= farthest) & numpy.isnan(value)
        u = a + b * numpy.log10(z[within])
        value[within] = 10.0 ** numpy.polynomial.polynomial.polyval(u, terms)
    return value


def decay(fraction):
    """b of 1/b - (1 - exp(-b))/b^2 = FRACTION, by bisection."""
    low, high = numpy.full_like(fraction, 1e-9), numpy.full_like(fraction, 1e4)
    for _ in range(100):
        b = 0.5 * (low + high)
        more = 1.0 / b + numpy.expm1(-b) / b**2 > fraction
        low, high = numpy.where(more, b, low), numpy.where(more, high, b)
    return 0.5 * (low + high)


class Waves:
    """The pressure on a rigid surface by a charge of MASS, in the positive phase, from tables over the
    logarithm of the distance."""

    def __init__(self, mass):
        size = mass ** (1.0 / 3.0)
        z = numpy.exp(numpy.linspace(math.log(0.16), math.log(39.9), 4000))
        self.log_distance = numpy.log(z * size)
        self.arrival = 1e-3 * size * curve("ARRIVAL", z)
        self.duration = 1e-3 * size * curve("DURATION", z)
        self.peak = [1e3 * curve(name, z) for name in ("PRESSURE", "REFLECTED_PRESSURE")]
        impulse = [size * curve(name, z) for name in ("IMPULSE", "REFLECTED_IMPULSE")]
        self.decay = [decay(i / (p * self.duration)) for i, p in zip(impulse, self.peak)]

    def at(self, table, distance):
        return numpy.interp(numpy.log(distance), self.log_distance, table)

    def pressure(self, distance, cosine, time):
        since = time - self.at(self.arrival, distance)
        part = since / self.at(self.duration, distance)
        total = numpy.zeros_like(distance)
        for peak, b, factor in zip(self.peak, self.decay, (1.0 + cosine**2 - 2.0 * cosine, cosine**2)):
            total += factor * self.at(peak, distance) * (1.0 - part) * numpy.exp(-self.at(b, distance) * part)
        return numpy.where((cosine > 0.0) & (since >= 0.0) & (part < 1.0), total, 0.0)


class Plate:
    """A box L wide and T thick, turned by ANGLE about the middle of its loaded face at the origin; the
    charge is at (0, R), in 3-D at (0, R, 0). About an axis it is the half at x > 0, a cone."""

    def __init__(self, geometry, angle, edge, thick, mass, distance, flying):
        self.geometry, self.angle, self.edge, self.thick = geometry, math.radians(angle), edge, thick
        self.mass, self.distance, self.flying = mass, distance, flying
        self.density = 2700.0 if flying else 2.7e6

    def points(self, n=100):
        """Places, normals and areas of pieces of the faces in the plane; their width across it."""
        half, c, s = 0.5 * self.edge, math.cos(self.angle), math.sin(self.angle)
        low = 0.0 if self.geometry == "axisymmetric" and self.angle == 0.0 else -half
        middle = (numpy.arange(n) + 0.5) / n
        faces = [((low + (half - low) * middle, 0 * middle), (0, 1), (half - low) / n),
                 ((low + (half - low) * middle, 0 * middle - self.thick), (0, -1), (half - low) / n),
                 ((0 * middle + half, -self.thick * middle), (1, 0), self.thick / n),
                 ((0 * middle - half, -self.thick * middle), (-1, 0), self.thick / n)]
        x, y, nx, ny, area = [], [], [], [], []
        for (u, v), (nu, nv), size in faces:
            x.append(c * u - s * v), y.append(s * u + c * v)
            nx.append(0 * u + c * nu - s * nv), ny.append(0 * u + s * nu + c * nv)
            area.append(0 * u + size)
        x, y, nx, ny, area = map(numpy.concatenate, (x, y, nx, ny, area))
        if self.geometry == "axisymmetric":
            keep = x > 0.0
            x, y, nx, ny, area = x[keep], y[keep], nx[keep], ny[keep], (area * x)[keep]
        return x, y, nx, ny, area

    def body_mass(self):
        x, y, nx, ny, area = self.points()
        flux = nx * x * area + ny * y * area  # twice the area, three times the volume a radian
        if self.geometry == "axisymmetric":
            return self.density * flux.sum() / 3.0
        return self.density * flux.sum() / 2.0 * (self.edge if self.geometry == "3-D" else 1.0)

    def impulse(self, until, steps=1200):
        """Of the rigid plate, free to move in x and y and to turn, about an axis in y."""
        x, y, nx, ny, area = self.points()
        across, mass = numpy.zeros(1), self.body_mass()
        if self.geometry == "3-D":
            across = self.edge * ((numpy.arange(8) + 0.5) / 16)  # half of it
            area = area * self.edge / 8
        # about its middle
        middle = 0.5 * self.thick * numpy.array([math.sin(self.angle), -math.cos(self.angle)])
        inertia = mass * (self.edge**2 + self.thick**2) / 12.0
        place, velocity, turn, spin, total = middle.copy(), numpy.zeros(2), 0.0, 0.0, numpy.zeros(2)
        x, y = x - middle[0], y - middle[1]
        waves = Waves(self.mass)
        nearest = numpy.hypot(x + middle[0], self.distance - y - middle[1]).min() * 0.98
        start = waves.at(waves.arrival, nearest)
        dt = (until - start) / steps
        for step in range(steps):
            c, s = math.cos(turn), math.sin(turn)
            rx, ry, mx, my = c * x - s * y, s * x + c * y, c * nx - s * ny, s * nx + c * ny
            force, torque = numpy.zeros(2), 0.0
            dx, dy = -(rx + place[0]), self.distance - (ry + place[1])
            for z in across:
                way = numpy.sqrt(dx**2 + dy**2 + z**2)
                p = area * waves.pressure(way, (dx * mx + dy * my) / way, start + (step + 0.5) * dt)
                force -= numpy.array([(p * mx).sum(), (p * my).sum()])
                torque -= (p * (rx * my - ry * mx)).sum()
            total += dt * force
            if self.geometry == "axisymmetric":
                force[0], torque = 0.0, 0.0
            velocity, spin = velocity + dt * force / mass, spin + dt * torque / inertia
            place, turn = place + dt * velocity, turn + dt * spin
        return total

    def until(self):
        size = self.mass ** (1.0 / 3.0)
        x, y, *_ = self.points()
        far = numpy.hypot(x, self.distance - y).max() * (1.4 if self.flying else 1.05)
        far = math.hypot(far, 0.5 * self.edge if self.geometry == "3-D" else 0.0) / size
        return float(1e-3 * size * (curve("ARRIVAL", numpy.array([far])) +
                                    curve("DURATION", numpy.array([far])))[0])

    def case(self, particles, until, solver, extra=""):
        half, solid = 0.5 * self.edge, self.geometry == "3-D"
        low = 0.0 if self.geometry == "axisymmetric" and self.angle == 0.0 else -half
        corners = [[low, -self.thick, -half], [half, 0.0, half]]
        texts = ["[" + ", ".join(f"{x:.12g} m" for x in corner[:3 if solid else 2]) + "]" for corner in corners]
        shape = f"box: {{from: {texts[0]}, to: {texts[1]}}}"
        zero = "[0 m, 0 m, 0 m]" if solid else "[0 m, 0 m]"
        if self.angle:
            shape = (f"rotate: {{shape: {{{shape}}}, angle: {math.degrees(self.angle):.12g} deg, about: {zero}"
                     f"{', axis: z' if solid else ''}}}")
        modulus = self.density * 500.0**2
        charge = f"[0 m, {self.distance:.12g} m{', 0 m' if solid else ''}]"
        return f"""format: 1
dimension: {3 if self.geometry == "3-D" else 2}
{"geometry: axisymmetric" if self.geometry == "axisymmetric" else ""}
resolution: {self.edge / particles:.12g} m
solver: {solver}
materials:
  metal:
    eos: {{mie-grueneisen: {{density: {self.density:.12g} kg/m^3, sound: 500 m/s, slope: 1.3, gamma: 2, bulk_modulus: {modulus:.12g} Pa}}}}
    strength: {{perfect-plastic: {{shear_modulus: {0.4 * modulus:.12g} Pa, yield: {modulus:.12g} Pa}}}}
bodies: {{plate: {{material: metal, {shape}}}}}
loads: {{b: {{on: plate, blast: {{mass: {self.mass:.12g} kg, at: {charge}}}{extra}}}}}
run: {{until: {until:.12g} s}}
output: {{pictures: []}}
"""


def run(name, text, *words):
    pathlib.Path(f"{name}.yaml").write_text(text)
    result = subprocess.run([BOLIDE, "run", f"{name}.yaml", "--output", name, "--overwrite", "--threads", "1", *words],
                            text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    rows = []
    if pathlib.Path(name, "history.csv").exists():
        with open(pathlib.Path(name, "history.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
    return result.returncode, result.stdout, rows


def columns(row, head):
    return numpy.array([float(value) for key, value in row.items() if key.startswith(head)])


def judge_plate(name, plate, particles, solver, within, extra=""):
    """None, or what is wrong."""
    until = plate.until()
    code, said, rows = run(name, plate.case(particles, until, solver, extra))
    if code or not rows:
        return f"{name}: {said}"
    delivered = columns(rows[-1], "load.b.delivered.")[:2]
    expected = columns(rows[-1], "load.b.expected.")[:2]
    wanted = plate.impulse(until)
    apart = numpy.linalg.norm(delivered - wanted) / numpy.linalg.norm(wanted)
    own = numpy.linalg.norm(delivered - expected) / numpy.linalg.norm(wanted)
    print(f"{name}: {100 * apart:.2f} % from the integral, {100 * own:.2f} % from its own", flush=True)
    if apart > within or own > 0.03 or "load \"b\"" in said:
        return f"{name}: delivered {delivered}, wanted {wanted}, own {expected}\n{said}"
    return None


def campaign(seed, count):
    chance = random.Random(seed)
    faults = []
    kinds = list(itertools.product(("2-D", "axisymmetric", "3-D"), (0, 30, 60), (False, True), (True, False)))
    chance.shuffle(kinds)
    for k in range(count):
        geometry, angle, flying, thin = kinds[k % len(kinds)]
        for particles in (20,) if geometry == "3-D" and k % 6 else (20, 80):
            edge, mass = chance.uniform(0.1, 1.0), 10.0 ** chance.uniform(-2, 1)
            distance = mass ** (1.0 / 3.0) * chance.uniform(1.0, 4.0) + edge
            layers = chance.choice((2, 3, 4, 6)) if thin else 5 if geometry == "3-D" else particles // 4
            plate = Plate(geometry, angle, edge, layers * edge / particles, mass, distance, flying)
            solver = "mpm" if chance.random() < 0.8 else "sph"
            name = f"{k}-{geometry}-{angle}-{'flying' if flying else 'fixed'}-{layers}-{solver}-{particles}"
            fault = judge_plate(name, plate, particles, solver, 0.02 if particles == 20 else 0.01)
            faults += [fault] if fault else []
    return faults


FLAT = """format: 1
dimension: 2
{geometry}
resolution: 2 mm
solver: {solver}
materials:
  metal:
    eos: {{mie-grueneisen: {{density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.3, gamma: 2, bulk_modulus: 73 GPa}}}}
    strength: {{perfect-plastic: {{shear_modulus: 23 GPa, yield: 0.3 GPa}}}}
bodies: {{plate: {{material: metal, box: {{from: [0 mm, -10 mm], to: [60 mm, 0 mm]}}}}}}
loads: {{b: {{on: plate, {load}}}}}
run: {{until: {until}}}
output: {{pictures: []}}
"""
CHARGE = "blast: {mass: 0.1 kg, at: [0 m, 0.3 m], time: -0.15 ms}"
# what the load is, when the run ends, what a check and a run must say
WITHOUT_EFFECT = [
    (f"axis: y, between: [1 m, 2 m], {CHARGE}", "0.1 ms", "it does nothing: `between` is from 1 m to 2 m"),
    ("axis: y, between: [1 m, 2 m], pressure: 1 MPa", "2 us", "it does nothing: `between`"),
    (f"axis: y, side: low, {CHARGE}", "0.1 ms", "faces away from the charge"),
    (f"axis: y, between: [-11 mm, -9 mm], side: low, {CHARGE}", "0.1 ms", "faces away from the charge"),
    (f"after: 1 s, {CHARGE}", "0.1 ms", "it starts at 1 s, and the run ends at 0.0001 s"),
    ("after: 1 s, pressure: 1 MPa", "2 us", "it starts at 1 s"),
    ("blast: {mass: 0.1 kg, at: [0 m, 0.3 m], time: 1 ms}", "0.1 ms", "after the end at"),
    ("blast: {mass: 0.1 kg, at: [0 m, 0.3 m], time: -9 ms}", "0.1 ms", "before the load starts"),
    ("axis: y, between: [-20 mm, 20 mm], traction: [0 Pa, -1 MPa]", "2 us", "holds both faces"),
]


def judge_without_effect():
    faults = []
    for k, (load, until, words) in enumerate(WITHOUT_EFFECT):
        for solver, geometry in (("mpm", ""), ("sph", ""), ("mpm", "geometry: axisymmetric")):
            name = f"nothing-{k}"
            text = FLAT.format(load=load, until=until, solver=solver, geometry=geometry)
            code, said, _ = run(name, text)
            checked = subprocess.run([BOLIDE, "check", f"{name}.yaml"], text=True, stdout=subprocess.PIPE).stdout
            page = pathlib.Path(name, "report.html")
            told = said.count(words) >= 2 and page.exists() and words.replace("'", "&#39;") in page.read_text()
            if code or words not in checked or not told:
                faults.append(f"{load} with {solver} {geometry}: check, run, verdict or report does not say "
                              f"\"{words}\":\n{checked}\n{said}")
    return faults


def judge_windows():
    """`between` around both faces, and a plate that leaves it, change nothing."""
    faults, impulse = [], {}
    for name, extra, density in (("open", "", 2700.0), ("both", ", axis: y, between: [-1 m, 1 m]", 2700.0),
                                 ("leaves", ", axis: y, between: [-2 mm, 2 mm]", 2700.0)):
        plate = Plate("axisymmetric", 0, 0.2, 0.01, 0.05, 0.35, True)
        plate.density = density
        fault = judge_plate(name, plate, 40, "mpm", 0.02, extra)
        faults += [fault] if fault else []
    return faults


BURST = """
format: 1
dimension: 2
geometry: axisymmetric
resolution: 5 mm
solver: gas
materials: {air: {eos: {ideal-gas: {density: 1 kg/m^3, gamma: 1.4}}}}
bodies:
  air: {material: air, pressure: 1 bar, box: {from: [0 m, 0 m], to: [0.3 m, 0.3 m]}}
  hot: {material: air, replaces: air, density: 50 kg/m^3, pressure: 500 bar, ball: {center: [0 m, 60 mm], radius: 30 mm}}
boundaries: {plane: {kind: reflecting, axis: y, at: 0 m, side: low}}
run: {until: 0.2 ms}
probes:
  plane: {line: {from: [2.5 mm, 2.5 mm], to: [297.5 mm, 2.5 mm], points: 60}, fields: [pressure]}
"""

STRUCK = """
format: 1
dimension: {dimension}
resolution: 2.5 mm
solver: {solver}
{geometry}
materials: {{metal: {{library: aluminium}}}}
bodies: {{plate: {{material: metal, {shape}}}}}
loads:
  burst: {{on: plate, axis: {axis}, side: high, record: {{from: burst.yaml, probe: plane, time: 10 us{center}}}}}
run: {{until: 0.25 ms}}
"""


def judge_records():
    """The impulse that a record gives to a round plate beside an integral of the recorded pressure."""
    faults, radius = [], 0.1
    pathlib.Path("burst.yaml").write_text(BURST)
    code, said, folder = run("burst-alone", BURST)
    if code:
        return [f"the gas alone: {said}"]
    rows = list(csv.reader(open("burst-alone/probes/plane.csv")))
    table = numpy.array([[float(word) for word in row] for row in rows[1:]])
    impulse = numpy.trapezoid if hasattr(numpy, "trapezoid") else numpy.trapz
    over = [impulse(column - column[0], table[:, 0]) for column in table[:, 1:].T]
    r = numpy.linspace(0.0, radius, 2001)
    wanted = impulse(numpy.interp(r, numpy.linspace(0.0, 0.295, 60), over) * r, r) * 2.0 * math.pi
    for solver, dimension, geometry, factor, axis, shape, center in (
            ("mpm", 2, "geometry: axisymmetric", 2.0 * math.pi, "y",
             "box: {from: [0 m, -10 mm], to: [100 mm, 0 m]}", ""),
            ("sph", 2, "geometry: axisymmetric", 2.0 * math.pi, "y",
             "box: {from: [0 m, -10 mm], to: [100 mm, 0 m]}", ""),
            ("mpm", 3, "", 1.0, "x",
             "cylinder: {from: [-10 mm, 0.5 m, 0 m], to: [0 m, 0.5 m, 0 m], radius: 100 mm}",
             ", center: [0 m, 0.5 m, 0 m]")):
        name = f"struck-{solver}-{dimension}"
        text = STRUCK.format(solver=solver, dimension=dimension, geometry=geometry, axis=axis, shape=shape,
                             center=center)
        code, said, folder = run(name, text, "--set", "resolution=5 mm") if dimension == 3 else run(name, text)
        found = re.search(r"load burst: impulse delivered \(([^)]*)\)", said)
        given = abs(float(found[1].split(",")["xyz".index(axis)])) * factor if found else 0.0
        if code or abs(given / wanted - 1.0) > 0.03:
            faults.append(f"{name}: {given:.4g} N s where the record has {wanted:.4g} N s\n{said}")
    return faults


def main():
    if sys.argv[1:2] == ["--campaign"]:
        faults = campaign(int((sys.argv + ["1"])[2]) if len(sys.argv) > 2 else 1,
                          int(sys.argv[3]) if len(sys.argv) > 3 else 24)
    else:
        faults = judge_without_effect() + judge_windows() + judge_records()
        for geometry, angle, flying, layers, solver in (
                ("2-D", 30, False, 3, "mpm"), ("2-D", 60, True, 5, "mpm"), ("axisymmetric", 0, True, 2, "mpm"),
                ("axisymmetric", 30, False, 4, "mpm"), ("3-D", 30, False, 3, "mpm"), ("2-D", 0, True, 4, "sph"),
                ("2-D", 30, False, 4, "sph"), ("axisymmetric", 0, True, 4, "sph")):
            plate = Plate(geometry, angle, 0.2, layers * 0.01, 1.0, 1.2, flying)
            fault = judge_plate(f"{geometry}-{angle}-{layers}-{solver}", plate, 20, solver, 0.02)
            faults += [fault] if fault else []
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
