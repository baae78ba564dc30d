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
from frame import Frame, walls
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
    moment = time_of_largest("b", "kinetic_energy", *window)
    mass = m.density * length * height * (4 * d if geometry == "3d" else 1)

    def half_period(run):
        # A lattice cuts a rotated beam to another thickness; the period is inverse to it.
        return moment(run) * run.probe("b")["mass"][0] / mass

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
            half_period,
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


def bar(solver, material="elastic", geometry="plane-strain", lattice="square", angle=0, across=6):
    """A free bar in its first longitudinal mode, u = V cos(pi s/L)."""
    m, f = MATERIALS[material], Frame(geometry, angle)
    d = 1e-3
    length, height = (10 * across * d, across * d)
    half = height if geometry == "axisymmetric" else height / 2
    if geometry == "axisymmetric":
        length *= 2
    # Love's inertia of the motion across: omega = omega_0/sqrt(1 + (nu k r)^2), r the polar radius
    # of gyration of the section about the axis, k = pi/L; on a line there is none.
    gyration = {"1d": 0, "axisymmetric": half**2 / 2, "3d": 2 * height**2 / 12}.get(
        geometry, height**2 / 12
    )
    slow = math.sqrt(1 + (m.across(geometry) * math.pi / length) ** 2 * gyration)
    period = 2 * length / math.sqrt(m.thin(geometry) / m.density) * slow
    case = start(geometry, solver, d, 0.6 * period)
    speed = f"{unit(-m.speed, 'm/s')}*sin(pi*{f.s()}/{unit(length, 'm')})"
    body = {"material": "m", **f.bar(-length / 2, length / 2, half), "velocity": f.vector(speed)}
    if lattice != "square":
        body["lattice"] = lattice
    case.update(
        materials={"m": m.case},
        bodies={"b": body},
        probes={"b": {"body": "b", "every": unit(period / 400, "s")}},
    )
    window = (0.35 * period, 0.6 * period)
    recovered = largest("b", "kinetic_energy", *window, of_start=True)
    return Entry(
        f"bar/{solver}/{material}/{f.name}/{lattice}",
        case,
        [
            Measure(
                "recovered",
                recovered,
                "an elastic body loses nothing",
                1,
                0.85,
                1.001,
                kind="limit",
            ),
            Measure(
                "half period",
                time_of_largest("b", "kinetic_energy", *window),
                "L/sqrt(E/rho) with Love's inertia across; within 5 %",
                period / 2,
                0.475 * period,
                0.525 * period,
                "s",
            ),
        ]
        + conserved(geometry != "axisymmetric"),
    )


def standing(
    solver, material="elastic", geometry="plane-strain", lattice="square", angle=0, kind="p"
):
    """A standing wave between mirror walls whose wave vector has the angle to the lattice. With kx
    = pi/Lx, ky = pi/Ly: u = grad cos(kx x) cos(ky y) for a P wave, u = curl sin(kx x) sin(ky y) for
    an S wave; both have no velocity across the walls and no shear at them, and omega = c |k|."""
    m = MATERIALS[material]
    d, half_wave = 1e-3, 16e-3
    a = math.radians(angle)
    lx = half_wave / math.cos(a)
    ly = half_wave / math.sin(a) if angle else 8 * d
    lx, ly = (2 * d * round(x / (2 * d)) for x in (lx, ly))  # on planes of the grid of MPM
    kx, ky = math.pi / lx, math.pi / ly if angle else 0.0
    k = math.hypot(kx, ky)
    modulus = m.shear if kind == "s" else m.bulk + 4 / 3 * m.shear
    if geometry == "plane-stress" and kind == "p":
        modulus = m.young / (1 - m.poisson**2) if m.solid else 0.0
    c = math.sqrt(modulus / m.density)
    period = 2 * math.pi / (c * k)
    case = start(geometry, solver, d, 0.6 * period)
    v = 1e-3 * c
    x, y = f"{kx:.12g} 1/m*x", f"{ky:.12g} 1/m*y"
    px, py = (kx / k, ky / k) if kind == "p" else (ky / k, -kx / k)
    if geometry == "axisymmetric":
        # Radial: u = V J1(k r) with k R = 3.8317, the first zero; J1(s) = sum (-1)^i
        # (s/2)^(2i+1)/(i! (i+1)!).
        lx, ly = half_wave, 8 * d
        k = 3.831705970207512 / lx
        period = 2 * math.pi / (c * k)
        case["run"]["until"] = unit(0.6 * period, "s")
        s = f"({k / 2:.12g} 1/m*x)"
        terms = [
            f"{(-1) ** i / (math.factorial(i) * math.factorial(i + 1)):+.12g}*{s}^{2 * i + 1}"
            for i in range(10)
        ]
        velocity = [f"{unit(v, 'm/s')}*({' '.join(terms)})", "0 m/s"]
    elif geometry == "1d":
        velocity = [f"{unit(v, 'm/s')}*sin({x})"]
    elif kind == "s" and not angle:
        velocity = ["0 m/s", f"{unit(v, 'm/s')}*cos({x})"]
    else:
        velocity = [
            f"{unit(v * px, 'm/s')}*sin({x})*cos({y})",
            f"{unit(v * py, 'm/s')}*cos({x})*sin({y})",
        ]
    sides = {"low_x": 0, "high_x": lx}
    top = [lx]
    if geometry != "1d":
        sides.update(low_y=0, high_y=ly)
        top.append(ly)
    if geometry == "3d":
        sides.update(low_z=0, high_z=6 * d)
        top.append(6 * d)
        velocity.append("0 m/s")
    if geometry == "axisymmetric":
        del sides["low_x"]
    body = {
        "material": "m",
        "box": {"from": metres(*[0] * len(top)), "to": metres(*top)},
        "velocity": velocity,
        **m.state,
    }
    if lattice != "square":
        body["lattice"] = lattice
    case.update(
        materials={"m": m.case},
        bodies={"b": body},
        boundaries=walls(**sides),
        probes={"b": {"body": "b", "every": unit(period / 400, "s")}},
    )
    window = (0.35 * period, 0.6 * period)
    recovered = largest("b", "kinetic_energy", *window, of_start=True)
    where = geometry + (f"/{angle}deg" if angle else "")
    return Entry(
        f"wave-{kind}/{solver}/{material}/{where}/{lattice}",
        case,
        [
            Measure(
                "recovered",
                recovered,
                "sound of small amplitude loses nothing; own limit at 16 particles in half a wave",
                1,
                0.9,
                1.01,
                kind="limit",
            ),
            Measure(
                "half period",
                time_of_largest("b", "kinetic_energy", *window),
                "pi/(c |k|), own limit 6 % at 16 particles in half a wave",
                period / 2,
                0.47 * period,
                0.53 * period,
                "s",
                "limit",
            ),
        ]
        + conserved(False),
    )
