"""Which variations of the problems are run."""
from held import patch, strip
from moving import rod, vacuum
from vibration import beam, ring, rings


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
        for material, lattice in (
            ("rubber", "square"),
            ("rubber", "hexagonal"),
            ("rubber", "rings"),
            ("aluminium", "square"),
        ):
            yield ring(solver, material, lattice)
        for lattice in ("square", "hexagonal", "rings"):
            yield rings(solver, lattice)
        for resolution in (1e-3, 0.5e-3, 0.25e-3):
            for lattice in ("square", "hexagonal"):
                for angle in (0, 20):
                    yield strip(solver, resolution, lattice, angle)
        for material in ("fluid", "aluminium"):
            for lattice in ("square", "hexagonal"):
                for pull in (0.5e9, 1e9, 2e9):
                    yield patch(solver, material, lattice, pull)
        yield vacuum(solver)
        yield rod(solver)


def short(solvers):
    """What `make test` runs: every problem, every solver."""
    for solver in solvers:
        yield beam(solver, reference=False)
        yield beam(solver, angle=30, reference=False)
        yield ring(solver, across=5)
        yield strip(solver, 1e-3, angle=20)
        yield patch(solver, until=30e-6)
        yield vacuum(solver)
        yield rod(solver)
