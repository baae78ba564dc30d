"""Bodies that start apart act on each other when their surfaces meet, and then as if they had started
in contact: plates, discs and spheres of aluminium at 1 m/s to 3 km/s across gaps of 0.5 to 8 spacings,
with a contact law and without, with both solvers.

Without arguments a few cases. `test_touch.py --campaign [SEED] [COUNT]` draws COUNT (40) by SEED (1):
shape, solver, law, speed, gap. A list of words KEY=VALUE runs that case."""
import csv
import math
import os
import pathlib
import random
import subprocess
import sys

BOLIDE = os.environ["BOLIDE"]

SPACING, SOUND = 0.5e-3, 5300.0
# Of the speed that a run without a gap reaches, by shape. Two are regression bounds: that of oblique
# faces, 30 degrees to the lattice, and that of flat faces with MPM, which differ by 2.5 % at 1 km/s.
LIMITS = {"line": 0.01, "flat": 0.02, "disc": 0.02, "ball": 0.02, "shifted": 0.03, "finer": 0.03,
          "oblique": 0.08}
FLAT_MPM = 0.03
ANGLE = math.radians(30.0)
STANDARD = {"shape": "flat", "solver": "sph", "law": "yes", "speed": 10.0, "gap": 2.0, "size": 10}


def place(*corner):
    return "[" + ", ".join(f"{x:.9g} m" for x in corner) + "]"


def box(low, high):
    return f"box: {{from: {place(*low)}, to: {place(*high)}}}"


def bodies(case, apart):
    """The shapes of both and the dimension: SIZE spacings long."""
    length, shape = case["size"] * SPACING, case["shape"]
    begin = length + apart
    if shape == "line":
        return box([0], [length]), box([begin], [begin + length]), 1
    if shape in ("disc", "ball"):
        rest = [0.0] * (1 if shape == "disc" else 2)
        first, second = (f"ball: {{center: {place(x, *rest)}, radius: {length / 2:.9g} m}}"
                         for x in (0.0, begin))
        return first, second, 1 + len(rest)
    side = SPACING / 2 if shape == "shifted" else 0.0
    both = box([0, 0], [length, length]), box([begin, side], [begin + length, side + length])
    if shape == "oblique":
        both = (f"rotate: {{shape: {{{of}}}, angle: 30 deg}}" for of in both)
    return *both, 2


def text_of(case, gap, cycles):
    """For the time that a plate takes across GAP, and CYCLES of waves through both."""
    apart = gap * SPACING
    flyer, target, dimension = bodies(case, apart)
    angle = ANGLE if case["shape"] == "oblique" else 0.0
    along, across = case["speed"] * math.cos(angle), case["speed"] * math.sin(angle)
    velocity = f"[{along} m/s" + f", {across} m/s" * (dimension > 1) + ", 0 m/s" * (dimension > 2) + "]"
    until = apart / case["speed"] + cycles * 2 * case["size"] * SPACING / SOUND
    law = "contacts: {face: {between: [flyer, target], shear: slip, tension: none}}\n"
    finer = f", resolution: {SPACING / 1.25} m" if case["shape"] == "finer" else ""
    return (f"format: 1\ndimension: {dimension}\nresolution: {SPACING} m\nsolver: {case['solver']}\n"
            f"materials: {{m: {{library: aluminium}}}}\nrun: {{until: {until:.9g} s}}\n"
            f"output: {{snapshots: no}}\nprobes: {{target: {{body: target}}, flyer: {{body: flyer}}}}\n"
            f"checks: {{energy: {{conserved: energy, within: 1e-11}}, momentum: {{conserved: momentum, "
            f"within: 1e-11}}}}\nbodies:\n"
            f"  flyer: {{material: m, velocity: {velocity}, {flyer}}}\n"
            f"  target: {{material: m, {target}{finer}}}\n" + (law if case["law"] == "yes" else ""))


def columns(path, *names):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    title = [name.split(" ")[0] for name in rows[0]]
    return [[float(row[title.index(name)]) for row in rows[1:]] for name in names]


def run(case, gap, cycles, folder):
    """Time, speed of the target and overlap in spacings; or the message of a failure."""
    path, out = folder / "case.yaml", folder / "out"
    path.write_text(text_of(case, gap, cycles), encoding="utf-8")
    done = subprocess.run([BOLIDE, "run", path, "--output", out, "--overwrite", "--threads", "1"],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None, (done.stdout + done.stderr)[-400:]
    time, speed, low = columns(out / "probes/target.csv", "time", "velocity.x", "low.x")
    high, = columns(out / "probes/flyer.csv", "high.x")
    if case["shape"] == "oblique":
        return (time, [u / math.cos(ANGLE) for u in speed], 0.0), None
    return (time, speed, max(a - b for a, b in zip(high, low)) / SPACING), None


def moves(case, found):
    return next((t for t, u in zip(found[0], found[1]) if u > 0.005 * case["speed"]), found[0][-1])


REFERENCE = {}


def faults_of(case, folder):
    """A line a fault; prints what was measured."""
    name = " ".join(str(value) for value in case.values())
    cycles = 2.5 if case["shape"] in ("disc", "ball") else 1.5
    key = name.replace(str(case["gap"]), "-")
    if key not in REFERENCE:
        REFERENCE[key] = run(case, 0.0, cycles, folder)
    start, fault = REFERENCE[key]
    if not fault:
        found, fault = run(case, case["gap"], cycles, folder)
    if fault:
        return [f"{name}: {fault}"]
    overlap = found[2]
    late = (moves(case, found) - moves(case, start)) * case["speed"] / SPACING - case["gap"]
    # what bodies keep that part; of others the first swing
    largest, wanted = max(found[1]), max(start[1])
    ratio, limit = largest / wanted - 1.0, LIMITS[case["shape"]]
    if case["solver"] == "mpm" and case["shape"] == "flat":
        limit = FLAT_MPM
    print(f"{name}: {wanted:.5g} {largest:.5g} m/s ({100 * ratio:+.2f} %), meets {late:+.2f} "
          f"spacings late, overlap {overlap:.2f}, without a gap {start[2]:.2f}", flush=True)
    faults = []
    if abs(ratio) > limit:
        faults.append(f"{name}: {largest:.5g} m/s, without a gap {wanted:.5g} m/s")
    if abs(late) > 0.5:
        faults.append(f"{name}: they meet {late:.2f} spacings late")
    if overlap > max(start[2], 0.0) + 0.5:
        faults.append(f"{name}: an overlap of {overlap:.2f} spacings")
    return faults


FEW = ({"shape": "line", "gap": 0.6, "speed": 100.0}, {"shape": "line", "gap": 8.0, "speed": 3000.0},
       {"shape": "line", "gap": 4.0, "size": 20}, {"shape": "line", "gap": 4.0, "size": 20, "law": "no"},
       {}, {"law": "no"}, {"speed": 1000.0}, {"shape": "shifted", "speed": 100.0},
       {"shape": "finer", "speed": 100.0}, {"shape": "disc", "speed": 100.0},
       {"shape": "ball", "speed": 300.0, "size": 6}, {"shape": "oblique", "speed": 100.0},
       {"solver": "mpm", "shape": "line", "gap": 4.0}, {"solver": "mpm", "speed": 1000.0},
       {"solver": "mpm", "shape": "disc", "speed": 100.0})


def drawn(seed, number):
    draw = random.Random(f"{seed} {number}")
    shape = draw.choice(sorted(LIMITS))
    solver = draw.choice(("sph", "mpm"))
    law = "yes" if solver == "mpm" else draw.choice(("yes", "no"))
    return {**STANDARD, "shape": shape, "solver": solver, "law": law,
            "speed": draw.choice((10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0)),
            "gap": draw.choice((0.6, 1.0, 2.0, 4.0, 8.0)), "size": 8 if shape == "ball" else 16}


def chosen(words):
    if words[:1] == ["--campaign"]:
        seed, count = (words[1:] + ["1", "40"][len(words) - 1:])[:2]
        return [drawn(seed, number) for number in range(int(count))]
    given = dict(word.split("=") for word in words)
    given = {key: value if key in ("shape", "solver", "law") else float(value)
             for key, value in given.items()}
    return [{**STANDARD, **given}] if given else [{**STANDARD, **few} for few in FEW]


def main():
    folder = pathlib.Path("touch")
    folder.mkdir(exist_ok=True)
    faults = [fault for case in chosen(sys.argv[1:]) for fault in faults_of(case, folder)]
    print("\n".join(faults))
    return 1 if faults else 0


sys.exit(main())
