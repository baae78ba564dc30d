"""Charges and implosions in 1-D with curved or plane waves, for scripts/campaign-random."""
import random

# Those that the gas solver computes beside air.
EXPLOSIVES = ("tnt", "tnt-products", "c-4-products", "petn-products")


def charge_in_air(seed, number):
    """Title, text and groups of the case."""
    draw = random.Random(f"{seed} charge {number}")
    geometry = draw.choice(("spherical", "spherical", "cylindrical", "plane"))
    cells = draw.randint(5, 60)
    radius = 10 ** draw.uniform(-3, 0)
    thin = draw.choice((1, 1, 1, 1e-1, 1e-3, 1e-6)) * draw.uniform(0.5, 2)
    kind = draw.choice(("charge", "charge", "implosion"))
    speed = 1 if kind == "implosion" else 7e3
    end = draw.randint(4, 12) * cells
    h = radius / cells
    size = end * h
    walls = "" if geometry != "plane" else "boundaries: {middle: {kind: symmetry, axis: x, at: 0 m, side: low}}\n"
    shape = "" if geometry == "plane" else f"geometry: {geometry}\n"
    air = f"material: air, pressure: {thin * 101.35e3:.9g} Pa, density: {thin * 1.225:.9g} kg/m^3"
    if kind == "charge":
        material = draw.choice(EXPLOSIVES)
        lit = not material.endswith("-products")
        materials = f"materials: {{explosive: {{library: {material}}}, air: {{library: air}}}}\n"
        bodies = (f"  charge: {{material: explosive, box: {{from: [0 m], to: [{cells}*h]}}}}\n"
                  f"  air: {{{air}, box: {{from: [{cells}*h], to: [{end}*h]}}}}\n")
        start = f"detonations: {{middle: {{at: [0 m]}}}}\n" if lit else ""
        until = (radius + 2 * size) / speed
    else:
        material, ratio = "air", 10 ** draw.uniform(0.5, 4)
        inner = round(draw.uniform(0.2, 0.9) * end)
        materials = "materials: {air: {library: air}}\n"
        bodies = (f"  inside: {{{air}, box: {{from: [0 m], to: [{inner}*h]}}}}\n"
                  f"  outside: {{material: air, pressure: {ratio * thin * 101.35e3:.9g} Pa, "
                  f"density: {thin * draw.choice((0.1, 1.0, 10.0)) * 1.225:.9g} kg/m^3, "
                  f"box: {{from: [{inner}*h], to: [{end}*h]}}}}\n")
        start = ""
        until = 3 * size / (340 * ratio**0.5)
    title = f"{kind} of {material}, {geometry}, {cells} cells, air {thin:.2g}"
    text = f"""format: 1
title: {title}
dimension: 1
let: {{h: {h:.9g} m}}
{shape}resolution: h
solver: gas
{materials}bodies:
{bodies}{start}{walls}run: {{until: {until:.6g} s}}
output: {{snapshots: no}}
checks:
  mass:   {{conserved: mass, within: 1e-11}}
  energy: {{conserved: energy, within: 1e-11}}
"""
    return text, (f"{kind} {geometry}", f"{kind} of {material}")
