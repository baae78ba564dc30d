"""Bodies at rest, and uniform tension and compression.

Each function returns the Entry of one variation: the case, and what is measured in it. The exact
answer, its formula and where a limit comes from stand in the `why` of each measure. Solvers are
named without options: what is tested is what a user gets by writing nothing. Angles are degrees by
which a body, its motion and its loads are rotated against the lattice."""
import math

from entry import Entry, Measure, conserved, largest, metres, rotated, speeds, start, unit
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
        walls={
            name: {"mirror": x, "at": unit(at, "m"), "side": side}
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
