"""Run cases of Bolide and read their results, as numpy arrays with plain names and SI units.

    import bolide

    run = bolide.Case("plate/case.yaml").set("let.speed", "800 m/s").run("results/800")
    run.history["time"], run.history.unit("time")
    last = run.snapshots[-1]
    last["pressure"][last.where("target")].mean()

Case runs the program `bolide`; Results, Table and Snapshot read what it wrote. Needs numpy and h5py,
and with Table.frame() and Snapshot.to_pyvista() pandas and pyvista."""
from .case import Case, Failed, Refused
from .results import Check, Results
from .snapshot import Snapshot
from .table import Table, UnknownName

__all__ = ["Case", "Check", "Failed", "Refused", "Results", "Snapshot", "Table", "UnknownName"]
