"""Which variations of the problems are run."""
import itertools
import random

from held import patch, pull, rest, squeeze, strip
from moving import bounce, burst, impact, move, part, porous, rod, spin, vacuum
from vibration import bar, beam, ring, rings, standing

GEOMETRIES = ("1d", "plane-strain", "plane-stress", "axisymmetric", "3d")
ANGLES = (0, 17, 30, 45)
LATTICES = ("square", "hexagonal")
SOLIDS = ("elastic", "rubber", "plastic")


def possible(geometry="plane-strain", lattice="square", angle=0, material="elastic", **_):
    """Whether a case can ask for it: lattices and angles need a plane, plane stress a solid."""
    plane = geometry in ("plane-strain", "plane-stress")
    if lattice != "square" and not plane and geometry != "axisymmetric":
        return False
    if angle and not (plane or geometry == "3d"):
        return False
    if geometry == "plane-stress" and material in ("fluid", "water", "gas", "products"):
        return False
    return True


def standing_possible(geometry, material, angle, kind, **_):
    shear = material not in ("fluid", "water", "gas", "products")
    return not (kind == "s" and (not shear or geometry in ("1d", "axisymmetric")))


def rest_possible(material, boundary, geometry, **_):
    if boundary == "frozen" and geometry == "3d":  # many particles that stand still
        return False
    return not (boundary == "free" and material in ("gas", "products"))


# Problem, its axes, and which combinations exist.
AXES = {
    "rest": (
        rest,
        {
            "geometry": GEOMETRIES,
            "lattice": LATTICES,
            "angle": (0,),
            "material": ("elastic", "rubber", "plastic", "water", "gas", "products"),
            "boundary": ("walls", "frozen", "free"),
        },
        rest_possible,
    ),
    "rest rotated": (
        rest,
        {
            "geometry": ("plane-strain", "plane-stress", "3d"),
            "lattice": LATTICES,
            "angle": ANGLES[1:],
            "material": ("elastic", "water", "gas", "products"),
            "boundary": ("frozen", "free"),
        },
        rest_possible,
    ),
    "move": (
        move,
        {
            "geometry": GEOMETRIES,
            "lattice": LATTICES,
            "angle": ANGLES,
            "material": ("elastic", "rubber", "plastic", "water"),
            "boundary": ("free",),
        },
        None,
    ),
    "move along": (
        move,
        {
            "geometry": GEOMETRIES[:4],
            "lattice": LATTICES,
            "angle": ANGLES,
            "material": ("gas", "products"),
            "boundary": ("frozen",),
        },
        None,
    ),
    "spin": (
        spin,
        {
            "geometry": ("plane-strain", "plane-stress", "3d"),
            "lattice": ("square", "hexagonal", "rings"),
            "angle": ANGLES,
            "material": SOLIDS,
        },
        lambda lattice, angle, **_: lattice != "rings" or not angle,
    ),
    "pull": (
        pull,
        {
            "geometry": GEOMETRIES,
            "lattice": LATTICES,
            "angle": ANGLES,
            "material": ("elastic", "rubber", "plastic", "ductile"),
            "sign": (1, -1),
        },
        lambda material, geometry, **_: not (material == "ductile" and geometry == "1d"),
    ),
    "squeeze": (
        squeeze,
        {
            "geometry": ("1d", "plane-strain", "axisymmetric", "3d"),
            "lattice": LATTICES,
            "material": ("gas", "water", "products"),
            "ratio": (1.25, 0.8),
        },
        lambda material, ratio, **_: not (material == "water" and ratio < 1),
    ),
    "bar": (
        bar,
        {
            "geometry": GEOMETRIES,
            "lattice": LATTICES,
            "angle": ANGLES,
            "material": ("elastic", "rubber"),
        },
        None,
    ),
    "beam": (
        beam,
        {
            "geometry": ("plane-strain", "plane-stress"),
            "lattice": LATTICES,
            "angle": ANGLES,
            "material": ("aluminium", "rubber"),
            "reference": (False,),
        },
        None,
    ),
    "wave": (
        standing,
        {
            "geometry": GEOMETRIES,
            "lattice": LATTICES,
            "angle": ANGLES,
            "kind": ("p", "s"),
            "material": ("elastic", "rubber", "water", "gas", "products"),
        },
        standing_possible,
    ),
    "impact": (
        impact,
        {
            "geometry": GEOMETRIES,
            "lattice": LATTICES,
            "angle": ANGLES,
            "mach": (0.02, 0.05),
            "material": ("elastic", "rubber", "plastic", "water", "gas", "products"),
        },
        lambda material, geometry, **_: not (geometry == "plane-stress"),
    ),
    "part": (
        part,
        {
            "geometry": GEOMETRIES,
            "lattice": LATTICES,
            "angle": ANGLES,
            "material": ("elastic", "rubber", "plastic", "water"),
        },
        None,
    ),
    "vacuum": (
        vacuum,
        {
            "geometry": ("1d", "plane-strain", "axisymmetric", "3d"),
            "lattice": LATTICES,
            "angle": ANGLES,
        },
        None,
    ),
    "bounce": (
        bounce,
        {"geometry": ("1d", "plane-strain"), "material": ("elastic", "rubber")},
        None,
    ),
    "burst": (
        burst,
        {"geometry": ("1d", "plane-strain", "axisymmetric", "3d"), "ratio": (3, 30, 1000)},
        None,
    ),
    "porous": (porous, {"lattice": LATTICES}, None),
}


def every(problem, solver):
    """All variations of a problem as keyword arguments."""
    _, axes, exists = AXES[problem]
    for values in itertools.product(*axes.values()):
        what = dict(zip(axes, values))
        if not possible(**what) or (exists and not exists(**what)):
            continue
        if solver == "mpm" and what.get("geometry") == "plane-stress":
            continue
        yield what


def pairs(problem, solver, seed):
    """Variations, chosen by the seed, in which every two values of different axes that can go
    together do."""
    left = list(every(problem, solver))
    random.Random(f"{seed} {problem}").shuffle(left)
    of = [
        set(itertools.combinations(sorted(what.items(), key=str), 2)) or {tuple(what.items())}
        for what in left
    ]
    missing = set().union(*of) if of else set()
    while missing:
        best = max(range(len(left)), key=lambda i: len(of[i] & missing))
        missing -= of[best]
        yield left[best]


def chosen(solvers, seed, all_of_them=False):
    for problem, (make, _, _) in AXES.items():
        for solver in solvers:
            for what in every(problem, solver) if all_of_them else pairs(problem, solver, seed):
                yield make(solver, **what)


def done(solvers):
    """What the default of SPH must reach, and MPM beside it."""
    for solver in solvers:
        for across in (10, 20):
            for material in ("aluminium", "rubber"):
                for angle in range(0, 50, 5) if solver != "mpm" else (0, 30):
                    yield beam(solver, material, angle=angle, across=across)
        for material in ("aluminium", "rubber"):
            for angle in (0, 20, 30):
                yield beam(solver, material, "3d", angle=angle, across=6)
        for lattice in ("square", "hexagonal", "rings"):
            yield ring(solver, "rubber", lattice)
        yield ring(solver, "aluminium")
        for lattice in ("square", "hexagonal", "rings"):
            yield rings(solver, lattice)
        for resolution in (1e-3, 0.5e-3, 0.25e-3):
            for lattice in ("square", "hexagonal"):
                for angle in (0, 20):
                    yield strip(solver, resolution, lattice, angle)
        for material in ("fluid", "aluminium"):
            for lattice in ("square", "hexagonal"):
                for pull_by in (0.5e9, 1e9, 2e9):
                    yield patch(solver, material, lattice, pull_by)
        yield vacuum(solver)
        yield rod(solver)


def short(solvers):
    """What `make test` runs: every problem, every solver."""
    for solver in solvers:
        yield rest(solver, "water", lattice="hexagonal")
        yield rest(solver, "products", "axisymmetric")
        yield rest(solver, "elastic", "plane-strain", angle=30, boundary="frozen")
        yield move(solver, "rubber", "plane-strain", "hexagonal", 17)
        yield move(solver, "plastic", "3d", angle=45)
        yield spin(solver, "elastic", "3d")
        yield pull(solver, "elastic", "plane-strain", "hexagonal", 17)
        yield pull(solver, "ductile", "axisymmetric", sign=-1)
        yield squeeze(solver, "gas", "1d", ratio=0.8)
        yield squeeze(solver, "products", "axisymmetric")
        yield beam(solver, reference=False)
        yield beam(solver, angle=30, reference=False)
        yield bar(solver, "rubber", "plane-strain", angle=30)
        yield bar(solver, "elastic", "1d")
        yield ring(solver, across=5)
        yield standing(solver, "water", angle=30)
        yield standing(solver, "elastic", angle=45, kind="s")
        yield standing(solver, "gas", "axisymmetric")
        yield strip(solver, 1e-3, angle=20)
        yield patch(solver, until=30e-6)
        yield impact(solver, "plastic", "1d")
        yield impact(solver, "rubber", angle=17)
        yield part(solver, "elastic", angle=45)
        yield bounce(solver)
        yield vacuum(solver)
        yield vacuum(solver, "plane-strain", 30)
        yield burst(solver, "1d")
        yield porous(solver)
        yield rod(solver)
