"""What an entry of the matrix is: a case, what is measured in its run, and what each measure must
be."""
import csv
import dataclasses
import json
import typing


def unit(value, of):
    """A quantity as a case has it."""
    return f"{value:.12g} {of}"


def metres(*values):
    return [unit(value, "m") for value in values]


def speeds(*values):
    return [value if isinstance(value, str) else unit(value, "m/s") for value in values]


QUIET = {"snapshots": "no"}
DIMENSION = {"1d": 1, "plane-strain": 2, "plane-stress": 2, "axisymmetric": 2, "3d": 3}


def start(geometry, solver, resolution, until, **output):
    case = {"dimension": DIMENSION[geometry]}
    if geometry in ("plane-stress", "axisymmetric"):
        case["geometry"] = geometry
    return {
        **case,
        "resolution": unit(resolution, "m"),
        "solver": solver,
        "run": {"until": unit(until, "s")},
        "output": {**QUIET, **output},
    }


def conserved(momentum=True, energy=1e-9):
    measures = [
        Measure("energy", {"conserved": "energy"}, "conserved to rounding", 0, -energy, energy)
    ]
    if momentum:
        measures.append(
            Measure("momentum", {"conserved": "momentum"}, "conserved to rounding", 0, -1e-9, 1e-9)
        )
    return measures


def rotated(shape, degrees, **more):
    return {"rotate": {"shape": shape, "angle": f"{degrees:g} deg", **more}} if degrees else shape


@dataclasses.dataclass
class Measure:
    """HOW is a check of the program, without limits, or a function of the run. A limit is a number,
    or a function of the value of the measure REFERENCE, an (entry, measure) pair. WHY is where the
    exact answer and the limits come from; KIND is `exact` (theory or a source), `limit` (our own
    tolerance about an exact answer) or `regression`.
    """

    name: str
    how: typing.Union[dict, typing.Callable]
    why: str
    exact: typing.Optional[float] = None
    low: typing.Union[None, float, typing.Callable] = None
    high: typing.Union[None, float, typing.Callable] = None
    unit: str = ""
    kind: str = "exact"
    reference: typing.Optional[tuple] = None


@dataclasses.dataclass
class Entry:
    name: str
    case: dict
    measures: list

    @property
    def references(self):
        """Entries whose results limits depend on, by name."""
        return {
            measure.reference[0].name: measure.reference[0]
            for measure in self.measures
            if measure.reference
        }

    def text(self):
        """The case, with the checks and their limits, so that it can be run by itself."""
        case = dict(self.case)
        checks = dict(case.pop("checks", {}))
        for measure in self.measures:
            if isinstance(measure.how, dict):
                check = dict(measure.how, source=measure.why[:1990])
                low, high = (None, None) if measure.reference else (measure.low, measure.high)
                if low is not None:
                    check["at_least"] = unit(low, measure.unit).strip()
                if high is not None or low is None:  # the program wants one limit
                    check["at_most"] = unit(1e300 if high is None else high, measure.unit).strip()
                checks[measure.name] = check
        case["checks"] = checks
        lines = ["# Written by scripts/matrix."]
        for key, value in {"format": 1, "title": self.name.replace("/", " "), **case}.items():
            if isinstance(value, dict) and key not in ("run", "output", "let", "solver"):
                lines.append(f"{key}:")
                lines += [f"  {name}: {json.dumps(thing)}" for name, thing in value.items()]
            else:
                lines.append(f"{key}: {json.dumps(value)}")
        return "\n".join(lines) + "\n"


def table(path):
    """A CSV file of the program as {column without its unit: list of numbers}."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {
        name.split(" [")[0]: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])
    }


class Run:
    """What a run has left: history, probes, checks."""

    def __init__(self, folder):
        self.folder = folder
        self.checks = {}
        with open(folder / "checks.csv", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                self.checks[row["check"]] = float(row["measured"])

    def history(self):
        return table(self.folder / "history.csv")

    def probe(self, name):
        return table(self.folder / "probes" / f"{name}.csv")


def largest(probe, column, after=0.0, before=float("inf"), of_start=False):
    """A measure: the largest value that a probe has recorded in a window, or its ratio to the
    first."""

    def measure(run):
        rows = run.probe(probe)
        inside = [v for t, v in zip(rows["time"], rows[column]) if after <= t <= before]
        return max(inside) / (rows[column][0] if of_start else 1.0)

    return measure


def time_of_largest(probe, column, after, before):
    """A measure: the time of the maximum, from a parabola through what is within 20 % of it."""

    def measure(run):
        rows = run.probe(probe)
        points = [(t, v) for t, v in zip(rows["time"], rows[column]) if after <= t <= before]
        most = max(v for _, v in points)
        near = [(t, v) for t, v in points if v > 0.8 * most]
        return vertex(near) if len(near) >= 5 else max(points, key=lambda point: point[1])[0]

    return measure


def vertex(points):
    """Where a parabola fitted by least squares has its vertex."""
    middle = sum(t for t, _ in points) / len(points)
    scale = max(abs(t - middle) for t, _ in points)
    s = [sum(((t - middle) / scale) ** k for t, _ in points) for k in range(5)]
    r = [sum(v * ((t - middle) / scale) ** k for t, v in points) for k in range(3)]
    rows = [[s[i + j] for j in range(3)] + [r[i]] for i in range(3)]
    for i in range(3):  # elimination; symmetric and positive definite
        for k in range(i + 1, 3):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    c = rows[2][3] / rows[2][2]
    b = (rows[1][3] - rows[1][2] * c) / rows[1][1]
    return middle - b / (2 * c) * scale if c < 0 else max(points, key=lambda point: point[1])[0]
