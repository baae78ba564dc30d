"""Random shocks in porous explosives, for scripts/campaign-random."""
import math
import random

EXPLOSIVES = ("petn-reactive", "rdx-reactive", "lx-17", "pbx-9502", "petn-threshold", "anfo")
STRIKERS = ("aluminium", "copper", "tungsten")
SLOWEST = 2500.0  # m/s: no front that is followed is slower


def vector(values, unit="m"):
    return "[" + ", ".join(f"{value:.9g} {unit}" for value in values) + "]"


def centres(draw, size, radius, porosity, layout):
    """The centres of pores of RADIUS whose fraction of the box of SIZE is about POROSITY. Random
    ones may overlap, and in axisymmetry they are rings with the fraction of a plane."""
    dimension = len(size)
    volume = {1: 2 * radius, 2: math.pi * radius**2, 3: 4 / 3 * math.pi * radius**3}[dimension]
    if layout == "random":
        count = round(-math.log(1 - porosity) * math.prod(size) / volume)
        return [[draw.uniform(0, length) for length in size] for _ in range(max(count, 1))]
    step = max((volume / porosity) ** (1 / dimension), 2.05 * radius)
    counts = [max(int(length / step), 1) for length in size]
    found = []
    for number in range(math.prod(counts)):
        place, rest = [], number
        for count in counts:
            place.append(rest % count)
            rest //= count
        shift = 0.5 if layout == "staggered" and place[0] % 2 else 0.0
        at = [(index + 0.5) * step for index in place]
        if dimension > 1:
            at[1] += shift * step
        found.append(at)
    return found


def porous_explosive(seed, number):
    """Title, text and groups of the case."""
    draw = random.Random(f"{seed} porous explosive {number}")
    geometry = draw.choice(("1-D", "2-D", "2-D", "axisymmetric", "3-D"))
    dimension = {"1-D": 1, "3-D": 3}.get(geometry, 2)
    axial = geometry == "axisymmetric"
    material, striker = draw.choice(EXPLOSIVES), draw.choice(STRIKERS)
    across = {1: 1, 2: draw.choice((16, 24, 32)), 3: draw.choice((10, 12))}[dimension]
    along = {1: 400, 2: 5 * across, 3: 3 * across}[dimension]
    spacing = 10 ** draw.uniform(-5.3, -3.7)
    size = [along * spacing] + [across * spacing] * (dimension - 1)
    porosity, layout = draw.uniform(0.03, 0.6), draw.choice(("grid", "staggered", "random"))
    radius = draw.uniform(1, across / 5 if dimension > 1 else 8) * spacing
    speed = round(500 * 8 ** draw.random())
    stop = draw.choice((0.1, 0.3, 2))  # of the run
    axis = 1 if axial else 0  # along which the wave runs
    turn = lambda values: values[::-1] if axial else values
    pores = centres(draw, size, radius, porosity, layout)
    until = 1.2 * size[0] / max(SLOWEST, 2 * speed)
    plate = 8 * spacing
    velocity = turn([speed] + [0] * (dimension - 1))
    box = lambda base, top: (f"box: {{from: {vector(turn([base] + [0] * (dimension - 1)))}, "
                             f"to: {vector(turn([top] + size[1:]))}}}")
    hole = (lambda at: f"box: {{from: [{at[0] - radius:.9g} m], to: [{at[0] + radius:.9g} m]}}"
            if dimension == 1 else
            f"ball: {{center: {vector(turn(at))}, radius: {radius:.9g} m}}")
    title = (f"{material}, {len(pores)} pores, {layout}, porosity {porosity:.2f}, "
             f"{speed} m/s, {geometry}")
    driven = draw.random() < 0.5
    holes = "".join(f"      - {hole(at)}\n" for at in pores)
    text = f"""format: 1
title: {title}
dimension: {dimension}
{"geometry: axisymmetric" if axial else ""}
resolution: {spacing:.9g} m
solver: sph
materials: {{explosive: {{library: {material}}}, metal: {{library: {striker}}}}}
bodies:
  charge:
    material: explosive
    difference:
      - {box(0, size[0])}
{holes}  striker:
    material: metal
    {box(-plate, 0)}
    velocity: {vector(velocity, "m/s")}
    {f"driven: yes" if driven else ""}
    {f"stop: {stop * until:.6g} s" if stop < 1 else ""}
run: {{until: {until:.6g} s}}
output: {{snapshots: no}}
checks:
  mass:   {{conserved: mass, within: 1e-12}}
  energy: {{conserved: energy, within: 1e-12}}
"""
    walls = ""
    for across_axis in range(dimension):
        if across_axis == axis or draw.random() < 0.5:
            continue
        x = "xyz"[across_axis]
        if not axial:
            walls += f"  {x}0: {{kind: reflecting, axis: {x}, at: 0 m, side: low}}\n"
        walls += f"  {x}1: {{kind: reflecting, axis: {x}, at: {size[1]:.9g} m, side: high}}\n"
    text += f"boundaries:\n{walls}" if walls else ""
    return text, (f"porous {material}", f"porous {geometry}", f"porous {layout}")
