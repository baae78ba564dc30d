"""The Python package: the examples of its page print what the page shows; unknown names, mistakes of
a case, sweeps, coupled runs and failed runs are answered by name."""
import os
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
SOURCE = pathlib.Path(os.environ["BOLIDE_SOURCE_DIR"])
sys.path[:0] = [str(SOURCE / "python"), str(SOURCE / "scripts")]

import numpy

import bolide
import page_outputs

FAILED = []
CASE = {
    "format": 1, "dimension": 1, "resolution": "0.1 mm", "solver": "sph",
    "let": {"speed": "300 m/s"},
    "materials": {"steel": {"library": "steel-1006"}},
    "bodies": {"flyer": {"material": "steel", "box": {"from": ["-2 mm"], "to": ["0 mm"]},
                         "velocity": ["speed"]},
               "target": {"material": "steel", "box": {"from": ["0 mm"], "to": ["4 mm"]}}},
    "run": {"until": "0.2 us"},
    "probes": {"gauge": {"gauge": ["1 mm"], "every": "20 ns"}},
    "profiles": {"along": {"fields": "pressure", "along": "x"}},
    "checks": {"least": {"maximum": "pressure", "at_least": "1000 GPa"}},
}


def expect(true, what):
    if not true:
        FAILED.append(what)
        print("FAILED:", what)


def raised(kind, words, call):
    """CALL raises KIND, whose text has WORDS."""
    try:
        call()
    except kind as error:
        expect(words in str(error), f"{kind.__name__}: {error}: without {words!r}")
        return error
    expect(False, f"{words!r}: nothing was raised")
    return None


def examples():
    page = SOURCE / "docs" / "tasks" / "python.md"
    shown = page_outputs.printed(page, os.environ["BOLIDE"])
    expect(shown == page_outputs.record_of(page).read_text(),
           f"the examples print something else:\n{shown}")


def runs():
    case = bolide.Case.of(CASE, "case.yaml")
    expect("forecast" in case.check() or "steps" in case.check(), "check prints no forecast")
    case.set("output.fragments", True)
    run = case.run("plain", threads=1, overwrite=True)  # its check fails, which raises nothing
    expect(run.status == "finished" and not run.checks["least"].passed, "a failed check")
    expect(run.checks["least"].unit == "Pa" and run.checks["least"].low == 1e12, "its limit")
    raised(bolide.Refused, "--overwrite", lambda: case.run("plain"))
    raised(bolide.Refused, "expected a velocity",
           lambda: bolide.Case("case.yaml").set("let.speed", "3 kg").check())
    raised(bolide.UnknownName, "did you mean gauge", lambda: run.probes["gage"])
    raised(bolide.UnknownName, "did you mean pressure", lambda: run.snapshots[0]["presure"])
    raised(bolide.UnknownName, "velocity.x", lambda: run.snapshots[0]["velocity.w"])
    raised(bolide.UnknownName, "did you mean target", lambda: run.snapshots[0].where("taget"))
    raised(KeyError, "did you mean velocity", lambda: run.probes["gauge"]["velocty.x"])
    raised(ValueError, "number", lambda: run.snapshots[0].mean("pressure", weights="size"))
    raised(FileNotFoundError, "no results", lambda: bolide.Results("."))
    raised(ValueError, "short", lambda: bolide.Case("case.yaml", form="quick"))

    gauge, last = run.probes["gauge"], run.snapshots[-1]
    expect(gauge["velocity"].shape == (len(gauge), 1), "a vector of a table")
    expect((gauge["velocity"][:, 0] == gauge["velocity.x"]).all(), "its first component")
    expect(run.history["momentum"].shape == (len(run.history), 3), "a vector of three")
    expect(gauge.unit("velocity") == "m/s" and "velocity" in gauge, "its unit")
    expect(len(run.profiles["along"]) == len(run.snapshots), "a profile a snapshot")
    flyer = last.where("flyer")
    expect(flyer.sum() == 20 and len(last) == 60, "members of a body")
    by_hand = (last["velocity"][flyer] * last["mass"][flyer, None]).sum(0) / last["mass"][flyer].sum()
    expect(numpy.allclose(last.mean("velocity", flyer), by_hand), "a mean by mass")
    sums, _ = last.histogram("speed", bins=5, weights="number")
    expect(sums.sum() == 60, "a histogram by number")
    total = run.history["mass"][0]
    expect(abs(last.weights("mass").sum() / total - 1.0) < 1e-6, "the mass of a snapshot")
    expect(run.at(0.0).step == 0 and run.at(1.0).step == last.step, "the nearest snapshot")

    bare = bolide.Case("case.yaml").set("output.snapshots", "no")
    raised(FileNotFoundError, "has no snapshots", lambda: bare.run("bare", overwrite=True).at(0.0))
    bare.set("gravity", ["10 m/s^2"]).set("run.until", "0.25 us")
    raised(bolide.Refused, "--change", lambda: bare.run("bare", resume=True))
    expect(bare.run("bare", resume=True, change=True).history["time"][-1] == 0.25e-6,
           "a run that goes on with another key")

    failed = raised(bolide.Failed, "energy", lambda: bolide.Case("case.yaml").set(
        "run.energy_drift", 1e-30).set("solver", {"sph": {"method": "standard"}}).run(
            "drifted", overwrite=True))
    expect(failed is not None and failed.status == 3, "the status of a failure")
    expect(bolide.Results("drifted").status == "failed", "the results of a failure")


def sweeps():
    case = bolide.Case.of({**CASE, "sweep": {"speed": ["100 m/s", "200 m/s"]}}, "sweep.yaml")
    sweep = case.run("sweep", overwrite=True)
    expect(list(sweep.sweep["speed"]) == [100.0, 200.0], "the values of a sweep")
    raised(FileNotFoundError, "is a sweep and has no summary or status", lambda: sweep.status)
    raised(FileNotFoundError, "is a sweep and has no snapshots", lambda: sweep.at(0.0))
    expect([run.checks["least"].value for run in sweep.runs.values()] ==
           list(sweep.sweep["least"]), "the runs of a sweep")


def gas():
    """Cells, two populations of one run, and blocked cells."""
    case = bolide.Case(SOURCE / "examples" / "coupling" / "gas-gun", form="short")
    run = case.set("run.max_steps", 5).run("coupled", threads=1, overwrite=True)
    first = run.snapshots[0]
    cells = first.others["gas"] if "gas" in first.others else first
    expect(cells["position"].shape == (len(cells), 3), "centres of cells")
    expect(numpy.isfinite(cells["pressure"]).all(), "a blocked cell is a cell")


def install():
    """The package works where it is installed."""
    shutil.rmtree("there", ignore_errors=True)
    build = pathlib.Path(os.environ["BOLIDE"]).parent
    subprocess.run(["cmake", "--install", build, "--prefix", pathlib.Path("there").resolve(),
                    "--component", "program"], check=True, stdout=subprocess.DEVNULL)
    found = list(pathlib.Path("there").glob("lib/python*/*-packages/bolide/__init__.py"))
    expect(len(found) == 1, f"the package is installed in {found}")
    environment = {key: value for key, value in os.environ.items() if key != "BOLIDE"}
    words = f"import sys; sys.path.insert(0, {str(found[0].parent.parent.resolve())!r}); " \
            "import bolide; print(bolide.Case('case.yaml').check())"
    environment["PATH"] = "/usr/bin:/bin"
    run = subprocess.run([sys.executable, "-B", "-c", words], env=environment, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    expect(run.returncode == 0, f"the installed package: {run.stdout}")


for part in (runs, sweeps, gas, install, examples):
    part()
sys.exit(len(FAILED))
