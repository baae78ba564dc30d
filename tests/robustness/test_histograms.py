"""Means, quantiles and histograms by mass, volume and number, beside the same of the snapshot; the same
on several ranks; plots of histograms in the report."""
import os
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(os.environ["BOLIDE_SOURCE_DIR"]) / "python"))

import numpy

import bolide

FAILED = []
WEIGHTS = ("number", "mass", "volume")
CASE = {
    "format": 1, "dimension": 2, "resolution": "0.5 mm", "solver": "sph",
    "materials": {"steel": {"library": "steel-1006"}, "light": {"library": "aluminium"}},
    "bodies": {
        "bar": {"material": "steel", "box": {"from": ["0 mm", "0 mm"], "to": ["10 mm", "5 mm"]}},
        "wall": {"material": "light", "resolution": "0.25 mm", "velocity": ["-300 m/s", "0 m/s"],
                 "box": {"from": ["10.2 mm", "-2 mm"], "to": ["12 mm", "7 mm"]}}},
    "run": {"until": "2 us"},
    "output": {"pictures": [], "histograms": {
        "wall": {"field": "speed", "of": ["wall"], "bins": 7},
        "counted": {"field": "speed", "bins": 9, "log": True, "weight": "number",
                    "range": {"low": "10 m/s", "high": "200 m/s"}},
        "filled": {"field": "stress.xx", "bins": 11, "weight": "volume"}}},
    "checks": {f"{kind} {weight}": {kind: {"field": "pressure", "weight": weight, **more}}
               for weight in WEIGHTS
               for kind, more in (("mean", {}), ("spread", {}), ("quantile", {"fraction": 0.3}))},
}


def expect(true, what):
    if not true:
        FAILED.append(what)
        print("FAILED:", what)


def close(a, b):
    return numpy.allclose(a, b, rtol=2e-6)


def check_measures(run, last):
    pressure = last["pressure"].astype(float)
    order = numpy.argsort(pressure)
    for weight in WEIGHTS:
        weights = last.weights(weight)
        mean = (pressure * weights).sum() / weights.sum()
        spread = numpy.sqrt(((pressure - mean)**2 * weights).sum() / weights.sum())
        within = numpy.cumsum(weights[order]) >= 0.3 * weights.sum() * (1 - 1e-7)
        for kind, value in (("mean", mean), ("spread", spread),
                            ("quantile", pressure[order][within.argmax()])):
            measured = run.checks[f"{kind} {weight}"].value
            expect(close(measured, value), f"{kind} by {weight}: {measured}, not {value}")
    expect(run.checks["mean mass"].value != run.checks["mean number"].value, "weights count")


def check_histograms(run, last):
    speed, where = last["speed"].astype(float), last.where("wall")
    wall, counted, filled = (run.histograms[name][-1] for name in ("wall", "counted", "filled"))
    edges = numpy.append(wall["speed.low"], wall["speed.high"][-1])
    expect(close(edges, numpy.linspace(speed[where].min(), speed[where].max(), 8)), "its edges")
    expect(wall.unit("mass") == "kg/m" and wall.unit("speed.low") == "m/s", "its units")
    expect(close(wall["fraction"].sum(), 1.0) and close(wall["cumulative"][-1], 1.0), "fractions")
    sums, _ = numpy.histogram(speed[where], numpy.append(edges[:-1], numpy.inf),
                              weights=last.weights("mass")[where])
    expect(close(wall["mass"].sum(), sums.sum()) and
           abs(wall["mass"] - sums).max() <= 2.1 * last["mass"][where].max(), "its masses")
    edges = numpy.append(counted["speed.low"], counted["speed.high"][-1])
    expect(close(edges, 10.0 * 20.0 ** (numpy.arange(10) / 9)), "edges of equal ratio")
    sums, _ = numpy.histogram(speed, edges)
    expect(abs(counted["number"] - sums).max() <= 1, "numbers")
    expect(close(counted["cumulative"][-1], (speed <= 200.0).mean()), "what is below the bins")
    expect(filled.unit("volume") == "m^2" and
           close(filled["volume"].sum(), last.weights("volume").sum()), "volumes")


case = bolide.Case.of(CASE, "case.yaml")
run = case.run("one", threads=1, overwrite=True)
last = run.snapshots[-1]
check_measures(run, last)
check_histograms(run, last)
expect("Histograms at the end" in pathlib.Path("one/report.html").read_text(), "no plots")
if os.environ.get("BOLIDE_MPIRUN"):
    case.run("two", ranks=2, overwrite=True)
    same = subprocess.run(["diff", "-r", "one/histograms", "two/histograms"], check=False)
    expect(same.returncode == 0, "on two ranks histograms differ")
case.set("output.histograms", "").run("one", overwrite=True)
expect(not pathlib.Path("one/histograms").exists(), "--overwrite leaves histograms")
sys.exit(len(FAILED))
