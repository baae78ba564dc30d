"""Rigid motion, rotation, waves, impact and separation.

Each function returns the Entry of one variation: the case, and what is measured in it. The exact
answer, its formula and where a limit comes from stand in the `why` of each measure. Solvers are
named without options: what is tested is what a user gets by writing nothing. Angles are degrees by
which a body, its motion and its loads are rotated against the lattice."""
import math

from entry import Entry, Measure, conserved, metres, rotated, speeds, start, unit
from materials import MATERIALS


def vacuum(solver, speed=20000.0):
    """A cold gas whose halves fly apart faster than it expands into vacuum, 2 c/(gamma - 1) = 5 c
    each: expansion cools (de/dt = -p/rho div u), and no gas is slower than u - 5 c."""
    m = MATERIALS["gas"]
    case = start("1d", solver, 2e-3, 25e-6)
    case.update(
        materials={"m": m.case},
        bodies={
            "all": {
                "material": "m",
                "box": {"from": metres(-0.5), "to": metres(0.5)},
                "pressure": "40 kPa",
                "velocity": [f"{unit(speed, 'm/s')}*(2*(x > 0 m) - 1)"],
            }
        },
    )
    c = math.sqrt(1.4 * 40e3)
    return Entry(
        f"vacuum/{solver}/1d/{speed / 1e3:g}km/s".replace("km/s", "kmps"),
        case,
        [
            Measure(
                "heated",
                {"maximum": "energy"},
                "expansion cools: no more than the 0.1 MJ/kg of the start",
                1e5,
                None,
                1.001e5,
                "J/kg",
            ),
            Measure(
                "gap",
                {"minimum": "speed"},
                "no gas is slower than u - 2 c/(gamma - 1)",
                speed,
                speed - 5 * c,
                None,
                "m/s",
            ),
            *conserved(False, 1e-12),
        ],
    )


def rod(solver, across=8):
    """Taylor's copper rod, linear hardening, 227 m/s: benchmark of Kamoulakos (1990), Zhu and
    Cescotto (1995), Camacho and Ortiz (1997): length 21.4 to 21.7 mm, foot 6.9 to 7.25 mm, strain
    2.4 to 3.3 [recalled].
    """
    m = MATERIALS["copper"]
    case = start("axisymmetric", solver, 3.2e-3 / across, 80e-6)
    case.update(
        materials={"m": m.case},
        bodies={
            "rod": {
                "material": "m",
                "box": {"from": metres(0, 0), "to": metres(3.2e-3, 32.4e-3)},
                "velocity": speeds(0, -227),
            }
        },
        walls={"anvil": {"mirror": "y", "at": "0 m", "side": "low"}},
    )
    foot = {"extent": {"along": "x", "edges": "yes"}}
    source = "codes and papers on this benchmark [recalled]"
    measures = [
        Measure(
            "length",
            {"extent": {"along": "y", "edges": "yes"}},
            source,
            21.5e-3,
            21.3e-3,
            21.7e-3,
            "m",
        ),
        Measure("foot", foot, source, 7.1e-3, 6.9e-3, 7.25e-3, "m"),
        Measure("strain", {"maximum": "plastic_strain"}, source, 2.9, 2.4, 3.3),
    ]
    if solver != "mpm":
        measures.append(
            Measure(
                "foot of mpm",
                lambda run: run.checks["foot"],
                "within 3 % of MPM's at the same spacing",
                None,
                lambda r: 0.97 * r,
                lambda r: 1.03 * r,
                "m",
                "limit",
                (rod("mpm", across), "foot"),
            )
        )
    return Entry(f"rod/{solver}/across-{across}", case, measures + conserved(False))
