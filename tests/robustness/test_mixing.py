"""Burnt products that mix with the air, in boxes drawn by a seed: one or two charges at any angle,
in 2-D and axisymmetry, on cells of one to three levels, with and without an obstacle. Every run
reaches its end and conserves mass and energy.

python3 tests/robustness/test_mixing.py [FIRST [COUNT]]: cases FIRST to FIRST + COUNT - 1 (default: 1
to 20)"""
import random
import sys

from runs import run

CASE = """format: 1
dimension: 2
{geometry}resolution: {edge} mm
levels: {levels}
solver: {{gas: {{regrid: {regrid}}}}}
materials:
  air: {{eos: {{ideal-gas: {{density: 1.2 kg/m^3, gamma: 1.4}}}}}}
  products:
    library: tnt
    afterburn: {{energy: {energy} MJ/kg, rate: {rate:.4g} 1/s, air: {air}, mixing: {mixing:.4g} 1/s}}
bodies:
  air: {{material: air, pressure: {pressure} bar, density: 1.2 kg/m^3, box: {{from: [0 m, 0 m], to: {end}}}}}
{charges}detonations:
{detonations}boundaries:
  left: {{kind: reflecting, axis: x, side: low}}
{boundaries}run: {{until: {until} us}}
checks:
  mass: {{conserved: mass, within: 1e-12}}
  energy: {{conserved: energy, within: 1e-12}}
"""


def vector(values, unit="m"):
    return "[" + ", ".join(f"{value:.6g} {unit}" for value in values) + "]"


def charge(dice, name, center, size):
    """A ball or a box at an angle."""
    shape = f"ball: {{center: {vector(center)}, radius: {size} m}}"
    if dice.random() < 0.5:
        half = (size, size * dice.uniform(0.4, 1))
        box = (f"box: {{from: {vector(c - h for c, h in zip(center, half))}, "
               f"to: {vector(c + h for c, h in zip(center, half))}}}")
        shape = (f"rotate: {{shape: {{{box}}}, about: {vector(center)}, "
                 f"angle: {dice.uniform(0, 90):.3g} deg}}")
    return f"  {name}: {{material: products, replaces: air, {shape}}}\n"


def draw(number):
    """The text of a case."""
    dice = random.Random(f"mixing {number}")
    edge = dice.choice((4, 5, 6.25, 8))
    end = (dice.randint(3, 5) * 0.016 * edge, dice.randint(4, 6) * 0.016 * edge)
    size = edge * 1e-3 * dice.uniform(3, 6)
    places = [(end[0] * dice.uniform(0.25, 0.4), end[1] * dice.uniform(0.3, 0.4))]
    if dice.random() < 0.3:
        places.append((end[0] * dice.uniform(0.25, 0.4), end[1] * dice.uniform(0.7, 0.8)))
    boundaries = ""
    for axis, side in (("x", "high"), ("y", "low"), ("y", "high")):
        if dice.random() < 0.5:
            boundaries += f"  {axis}-{side}: {{kind: reflecting, axis: {axis}, side: {side}}}\n"
    if dice.random() < 0.5:
        low = (end[0] * 0.65, end[1] * dice.uniform(0, 0.5))
        boundaries += (f"  block: {{kind: rigid-body, part: {{box: {{from: {vector(low)}, "
                       f"to: {vector((end[0] * 0.8, low[1] + 0.3 * end[1]))}}}}}}}\n")
    return CASE.format(
        geometry=dice.choice(("", "geometry: axisymmetric\n")), edge=edge,
        levels=dice.choice((1, 2, 3, 3)), regrid=dice.choice((1, 2, 5)),
        energy=dice.choice((1, 3, 8)), rate=10 ** dice.uniform(3.5, 5.5),
        air=dice.choice((0.5, 0.95, 3)), mixing=10 ** dice.uniform(2, 5),
        pressure=dice.choice((0.1, 1, 5)), end=vector(end),
        charges="".join(charge(dice, f"charge-{k}", at, size)
                        for k, at in enumerate(places)),
        detonations="".join(f"  point-{k}: {{at: {vector(at)}}}\n"
                            for k, at in enumerate(places)),
        boundaries=boundaries, until=round(edge * dice.uniform(15, 40)))


def main():
    first = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    wrong = []
    for number in range(first, first + count):
        status, output = run(f"mixing-{number}", draw(number))
        if status:
            wrong.append(f"mixing-{number}.yaml:\n" + "\n".join(output.splitlines()[-5:]))
    for text in wrong:
        print(f"FAILED: {text}")
    return 1 if wrong else 0


sys.exit(main())
