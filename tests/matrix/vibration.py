"""Elastic vibration: beams, bars, rings.

Each function returns the Entry of one variation: the case, and what is measured in it. The exact
answer, its formula and where a limit comes from stand in the `why` of each measure. Solvers are
named without options: what is tested is what a user gets by writing nothing. Angles are degrees by
which a body, its motion and its loads are rotated against the lattice."""
import math

from entry import (
    Entry,
    Measure,
    conserved,
    largest,
    metres,
    rotated,
    speeds,
    start,
    time_of_largest,
    unit,
)
from materials import MATERIALS


def bending_period(length, height, modulus, shear, density, poisson):
    """First bending mode of a free Timoshenko beam, s: Huang, J. Appl. Mech. 28 (1961) 579,
    free-free, with the shear coefficient 10 (1 + nu)/(12 + 11 nu) of Cowper, J. Appl. Mech. 33
    (1966) 335, for a rectangle.
    """
    area, inertia = height, height**3 / 12
    coefficient = 10 * (1 + poisson) / (12 + 11 * poisson)
    r2 = inertia / (area * length**2)
    s2 = modulus * inertia / (coefficient * shear * area * length**2)

    def determinant(b):
        root = math.sqrt((r2 - s2) ** 2 + 4 / b**2)
        alpha, beta = math.sqrt((root - r2 - s2) / 2), math.sqrt((root + r2 + s2) / 2)
        return (
            2
            - 2 * math.cosh(b * alpha) * math.cos(b * beta)
            + b
            / math.sqrt(1 - b * b * r2 * s2)
            * (b * b * r2 * (r2 - s2) ** 2 + 3 * r2 - s2)
            * math.sinh(b * alpha)
            * math.sin(b * beta)
        )

    low, high = 10.0, 22.5  # without shear and rotary inertia: 22.373
    for _ in range(60):
        middle = (low + high) / 2
        if determinant(low) * determinant(middle) > 0:
            low = middle
        else:
            high = middle
    omega = low / length**2 * math.sqrt(modulus * inertia / (density * area))
    return 2 * math.pi / omega


def beam(
    solver,
    material="aluminium",
    geometry="plane-strain",
    lattice="square",
    angle=0,
    across=10,
    reference=True,
):
    """A free beam in its first bending mode. Nothing is lost in an elastic body; the motion at the
    start holds a little of higher modes, which do not come back at the same time: a converged
    calculation recovers 0.95.
    """
    m = MATERIALS[material]
    length, height = (0.1, 0.01) if geometry != "3d" else (0.06, 0.006)
    d = height / across
    v, half = m.speed, length / 2
    period = bending_period(length, height, m.thin(geometry), m.shear, m.density, m.poisson)
    case = start(geometry, solver, d, 0.58 * period)
    a = math.radians(angle)
    along = f"x*{math.cos(a):.15g} + y*{math.sin(a):.15g}"
    shape = f"{unit(v, 'm/s')}*((({along})/{unit(half, 'm')})^2*1.6 - 0.533)"
    low, high = [-half, -height / 2], [half, height / 2]
    velocity = [f"{-math.sin(a):.15g}*{shape}", f"{math.cos(a):.15g}*{shape}"]
    if geometry == "3d":
        wide = 4 * d / 2
        low, high, velocity = low + [-wide], high + [wide], velocity + ["0 m/s"]
    body = {
        "material": "m",
        **rotated({"box": {"from": metres(*low), "to": metres(*high)}}, angle),
        "velocity": velocity,
    }
    if lattice != "square":
        body["lattice"] = lattice
    case.update(
        materials={"m": m.case},
        bodies={"b": body},
        probes={"b": {"body": "b", "every": unit(period / 400, "s")}},
    )
    window = (0.35 * period, 0.58 * period)
    source = "an elastic body loses nothing; some is in higher modes; limit of the study"
    measures = [
        Measure(
            "recovered",
            largest("b", "kinetic_energy", *window, of_start=True),
            source,
            1.0,
            0.85,
            1.001,
            kind="limit",
        ),
        Measure(
            "half period",
            time_of_largest("b", "kinetic_energy", *window),
            "Timoshenko beam (Huang 1961, Cowper 1966), within 5 %",
            period / 2,
            0.475 * period,
            0.525 * period,
            "s",
        ),
    ]
    name = f"beam/{solver}/{material}/{geometry}/{lattice}/{angle}deg/across-{across}"
    if reference and solver != "mpm":
        same = beam(solver, material, geometry, across=across, reference=False)
        if angle or lattice != "square":
            measures.append(
                Measure(
                    "of unrotated",
                    measures[0].how,
                    "within 0.05 of the same beam at 0 degrees on a square lattice",
                    None,
                    lambda r: r - 0.05,
                    None,
                    kind="limit",
                    reference=(same, "recovered"),
                )
            )
        fine = beam("mpm", material, geometry, across=2 * across, reference=False)
        measures.append(
            Measure(
                "period of mpm",
                measures[1].how,
                "within 3 % of MPM's at double resolution",
                None,
                lambda r: 0.97 * r,
                lambda r: 1.03 * r,
                "s",
                "limit",
                (fine, "half period"),
            )
        )
    return Entry(name, case, measures + conserved())


def ring(solver, material="rubber", lattice="square", across=10):
    """A free ring let go in its oval mode."""
    m = MATERIALS[material]
    inner, outer, middle = 0.03, 0.04, 0.035
    thickness = outer - inner
    v = m.speed
    # Inextensional mode n = 2 of a thin ring: omega^2 = n^2 (n^2 - 1)^2/(n^2 + 1) E' I/(rho A R^4)
    # (Love, 1927, art. 293).
    omega = math.sqrt(
        36 / 5 * m.thin("plane-strain") * thickness**2 / 12 / (m.density * middle**4)
    )
    half = math.pi / omega
    case = start("plane-strain", solver, thickness / across, 1.55 * half)
    body = {
        "material": "m",
        "shell": {"center": metres(0, 0), "inner": unit(inner, "m"), "outer": unit(outer, "m")},
        "velocity": [
            f"-{unit(v, 'm/s')}*x/{unit(middle, 'm')}",
            f"{unit(v, 'm/s')}*y/{unit(middle, 'm')}",
        ],
    }
    if lattice != "square":
        body["lattice"] = lattice
    case.update(
        materials={"m": m.case},
        bodies={"b": body},
        probes={"b": {"body": "b", "every": unit(half / 100, "s")}},
    )
    window = (0.66 * half, 1.55 * half)
    source = "an elastic body loses nothing; some is in extensional modes; limit of the study"
    return Entry(
        f"ring/{solver}/{material}/{lattice}/across-{across}",
        case,
        [
            Measure(
                "recovered",
                largest("b", "kinetic_energy", *window, of_start=True),
                source,
                1.0,
                0.85,
                1.001,
                kind="limit",
            ),
            Measure(
                "half period",
                time_of_largest("b", "kinetic_energy", *window),
                "thin ring (Love, art. 293); the thickness lowers the frequency by some 8 %",
                half,
                0.95 * half,
                1.2 * half,
                "s",
                "limit",
            ),
        ]
        + conserved(),
    )


def rings(solver, lattice="square", resolution=1e-3):
    """Two rubber rings bounce: Gray, Monaghan and Swift, Comput. Methods Appl. Mech. Engrg. 190
    (2001) 6641, with 0.059 of the bulk sound speed each. They leave at about 5.6 m/s."""
    m = MATERIALS["rubber"]
    v = 0.059 * math.sqrt(m.bulk / m.density)
    case = start("plane-strain", solver, resolution, 16e-3)

    def body(sign):
        what = {
            "material": "m",
            "shell": {"center": metres(sign * 0.041, 0), "inner": "0.03 m", "outer": "0.04 m"},
            "velocity": speeds(-sign * v, 0),
        }
        if lattice != "square":
            what["lattice"] = (
                lattice if lattice != "rings" or sign < 0 else {"rings": {"start": "180 deg"}}
            )
        return what

    case.update(
        materials={"m": m.case},
        bodies={"left": body(-1), "right": body(1)},
        contacts={"c": {"between": ["left", "right"], "shear": "slip", "tension": "none"}},
        probes={"right": {"body": "right", "every": "0.1 ms"}},
    )
    leave = largest("right", "velocity.x", 12e-3)
    measures = [
        Measure(
            "leave",
            leave,
            "Gray et al., read off: 5.6 m/s; tolerance 20 %",
            5.6,
            4.48,
            6.72,
            "m/s",
            "limit",
        )
    ]
    name = f"rings/{solver}/{lattice}/{1e3 * resolution:g}mm"
    if solver != "mpm":
        measures.append(
            Measure(
                "of mpm",
                leave,
                "within 15 % of MPM's",
                None,
                lambda r: 0.85 * r,
                lambda r: 1.15 * r,
                "m/s",
                "limit",
                (rings("mpm", resolution=resolution), "leave"),
            )
        )
    return Entry(name, case, measures + conserved())
