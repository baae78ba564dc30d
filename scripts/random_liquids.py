"""Liquids beside a gas, products or alone on the grid, for scripts/campaign-random."""
import random

WATERS = {"stiffened": "library: water-stiffened",
          "stiff": "eos: {stiffened-gas: {density: 1000 kg/m^3, sound: 1480 m/s, gamma: 7.15}}, "
                   "failure: {cavitation: {}}",
          "noble-abel": "eos: {noble-abel: {density: 1000 kg/m^3, gamma: 1.19, covolume: "
                        "6.61e-4 m^3/kg, pressure: 702.8 MPa, energy: -1177788 J/kg}}, "
                        "failure: {cavitation: {vapour: 10 kPa}}"}
OTHERS = {"air": "library: air", "tnt": "library: tnt", "products": "library: tnt-products",
          "alone": None}


def vector(values, unit):
    return "[" + ", ".join(f"{value:.9g} {unit}" for value in values) + "]"


def state_of(draw, other):
    """Keys of the state of what is beside the water, and a speed that few waves exceed."""
    if other == "tnt":
        return "", 9000
    if other == "products":
        return f"energy: {draw.uniform(-2e6, 0):.6g} J/kg", 9000
    if other == "alone":
        return f"pressure: {10 ** draw.uniform(5, 9.5):.6g} Pa", 3000
    pressure = 10 ** draw.uniform(3, 9)
    density = 10 ** draw.uniform(-1, 2) * max(1, pressure / 1e8)
    return f"density: {density:.6g} kg/m^3, pressure: {pressure:.6g} Pa", 1500


def faces(draw, size, axisymmetric, inner):
    text = ""
    for axis, length in enumerate(size):
        x = "xyz"[axis]
        face = draw.choice(("walls", "open", "periodic"))
        radial = axis == 0 and (axisymmetric or inner)
        if face == "walls":
            if not radial:
                text += f"  {x}0: {{kind: reflecting, axis: {x}, at: 0 m, side: low}}\n"
            text += f"  {x}1: {{kind: reflecting, axis: {x}, at: {length:.9g} m, side: high}}\n"
        if face == "periodic" and not radial:
            text += f"  {x}: {{axis: {x}, kind: periodic}}\n"
    return text


def with_liquid(seed, number):
    """Text and groups of the case."""
    draw = random.Random(f"{seed} liquid {number}")
    geometry = draw.choice(("plane", "spherical", "cylindrical", "2-D", "axisymmetric", "3-D"))
    dimension = {"3-D": 3, "2-D": 2, "axisymmetric": 2}.get(geometry, 1)
    curved = geometry in ("spherical", "cylindrical")
    cells = [{1: 200, 2: 32, 3: 12}[dimension] + 4 * draw.randrange(3) for _ in range(dimension)]
    edge = 10 ** draw.uniform(-3, -1.3)
    size = [count * edge for count in cells]
    water, other = draw.choice(list(WATERS)), draw.choice(list(OTHERS))
    state, sound = state_of(draw, other)
    # what fills the region; of the surface the upper part of the domain too
    inside = draw.random() < 0.7 or other in ("tnt", "products")
    surface = dimension == 2 and other == "air" and draw.random() < 0.5
    rest = f"pressure: {10 ** draw.uniform(4, 7):.6g} Pa"
    speed = [0.0 if (curved or geometry == "axisymmetric") and axis == 0 or other == "tnt" else
             draw.choice((0, 0, 1)) * draw.uniform(-300, 300) for axis in range(dimension)]
    radius = draw.uniform(0.1, 0.28) * min(size)
    middle = [0.0 if (curved or geometry == "axisymmetric") and axis == 0 else
              draw.uniform(0.3, 0.7) * length for axis, length in enumerate(size)]
    if curved:
        radius = draw.uniform(0.05, 0.5) * size[0]
    low, high = [a - radius for a in middle], [a + radius for a in middle]
    if middle[0] == 0.0:
        low[0] = 0.0
    region = (f"box: {{from: {vector(low, 'm')}, to: {vector(high, 'm')}}}"
              if dimension == 1 or draw.random() < 0.3 else
              f"ball: {{center: {vector(middle, 'm')}, radius: {radius:.9g} m}}")
    second = "water" if other == "alone" else "other"
    out, into = ("water", second) if inside else (second, "water")
    states = {out: rest if out == "water" else "density: 1.2 kg/m^3, pressure: 0.1 MPa",
              into: state if into == second else f"pressure: {10 ** draw.uniform(4, 9):.6g} Pa"}
    if out == into:
        states = {out: rest}
    box = f"box: {{from: {vector([0] * dimension, 'm')}, to: {vector(size, 'm')}}}"
    inner_state = state if out == into else states[into]
    bodies = f"  around: {{material: {out}, {states[out]}, {box}}}\n"
    replaced = "[around]"
    if surface and inside:
        level = [0.0, draw.uniform(0.75, 0.95) * size[1]]
        bodies += (f"  above: {{material: other, density: 1.2 kg/m^3, pressure: 0.1 MPa, replaces: around, "
                   f"box: {{from: {vector(level, 'm')}, to: {vector(size, 'm')}}}}}\n")
        replaced = "[around, above]"
    keys = ", ".join(part for part in (f"material: {into}", inner_state,
                                       f"velocity: {vector(speed, 'm/s')}", region,
                                       f"replaces: {replaced}") if part)
    bodies += f"  region: {{{keys}}}\n"
    materials = f"water: {{{WATERS[water]}}}"
    if OTHERS[other]:
        materials += f", other: {{{OTHERS[other]}}}"
    until = draw.choice((0.5, 2, 4)) * max(size) / (sound + max(map(abs, speed)))
    shape = "" if geometry in ("plane", "2-D", "3-D") else f"geometry: {geometry}\n"
    boundaries = faces(draw, size, geometry == "axisymmetric", curved)
    if dimension > 1 and draw.random() < 0.4:
        at = [draw.uniform(0, 0.8) * length for length in size]
        to = [a + draw.uniform(0.1, 0.3) * length for a, length in zip(at, size)]
        boundaries += f"  block: {{kind: rigid-body, part: {{box: {{from: {vector(at, 'm')}, to: {vector(to, 'm')}}}}}}}\n"
    text = f"""format: 1
title: water ({water}) and {other}, {geometry}
dimension: {dimension}
{shape}resolution: {edge:.9g} m
solver: gas
materials: {{{materials}}}
bodies:
{bodies}run: {{until: {until:.6g} s, energy_drift: 1}}
output: {{snapshots: no}}
checks:
  mass:     {{conserved: mass, within: 1e-12}}
  momentum: {{conserved: momentum, within: 1e-10}}
  energy:   {{conserved: energy, within: 1e-12}}
"""
    text += f"boundaries:\n{boundaries}" if boundaries else ""
    if other == "tnt":
        lit = [draw.uniform(a, b) for a, b in zip(low, high)]
        text += f"detonations: {{point: {{at: {vector([0.0] if curved else lit, 'm')}}}}}\n"
    if draw.random() < 0.2 and not curved:
        pull = [0.0 if geometry == "axisymmetric" and axis == 0 else
                draw.uniform(-1, 1) * 0.01 * sound / until for axis in range(dimension)]
        text += f"gravity: {vector(pull, 'm/s^2')}\n"
    return text, (f"liquid {geometry}", f"water and {other}", f"water {water}")
