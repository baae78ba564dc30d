"""Bodies at rest, and uniform tension and compression.

Each function returns the Entry of one variation: the case, and what is measured in it. The exact
answer, its formula and where a limit comes from stand in the `why` of each measure. Solvers are
named without options: what is tested is what a user gets by writing nothing. Angles are degrees by
which a body, its motion and its loads are rotated against the lattice."""
import math

from entry import (
    DIMENSION,
    Entry,
    Measure,
    conserved,
    largest,
    metres,
    rotated,
    speeds,
    start,
    unit,
)
from frame import Frame, walls
from materials import MATERIALS


def strip(solver, resolution=1e-3, lattice="square", angle=0):
    """A ductile strip is drawn apart by its ends to a true strain of 0.1. It hardens, so that it
    strains evenly until dY/de = Y, at 0.22 (Considere). Plane strain: stress = 2 Y/sqrt(3) with Y
    at the plastic strain 2/sqrt(3) ln(l/l0).
    """
    m = MATERIALS["ductile"]
    v, end, w, l, grip = 20.0, 100e-6, 5e-3, 20e-3, 2e-3
    strain = math.log(1 + v * end / l) * 2 / math.sqrt(3)
    flow = m.yield_stress + m.hardening[0] * strain ** m.hardening[1]
    stress = flow * 2 / math.sqrt(3)
    case = start("plane-strain", solver, resolution, end)
    a = math.radians(angle)
    n = [-math.sin(a), math.cos(a)]

    def box(low, high):
        return {"box": {"from": metres(-w, low), "to": metres(w, high)}}

    if angle:  # one lattice for all three: cut from one shape, whose bounds the lattice fills
        whole = rotated(box(-l - grip, l + grip), angle)

        def cut(at, sign):
            return {
                "half_space": {
                    "point": metres(at * n[0], at * n[1]),
                    "normal": [sign * x for x in n],
                }
            }

        shapes = {
            "top": {"difference": [whole, cut(l, 1)]},
            "mid": {"difference": [whole, cut(l, -1), cut(-l, 1)]},
            "bot": {"difference": [whole, cut(-l, -1)]},
        }
    else:
        shapes = {"top": box(l, l + grip), "mid": box(-l, l), "bot": box(-l - grip, -l)}
    along = f"(x*{n[0]:.15g} + y*{n[1]:.15g})/{unit(l, 'm')}" if angle else f"y/{unit(l, 'm')}"
    bodies = {
        "top": {
            "material": "m",
            **shapes["top"],
            "velocity": speeds(v * n[0], v * n[1]),
            "driven": "yes",
        },
        "mid": {
            "material": "m",
            **shapes["mid"],
            "velocity": [f"{unit(v * x, 'm/s')}*{along}" for x in n],
        },
        "bot": {
            "material": "m",
            **shapes["bot"],
            "velocity": speeds(-v * n[0], -v * n[1]),
            "driven": "yes",
        },
    }
    for body in bodies.values():
        if lattice != "square":
            body["lattice"] = lattice
    where = (
        {"about": metres(0, 0), "between": ["0 m", "6 mm"]}
        if angle
        else {"axis": "y", "between": ["-6 mm", "6 mm"]}
    )
    case.update(materials={"m": m.case}, bodies=bodies)
    case["checks"] = {
        name: {"mean": f"stress.{name}", "of": "mid", **where, "at_most": "1e300 Pa"}
        for name in ("xx", "yy", "xy")
    }

    def pull(run):
        c = run.checks
        return n[0] * n[0] * c["xx"] + n[1] * n[1] * c["yy"] + 2 * n[0] * n[1] * c["xy"]

    return Entry(
        f"strip/{solver}/{lattice}/{angle}deg/{1e3 * resolution:g}mm",
        case,
        [
            Measure(
                "stress",
                pull,
                "2 Y/sqrt(3) at ln(l/l0), within 10 %",
                stress,
                0.9 * stress,
                1.1 * stress,
                "Pa",
            ),
            Measure(
                "strain",
                {"mean": "plastic_strain", "of": "mid"},
                "2/sqrt(3) ln(l/l0), within 15 %",
                strain,
                0.85 * strain,
                1.15 * strain,
            ),
            Measure(
                "flow",
                {"mean": "equivalent_stress", "of": "mid"},
                "Y of that strain, within 8 %",
                flow,
                0.92 * flow,
                1.08 * flow,
                "Pa",
            ),
            Measure(
                "density",
                {"minimum": "density", "of": "mid"},
                "elastic: 1 - (2 Y/sqrt(3))/(2 K), 0.995",
                2700,
                2600,
                None,
                "kg/m^3",
                "limit",
            ),
            Measure(
                "pieces", {"pieces": {}, "of": "mid"}, "it strains evenly until dY/de = Y", 1, 1, 1
            ),
        ],
    )


def patch(solver, material="fluid", lattice="square", pull=1e9, until=100e-6):
    """A square at rest under uniform tension between mirror walls stays at rest: all strains are
    held, and a stiff spring in tension is stable. One row in two is nudged by 1 m/s."""
    m = MATERIALS[material]
    case = start("plane-strain", solver, 1e-3, until)
    wave = "sin(pi*x/(2 mm))*sin(pi*y/(2 mm))"
    body = {
        "material": "m",
        "box": {"from": metres(0, 0), "to": metres(0.02, 0.02)},
        "pressure": unit(-pull, "Pa"),
        "velocity": [f"1 m/s*{wave}", "0 m/s"],
    }
    if lattice != "square":
        body["lattice"] = lattice
    walls = {
        "left": ("x", 0, "low"),
        "right": ("x", 0.02, "high"),
        "below": ("y", 0, "low"),
        "above": ("y", 0.02, "high"),
    }
    case.update(
        materials={"m": m.case},
        bodies={"b": body},
        probes={"b": {"body": "b"}},
        boundaries={
            name: {"kind": "reflecting", "axis": x, "at": unit(at, "m"), "side": side}
            for name, (x, at, side) in walls.items()
        },
    )
    source = "it rests under -p, and 1 m/s changes p by rho c u, 0.014 GPa, at most: within 5 %"
    name = f"patch/{solver}/{material}/{lattice}/{pull / 1e9:g}GPa" + (
        "" if until == 100e-6 else f"/{1e6 * until:g}us"
    )
    return Entry(
        name,
        case,
        [
            Measure(
                "kinetic",
                largest("b", "kinetic_energy", of_start=True),
                "motion is only lost: never above 1.01 of its start",
                1.0,
                None,
                1.01,
                kind="limit",
            ),
            Measure(
                "lowest", {"minimum": "pressure"}, source, -pull, -1.05 * pull, None, "Pa", "limit"
            ),
            Measure(
                "highest", {"maximum": "pressure"}, source, -pull, None, -0.95 * pull, "Pa", "limit"
            ),
        ]
        + conserved(False),
    )


def rest(
    solver, material="elastic", geometry="plane-strain", lattice="square", angle=0, boundary="walls"
):
    """A body in a uniform state stays in it: between mirror walls, within a frozen body of the same
    state and lattice, or with free surfaces and no pressure."""
    m, f = MATERIALS[material], Frame(geometry, angle)
    d, n = 1e-3, DIMENSION[geometry]
    size = (4 if geometry == "3d" else 6) * d
    wide = size + 6 * d  # of what is frozen: support and that of its own neighbours
    case = start(geometry, solver, d, 20 * size / m.sound)
    low = 0.0 if geometry == "axisymmetric" else -1.0

    def box(half):
        return {"box": {"from": metres(low * half, *[-half] * (n - 1)), "to": metres(*[half] * n)}}

    p, state = m.pressure, dict(m.state)
    if boundary == "free":
        p, state = 0.0, {}
    elif not state:
        p = 0.003 * m.bulk
        state = {"pressure": unit(p, "Pa")}
        if geometry == "plane-stress":  # the third stress is nothing, and p the mean of three
            state = {"stress": [unit(-1.5 * p, "Pa")] * 2 + ["0 Pa", "0 Pa"]}
    body = {"material": "m", **state}
    bodies = {"b": {**body, **rotated(box(size), angle)}}
    if boundary == "frozen":
        whole = rotated(box(wide), angle)
        bodies["b"] = {**body, "intersection": [whole, rotated(box(size), angle)]}
        hole = {"difference": [whole, rotated(box(size), angle)]}
        bodies["frame"] = {**body, **hole, "frozen": "yes"}
    for what in bodies.values():
        what.update({} if lattice == "square" else {"lattice": lattice})
    case.update(materials={"m": m.case}, bodies=bodies)
    if boundary == "walls":
        sides = {f"low_{x}": -size for x in "xyz"[:n] if x != "x" or low}
        case["boundaries"] = walls(**sides, **{f"high_{x}": size for x in "xyz"[:n]})
    cut = boundary != "free" and bool(lattice != "square" or angle)
    still = 0.01 * p / (m.density * m.sound) if cut else 1e-9 * m.sound
    kind = "limit" if cut else "exact"
    why = "uniform pressure has no force: rounding"
    if cut:
        why = "uniform pressure has no force; own limit where a lattice is cut: 1 % of p/(rho c)"
    near = (0.01 if cut else 1e-6) * p + 1e-9 * m.bulk
    of = {"of": "b"}
    return Entry(
        f"rest/{solver}/{material}/{f.name}/{lattice}/{boundary}",
        case,
        [
            Measure("speed", {"maximum": "speed", **of}, why, 0, None, still, "m/s", kind),
            Measure("lowest", {"minimum": "pressure", **of}, why, p, p - near, None, "Pa", kind),
            Measure("highest", {"maximum": "pressure", **of}, why, p, None, p + near, "Pa", kind),
        ],
    )


def pull(solver, material="elastic", geometry="plane-strain", lattice="square", angle=0, sign=1):
    """A bar between driven ends is drawn out (SIGN 1) or pressed together (-1) evenly, slowly
    against sound, with free sides. The velocity is linear at the start, along and across, so that
    no wave runs.
    """
    m, f = MATERIALS[material], Frame(geometry, angle)
    d = 1e-3
    half = (4 if geometry == "3d" else 6) * d
    length, grip = 3 * half, 3 * d
    strain = sign * {"ductile": 0.02, "plastic": 0.02, "rubber": 0.05}.get(material, 0.004)
    until = 20 * length / m.sound
    v = (math.exp(strain) - 1) * length / until
    case = start(geometry, solver, d, until)
    whole = f.bar(-length - grip, length + grip, half)
    cut = {
        "low": {"difference": [whole, f.beyond(-length, 1)]},
        "mid": {"difference": [whole, f.beyond(-length, -1), f.beyond(length, 1)]},
        "high": {"difference": [whole, f.beyond(length, -1)]},
    }
    if geometry == "1d":
        cut = {
            "low": f.bar(-length - grip, -length, 0),
            "mid": f.bar(-length, length, 0),
            "high": f.bar(length, length + grip, 0),
        }
    nu = 0.5 if m.yield_stress else m.across(geometry)
    if m.yield_stress and geometry == "plane-strain":
        nu = 1.0
    rate = v / length
    inward = f"{-nu * rate:.12g} 1/s*"
    bodies = {
        "low": {"material": "m", **cut["low"], "velocity": f.vector(-v), "driven": "yes"},
        "mid": {
            "material": "m",
            **cut["mid"],
            "velocity": f.vector(
                f"{rate:.12g} 1/s*{f.s()}",
                None if geometry == "1d" else inward + f.t(),
                inward + "z" if geometry == "3d" else None,
            ),
        },
        "high": {"material": "m", **cut["high"], "velocity": f.vector(v), "driven": "yes"},
    }
    if lattice != "square":
        for body in bodies.values():
            body["lattice"] = lattice
    case.update(materials={"m": m.case}, bodies=bodies)
    case["checks"] = f.stress_checks(of="mid", **f.middle(half))
    case["checks"].update(f.strain_checks(half, of="mid"))

    def exact(e):
        """The stress at the logarithmic strain E of the middle."""
        if not m.yield_stress:
            return m.thin(geometry) * e
        factor = 2 / math.sqrt(3) if geometry == "plane-strain" else 1.0
        b, n = m.hardening or (0.0, 1.0)
        plastic = abs(e) * factor
        for _ in range(50):
            flow = m.yield_stress + b * max(plastic, 0.0) ** n
            elastic = flow / (3 * m.shear) if geometry == "plane-strain" else flow / m.young
            plastic = abs(e) * factor - elastic
        if geometry == "1d":
            return m.bulk * (math.exp(e) - 1) + sign * 2 / 3 * flow
        return sign * factor * flow

    why = "E e, E/(1 - nu^2) e in plane strain, (K + 4 G/3) e on a line"
    if m.yield_stress:
        why = (
            "Y of the plastic strain, 2 Y/sqrt(3) in plane strain; K (exp e - 1) + 2 Y/3 on a line"
        )
    measures = [
        Measure(
            "stress/exact",
            lambda run: f.stress(run.checks) / exact(f.strain(run.checks)),
            why + ", at the strain of the middle; within 5 %",
            1,
            0.95,
            1.05,
        ),
        Measure("pieces", {"pieces": {}, "of": "mid"}, "it holds", 1, 1, 1),
    ]
    if not m.yield_stress:  # what hardens little may strain where it likes
        why = "even; own limit: driven ends hold what is beside them, with MPM a cell before it"
        strained = Measure(
            "strain/given", lambda run: f.strain(run.checks) / strain, why, 1, 0.75, 1.3
        )
        strained.kind = "limit"
        measures.append(strained)
    which = "pull" if sign > 0 else "press"
    return Entry(f"{which}/{solver}/{material}/{f.name}/{lattice}", case, measures)


def squeeze(solver, material="gas", geometry="plane-strain", lattice="square", ratio=1.25):
    """A fluid between a wall and a piston, 2 % of the sound speed, is pressed together or expands
    evenly: the velocity is linear and stays, pressure and energy follow the isentrope."""
    m = MATERIALS[material]
    d = 1e-3
    length, side = 60 * d, (4 if geometry == "3d" else 6) * d
    v = 0.02 * m.sound * (1 if ratio > 1 else -1)
    until = length * (1 - 1 / ratio) / v
    case = start(geometry, solver, d, until)
    about = geometry == "axisymmetric"
    x = "y" if about else "x"
    dimension = DIMENSION[geometry]

    def box(low, high):
        if about:
            return {"box": {"from": metres(0, low), "to": metres(side, high)}}
        more = [0] * (dimension - 1), [side] * (dimension - 1)
        return {"box": {"from": metres(low, *more[0]), "to": metres(high, *more[1])}}

    def along(speed):
        return ["0 m/s", speed] if about else [speed] + ["0 m/s"] * (dimension - 1)

    bodies = {
        "b": {
            "material": "m",
            **box(0, length),
            "velocity": along(f"{-v / length:.12g} 1/s*{x}"),
            **m.state,
        },
        "piston": {
            "material": "m",
            **box(length, length + 3 * d),
            "velocity": along(unit(-v, "m/s")),
            "driven": "yes",
            **m.state,
        },
    }
    if lattice != "square":
        for body in bodies.values():
            body["lattice"] = lattice
    sides = {f"low_{x}": 0}
    if about:
        sides["high_x"] = side
    else:
        for other in "xyz"[1:dimension]:
            sides.update({f"low_{other}": 0, f"high_{other}": side})
    case.update(materials={"m": m.case}, bodies=bodies, boundaries=walls(**sides))
    now = {"of": "b", "axis": x, "between": metres(0.25 * length / ratio, 0.75 * length / ratio)}
    case["checks"] = {"p": {"mean": "pressure", **now, "at_most": "1e300 Pa"}}
    pressure, energy = m.isentrope(ratio)

    def over_exact(run):
        return run.checks["p"] / m.isentrope(run.checks["density"] / m.density)[0]

    r, why = m.density * ratio, "isentrope from rest, integrated; within 2 %"
    scatter = "uniform; own limit 2 %"
    measures = [
        Measure("density", {"mean": "density", **now}, "mass over volume; own limit 2 %", r),
        Measure("p/exact", over_exact, why + ", at the density of the middle", 1, 0.98, 1.02),
        Measure(
            "scatter", {"spread": "pressure", **now}, scatter, 0, None, 0.02 * abs(pressure), "Pa"
        ),
    ]
    measures[0].low, measures[0].high, measures[0].unit = 0.98 * r, 1.02 * r, "kg/m^3"
    measures[2].kind = "limit"
    if m.energy:
        heat = Measure("heat", {"mean": "energy", **now}, why, energy, 0.98 * energy, 1.02 * energy)
        heat.unit = "J/kg"
        measures.append(heat)
    return Entry(f"squeeze/{solver}/{material}/{geometry}/{lattice}/{ratio:g}", case, measures)
