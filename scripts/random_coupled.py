"""Blasts on plates, drawn by a seed, for scripts/campaign-random: gas beside
material points, or one after the other."""
import math
import random

CHARGES = {  # material, what of it the body says, density, a speed that its blast has about
    "tnt": ("library: tnt", "", 1630, 3000),
    "c-4-products": ("library: c-4-products", ", energy: 0 J/kg", 1600, 3000),
    "tnt-products": ("library: tnt-products", ", energy: 0 J/kg", 1630, 2500),
    "balloon":
        ("eos: {ideal-gas: {density: 20 kg/m^3, gamma: 1.3}}", ", pressure: 20 MPa", 20, 1500)}
PLATES = {  # and their densities
    "steel-1006-johnson-cook": 7890, "aluminium-2024-johnson-cook": 2780, "rha-johnson-cook": 7850,
    "copper-johnson-cook": 8960, "steel-4340-failure": 7830, "titanium-6al-4v": 4430,
    "concrete-hjc": 2400, "glass-holmquist": 2530, "polycarbonate": 1200, "lead": 11340}
EDGE = 0.005  # of a cell, m
BAND = {1: 3, 2: 4, 3: 6}  # cells behind the overlap that solids stay out of


def vector(values, unit="m"):
    return "[" + ", ".join(f"{value:.9g} {unit}" for value in values) + "]"


def blast(seed, number):
    """Title, text and groups of a case. The blast runs along one axis; across it the charge is cut
    by mirrors or by an axis, or is in the middle. Lengths are in cells first."""
    draw = random.Random(f"{seed} coupled {number}")
    geometry = draw.choice(("1-D", "2-D", "axisymmetric", "3-D"))
    dimension = {"1-D": 1, "3-D": 3}.get(geometry, 2)
    along = 1 if geometry == "axisymmetric" else 0
    charge, plate = draw.choice(sorted(CHARGES)), draw.choice(sorted(PLATES))
    overlap = draw.choice((3, 5, 8)) if dimension < 3 else 3
    radius = draw.randint(*{1: (10, 40), 2: (5, 12), 3: (3, 5)}[dimension])
    gap = draw.randint(*{1: (10, 120), 2: (8, 40), 3: (4, 9)}[dimension])
    alternating = random.Random(f"{seed} method {number}").random() < 0.4
    if alternating:  # the region of the plate, and the products of the charge while it burns
        gap += 22
    thick = draw.randint(1, {1: 12, 2: 8, 3: 4}[dimension])
    material, state, density, speed = CHARGES[charge]
    until = draw.choice((1.2, 2, 3) if dimension < 3 else (1.2, 2)) * (gap + radius) * EDGE / speed
    # Cells that the plate may fly: as fast as the blast, less by the ratio of masses, spread out.
    spread = (radius / (radius + gap)) ** ((2 if geometry == "axisymmetric" else dimension) - 1)
    pushed = 2 * min(density * radius / (PLATES[plate] * thick), 2)
    travel = 0.5 * speed * until / EDGE * pushed * spread
    room = overlap + BAND[dimension] + 3 + draw.randint(2, 8 if dimension < 3 else 2)
    whole = geometry != "axisymmetric" and dimension == 2 and draw.random() < 0.3
    wide = radius + draw.randint(*{1: (0, 0), 2: (16, 30), 3: (4, 8)}[dimension])
    closed = draw.random() < 0.5  # the plate reaches to the sides of the domain
    low, high = [0] * dimension, [wide] * dimension
    if whole:
        low = [-wide] * dimension
    low[along] = -radius - draw.randint(4, 16 if dimension < 3 else 5)
    front = radius + gap
    behind = room + math.ceil(travel)
    high[along] = front + thick + behind + draw.randint(5, 20 if dimension < 3 else 6)
    plate_low, plate_high = list(low), list(high)
    plate_low[along], plate_high[along] = front, front + thick
    if not closed:
        for axis in range(dimension):
            if axis != along:
                plate_high[axis] = max(high[axis] - room - 2, 2)
                plate_low[axis] = -plate_high[axis] if whole else 0
    cells = lambda values: vector([value * EDGE for value in values])
    box = lambda a, b: f"box: {{from: {cells(a)}, to: {cells(b)}}}"
    form = (box([-radius], [radius]) if dimension == 1 else
            f"ball: {{center: {cells([0] * dimension)}, radius: {radius * EDGE:.9g} m}}")
    region = ""
    if draw.random() < 0.5 or travel > 2:
        inside, outside = list(low), list(high)
        inside[along], outside[along] = front - room, front + thick + behind
        region = f"region: {{low: {cells(inside)}, high: {cells(outside)}}}, "
    solver = (f"{{afdmp: {{{region.rstrip(', ')}}}}}" if alternating else
              f"{{cfdmp: {{{region}overlap: {overlap}}}}}")
    pressed = draw.choice((", pressure: 0.1 MPa", ""))
    text = f"""format: 1
title: {charge} before {plate}, {geometry}, {gap} cells, plate of {thick}{", closed" if closed else ""}
dimension: {dimension}
{"geometry: axisymmetric" if geometry == "axisymmetric" else ""}
resolution: {EDGE / 2} m
solver: {solver}
materials: {{air: {{library: air}}, charge: {{{material}}}, plate: {{library: {plate}}}}}
bodies:
  air: {{material: air, density: 1.2 kg/m^3, pressure: 0.1 MPa, {box(low, high)}}}
  charge: {{material: charge{state}, {form}, replaces: air}}
  plate: {{material: plate{pressed}, {box(plate_low, plate_high)}, replaces: air}}
domain: {{low: {cells(low)}, high: {cells(high)}}}
run: {{until: {until:.6g} s}}
output: {{snapshots: no}}
checks:
  mass:   {{conserved: mass, within: 1e-10}}
  energy: {{conserved: energy, within: 1e-6}}
"""
    if charge == "tnt":
        at = [0.0] * dimension
        text += f"detonations: {{middle: {{at: {cells(at)}}}}}\n"
    walls = ""
    for axis in range(dimension):
        name = "xyz"[axis]
        if axis == along and draw.random() < 0.3:
            walls += f"  back: {{kind: reflecting, axis: {name}, at: {low[axis] * EDGE:.9g} m, side: low}}\n"
        if axis != along and not whole and not (geometry == "axisymmetric" and axis == 0):
            walls += f"  {name}0: {{kind: reflecting, axis: {name}, at: 0 m, side: low}}\n"
        if axis != along and draw.random() < 0.5:
            walls += f"  {name}1: {{kind: reflecting, axis: {name}, at: {high[axis] * EDGE:.9g} m, side: high}}\n"
    text += f"boundaries:\n{walls}" if walls else ""
    return text, (f"coupled {'afdmp' if alternating else 'cfdmp'}",
                  f"coupled {geometry}", f"coupled {charge}", f"coupled {plate}",
                  f"coupled, region {'given' if region else 'derived'}")
