"""Every number of a case as run that a resumed run cannot change is refused by its name; every other one is
taken, and the bits stay. With each solver."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import yaml

PROGRAM = os.environ["BOLIDE"]
STEEL = "{library: steel-1006, failure: {spall: {strength: 2 GPa}}}"
PARTICLES = f"""
format: 1
dimension: 2
resolution: 1 mm
solver: SOLVER
materials: {{steel: {STEEL}}}
bodies:
  bar: {{material: steel, box: {{from: [0 mm, 0 mm], to: [8 mm, 3 mm]}}}}
  wall: {{material: steel, box: {{from: [9 mm, -2 mm], to: [11 mm, 5 mm]}}, velocity: [-100 m/s, 0 m/s]}}
boundaries: {{left: {{kind: reflecting, axis: x, at: 0 mm, side: low}}}}
loads: {{push: {{on: wall, pressure: 1 MPa, axis: x, side: high}}}}
contacts: {{them: {{between: [bar, wall], shear: slip, tension: none}}}}
gravity: [0 m/s^2, -10 m/s^2]
probes: {{tip: {{tracer: [8 mm, 1 mm], of: bar}}}}
checks: {{mass: {{conserved: mass, within: 1e-12}}}}
run: {{until: 3 us}}
output: {{pictures: [], snapshots: no}}
"""
GAS = """
format: 1
dimension: 1
resolution: 10 mm
solver: gas
materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}
bodies:
  hot: {material: air, density: 1.2 kg/m^3, pressure: 2 bar, box: {from: [0 m], to: [0.5 m]}}
  cold: {material: air, density: 1.2 kg/m^3, pressure: 1 bar, box: {from: [0.5 m], to: [1 m]}}
probes: {wall: {gauge: [0.9 m]}}
checks: {mass: {conserved: mass, within: 1e-12}}
run: {until: 0.2 ms}
output: {pictures: [], snapshots: no}
"""
FREE = re.compile(r"run\.|output\.|checks\.|title|probes\.[^.]*\.every$|"
                  r"materials\.[^.]*\.tensile_strength$|solver\.sph\.(skin|rebuild)$")
# Those that end the run elsewhere; those that need others beside them, of which the message may be.
ENDS = ("run.until", "run.max_steps")
BESIDE = ("known_deviation_if", "afterburn")


def leaves(node, path=""):
    """The paths of all numbers, and of lists that begin with one, with what they are."""
    for key, value in node.items():
        here = f"{path}.{key}" if path else key
        if isinstance(value, dict):
            yield from leaves(value, here)
        elif changed(value) is not None:
            yield here, value


def changed(value):
    """VALUE but for a hundredth, or a whole number more; None of what is no number."""
    if isinstance(value, list):
        first = changed(value[0]) if value else None
        return None if first is None else [first, *value[1:]]
    if isinstance(value, bool) or value is None:
        return None
    if isinstance(value, int):
        return value + 1
    match = re.fullmatch(r"(-?[\d.]+(?:e[-+]?\d+)?)( [^ ]+)?", str(value))
    if not match:
        return None
    return f"{float(match[1]) * 1.01 + (float(match[1]) == 0) * 1e-3!r}{match[2] or ''}"


def run(case, folder, *options):
    return subprocess.run([PROGRAM, "run", str(case), "--threads", "1", "--output", folder, *options],
                          capture_output=True, text=True)


def hash_of(folder):
    return re.search(r'"hash","(\w+)"', pathlib.Path(folder, "summary.csv").read_text())[1]


def text_of(value):
    return yaml.safe_dump(value, default_flow_style=True, width=10000).split("\n")[0]


def judge(solver, text):
    wrong, refused = [], 0
    case = pathlib.Path(f"{solver}.yaml")
    case.write_text(text.replace("SOLVER", solver))
    for folder in ("first", "part"):
        shutil.rmtree(folder, ignore_errors=True)
    begun = run(case, "first")
    if begun.returncode:
        return [f"{solver}: {begun.stdout}{begun.stderr}"], 0
    as_run = pathlib.Path("as-run.yaml")
    shutil.copy("first/case.yaml", as_run)
    before = hash_of("first")
    for path, value in leaves(yaml.safe_load(as_run.read_text())):
        shutil.rmtree("part", ignore_errors=True)
        shutil.copytree("first", "part")
        done = run(as_run, "part", "--resume", "--set", f"{path}={text_of(changed(value))}")
        said = done.stdout + done.stderr
        free = FREE.match(path)
        if any(word in path for word in BESIDE):
            continue
        if not free and (done.returncode != 2 or path not in said):
            wrong.append(f"{solver}: {path}={text_of(changed(value))} is not refused by name: {said[-300:]}")
        if free and (done.returncode > 1 or path not in ENDS and hash_of("part") != before):
            wrong.append(f"{solver}: {path} is not free: {said[-300:]}")
        refused += not free
    return wrong, refused


def main():
    failures = []
    for solver, text in (("mpm", PARTICLES), ("sph", PARTICLES), ("gas", GAS)):
        wrong, refused = judge(solver, text)
        failures += wrong
        print(f"{solver}: {refused} keys refused")
        if refused < 15:
            failures.append(f"{solver}: only {refused} keys were tried")
    print("\n".join(failures))
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main())
