"""Results: the folder of a run, or of the runs of a sweep."""
import csv
import os
import pathlib
import re

from .snapshot import Snapshot
from .table import Named, Table, unknown

NUMBERED = re.compile(r"(.+)-(\d{6,})\.csv")
SNAPSHOT = re.compile(r"(\d{6,})(?:-(.+))?\.vtkhdf")


class Check:
    """What a check measured, in SI units, and its verdict. `wanted`, `low` and `high` are not a
    number or infinite where there is no limit."""

    def __init__(self, row):
        self.name, self.measure, self.unit = row["check"], row["measure"], row["unit"]
        self.verdict, self.source, self.nothing = row["verdict"], row["source"], row["nothing"]
        self.value, self.wanted, self.low, self.high = (
            float(row[key] or "nan") for key in ("measured", "wanted", "low", "high"))

    @property
    def passed(self):
        """False where the check failed, or a known deviation passes now."""
        return self.verdict not in ("failed", "passes now")

    def __repr__(self):
        value = f"{self.value:.6g} {self.unit}".strip()
        return f"<Check {self.name}: {value}, {self.verdict}>"


class Results:
    """What a run wrote. Files are read when they are asked for, and again each time."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not any((self.folder / name).exists() for name in ("summary.csv", "sweep.csv")):
            raise FileNotFoundError(f"{self.folder} has no results of Bolide")

    @property
    def summary(self):
        """{(about, name, quantity): value} of summary.csv: numbers in SI units, and texts."""
        if not (self.folder / "summary.csv").exists():
            raise self._of_runs("summary or status")
        with open(self.folder / "summary.csv", newline="", encoding="utf-8") as file:
            return {(row["about"], row["name"], row["quantity"]):
                    row["value"] if row["unit"] == "text" else float(row["value"] or "nan")
                    for row in csv.DictReader(file)}

    @property
    def status(self):
        """"finished", "stopped", "failed", or "running" while the run goes on or was killed."""
        return self.summary["run", "", "status"]

    @property
    def history(self):
        """Totals, ledger and extremes over the time."""
        return self._table("history.csv")

    @property
    def fragments(self):
        """The fragments of broken bodies at the last snapshot."""
        return self._table("fragments.csv")

    @property
    def probes(self):
        """{name: Table}."""
        return self._named("probes", {name[:-4]: Table(self.folder / "probes" / name)
                                      for name in self._names("probes") if name.endswith(".csv")})

    @property
    def profiles(self):
        """{name: [Table of the first snapshot, ...]}."""
        return self._lists("profiles")

    @property
    def histograms(self):
        """{name: [Table of the first snapshot, ...]}."""
        return self._lists("histograms")

    @property
    def checks(self):
        """{name: Check}; empty where the run did not finish."""
        rows = []
        if (self.folder / "checks.csv").exists():
            with open(self.folder / "checks.csv", newline="", encoding="utf-8") as file:
                rows = [Check(row) for row in csv.DictReader(file)]
        return self._named("checks", {check.name: check for check in rows})

    @property
    def snapshots(self):
        """The snapshots in the order of their time. Of a coupled run each has `others`."""
        found = {}
        for name in self._names("snapshots"):
            match = SNAPSHOT.fullmatch(name)
            if match:
                found.setdefault(match[1], {})[match[2]] = self.folder / "snapshots" / name
        return [Snapshot(files.pop(None), files) for _, files in sorted(found.items())
                if None in files]

    def at(self, time):
        """The snapshot nearest to TIME, in seconds."""
        snapshots = self.snapshots
        if not snapshots and (self.folder / "sweep.csv").exists():
            raise self._of_runs("snapshots")
        if not snapshots:
            raise FileNotFoundError(f"{self.folder} has no snapshots: `output: {{snapshots: no}}`, "
                                    "or the run has not begun")
        return min(snapshots, key=lambda snapshot: abs(snapshot.time - time))

    @property
    def sweep(self):
        """What the checks measured, a row a run of the sweep."""
        return self._table("sweep.csv")

    @property
    def runs(self):
        """{folder: Results} of the runs of a sweep, in its order."""
        return self._named("runs", {name: Results(self.folder / name)
                                    for name in self.sweep["run"]
                                    if (self.folder / name / "summary.csv").exists()})

    def _of_runs(self, what):
        return FileNotFoundError(f"{self.folder} is a sweep and has no {what}: its runs have, "
                                 "runs[FOLDER]")

    def _lists(self, folder):
        lists = {}
        for name in self._names(folder):
            match = NUMBERED.fullmatch(name)
            if match:
                lists.setdefault(match[1], []).append(Table(self.folder / folder / name))
        return self._named(folder, lists)

    def _names(self, folder):
        path = self.folder / folder
        return sorted(os.listdir(path)) if path.is_dir() else []

    def _named(self, what, items):
        return Named(f"{self.folder}/{what}", items)

    def _table(self, name):
        if not (self.folder / name).exists():
            raise unknown(str(self.folder), name, sorted(os.listdir(self.folder)))
        return Table(self.folder / name)

    def __repr__(self):
        return f"<Results {self.folder}>"
