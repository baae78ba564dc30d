"""The JSON Schema that `bolide schema` prints: it is a valid schema, every case that is shipped keeps to it,
and cases with mistakes that a schema can see do not. It is never stricter than the reader."""
import json
import os
import pathlib
import re
import subprocess
import sys

import jsonschema
import yaml

SOURCE = pathlib.Path(os.environ["BOLIDE_SOURCE_DIR"])

GOOD = """
format: 1
dimension: 1
resolution: 1 mm
let: {U0: 500 m/s}
solver: sph
materials: {copper: {eos: {mie-grueneisen: {density: 8930 kg/m^3, sound: 3940 m/s, slope: 1.489, gamma: 2,
  bulk_modulus: 139 GPa}}}}
bodies: {plate: {material: copper, box: {from: [0], to: [1 cm]}, velocity: [U0]}}
run: {until: 1 us}
checks: {all: {mean: pressure, at_most: 1 GPa}}
"""

# What stands for what in GOOD, and whether the case still keeps to the schema.
VARIANTS = [
    (True, "solver: sph", "solver: {sph: {smoothing: 1.2}}"),
    (True, "solver: sph", "solver: {sph: }"),
    (True, "format: 1", "include: other.yaml"),
    (True, "format: 1", "format: 1\ninclude: [a.yaml, b.yaml]"),
    (True, "run:", "sweep: {U0: [500 m/s, 1 km/s]}\nrun:"),
    (True, "run:", "sweep: {fast: {U0: [500 m/s, 1 km/s], resolution: [1 mm, 2 mm]}}\nrun:"),
    (True, "run:", "short: {let: {U0: 1 m/s}, sweep: {U0: [2 m/s]}, bodies: {plate: {velocity: [0]}}}\nrun:"),
    (True, "run:", "long: {resolution: 0.1 mm, run: {until: 2 us}}\nrun:"),
    (True, "run:", "walls:\noutput:\nrun:"),
    (True, "run:", "convergence: {vary: U0, values: [1 m/s, 2], order: {all: {at_least: 0.5}}}\nrun:"),
    (True, "run:", "convergence:\nrun:"),
    (True, "copper: {eos", "copper: {library: aluminium, eos"),
    (True, "density: 8930 kg/m^3, ", "density: 8930 kg/m^3*(1 - 4/73), "),
    (True, "mean: pressure", "mean: {field: pressure}"),
    (False, "resolution", "resolutoin"),
    (False, "format: 1", "format: 2"),
    (False, "dimension: 1", "dimension: 4"),
    (False, "dimension: 1", "dimension: one and a half\ndimensions: 2"),
    (False, "solver: sph", "solver: spf"),
    (False, "solver: sph", "solver: {sph: {method: guess}}"),
    (False, "solver: sph", "solver: [sph]"),
    (False, "resolution: 1 mm", "resolution: 1"),
    (False, "resolution: 1 mm", "resolution: [1 mm]"),
    (False, "run: {until: 1 us}", ""),
    (False, "run: {until: 1 us}", "run: {}"),
    (False, "material: copper, ", ""),
    (False, "box: {from: [0], to: [1 cm]}, ", ""),
    (False, "velocity:", "ball: {center: [0], radius: 1 mm}, velocity:"),
    (False, "velocity: [U0]", "velocity: [1, 2, 3, 4]"),
    (False, "velocity: [U0]", "velocity: {x: 1 m/s}"),
    (False, "eos: {mie", "strength: {perfect-plastic: {yield: 1 GPa}}, eos: {mie"),
    (False, "sound: 3940 m/s, ", ""),
    (False, "gamma: 2,", "gama: 2,"),
    (False, "mean: pressure, ", ""),
    (False, "mean: pressure, ", "mean: pressure, maximum: pressure, "),
    (False, "let: {U0", "let: {2U"),
    (False, "run:", "output: {snapshots: true}\nrun:"),
    (False, "run:", "sweep: {U0: 500 m/s}\nrun:"),
    (False, "run:", "sweep: {U0: []}\nrun:"),
    (False, "run:", "sweep: {fast: {}}\nrun:"),
    (False, "run:", "short: {resolutoin: 1 mm}\nrun:"),
    (False, "run:", "convergence: {values: {coarse: 1 mm}}\nrun:"),
    (False, "run:", "convergence: {order: {all: 1}}\nrun:"),
    (False, "run:", "short: {short: {}}\nrun:"),
    (False, "format: 1", "include: {a: b}"),
]

# Of tests/data/bad, what a schema can see.
VISIBLE = [
    "missing-keys", "misspelt-shape", "no-format", "no-shape", "not-a-map", "other-format",
    "two-shapes", "two-solvers", "unknown-choice", "unknown-key", "unknown-key-without-suggestion",
    "unknown-solver", "yes-or-no",
]


class Core(yaml.SafeLoader):
    """YAML 1.2, as editors and Bolide read it: `yes` is a text."""

    yaml_implicit_resolvers = {}


Core.add_implicit_resolver("tag:yaml.org,2002:null", re.compile("~|null|$"), ["~", "n", ""])
Core.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("true|false$"), ["t", "f"])
Core.add_implicit_resolver("tag:yaml.org,2002:int", re.compile("[-+]?[0-9]+$"), list("-+0123456789"))
Core.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$"), list("-+.0123456789"))


def load(text):
    return yaml.load(text, Core)


def reader_takes(case):
    """True when Bolide itself takes the text as a case."""
    pathlib.Path("case.yaml").write_text(case)
    for included in "other.yaml", "a.yaml", "b.yaml":
        pathlib.Path(included).write_text("format: 1\n")
    return subprocess.run([os.environ["BOLIDE"], "check", "--short", "case.yaml"], capture_output=True).returncode == 0


def main():
    text = subprocess.run([os.environ["BOLIDE"], "schema"], check=True, stdout=subprocess.PIPE).stdout
    schema = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    judge = jsonschema.Draft202012Validator(schema)
    faults = []

    def expect(name, good, case):
        found = jsonschema.exceptions.best_match(judge.iter_errors(case))
        if good and found:
            faults.append(f"{name}: {found.json_path}: {found.message[:300]}")
        elif not good and not found:
            faults.append(f"{name}: the schema sees no mistake")

    shipped = sorted(SOURCE.glob("examples/**/case.yaml")) + sorted(SOURCE.glob("templates/*.yaml"))
    for path in shipped + sorted(SOURCE.glob("bench/cases/*.yaml")):
        expect(path, True, load(path.read_text()))
    if not shipped:
        faults.append("no case is shipped")
    expect("the case to start from", True, load(GOOD))
    for good, old, new in VARIANTS:
        case = GOOD.replace(old, new, 1)
        expect(f"{new!r} for {old!r}", good, load(case))
        if old not in GOOD:
            faults.append(f"{old!r} does not stand in the case to start from")
        if reader_takes(case) != good:
            faults.append(f"{new!r} for {old!r}: the reader {'refuses' if good else 'takes'} it")
    for name in VISIBLE:
        expect(name, False, load((SOURCE / "tests/data/bad" / f"{name}.yaml").read_text()))
    sys.exit("\n".join(faults) or None)


main()
