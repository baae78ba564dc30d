"""bench/replay divides the blocks of a snapshot among ranks as the program does, and finds the halo of a cut through a
cube of gas."""
import argparse
import csv
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
SOURCE = pathlib.Path(os.environ["BOLIDE_SOURCE_DIR"])

loader = importlib.machinery.SourceFileLoader("replay", str(SOURCE / "bench" / "replay"))
replay = importlib.util.module_from_spec(importlib.util.spec_from_loader("replay", loader))
loader.exec_module(replay)

CASES = {
    "sph": ("bench/cases/space-solid-second-order.yaml", "let.n=20"),
    "sph-plane": ("bench/cases/plane-solid.yaml", "let.n=60"),
    "mpm": ("bench/cases/mpm-solid.yaml", "let.n=28"),
    "mpm-quadratic": ("bench/cases/mpm-quadratic.yaml", "let.n=28"),
    "gas": ("examples/blast/point-explosion-3d/case.yaml", "let.n=40"),
}
failed = []


def run(name, ranks):
    """The rows about the run of one step on RANKS, and what replay reads of it."""
    case, setting = CASES[name]
    folder = pathlib.Path(f"{name}-{ranks}")
    command = [os.environ["BOLIDE_MPIRUN"], "-n", str(ranks), os.environ["BOLIDE"], "run", str(SOURCE / case),
               "--threads", "1", "--overwrite", "--output", str(folder)]
    for change in (setting, "run.max_steps=1", "run.energy_drift=0", "output.pictures=[]", "output.snapshots=yes"):
        command += ["--set", change]
    ended = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if not (folder / "summary.csv").exists():
        sys.exit(f"{name} on {ranks} ranks: {ended.stdout}{ended.stderr}")
    with open(folder / "summary.csv", newline="") as file:
        rows = {row["quantity"]: row["value"] for row in csv.DictReader(file) if row["about"] == "run"}
    return rows, replay.read_summary(folder)


for name in CASES:
    for ranks in (2, 3):
        rows, found = run(name, ranks)
        blocks = replay.blocks_of(found, number=0)
        held = replay.numpy.bincount(replay.cut(blocks.members, ranks), blocks.members, ranks)
        counted = [int(float(rows[key])) for key in ("least_on_rank", "most_on_rank")]
        if counted != [held.min(), held.max()]:
            failed.append(f"{name} on {ranks} ranks: {counted} members a rank, predicted {held}")

# The cut through 4 x 4 x 4 blocks of 8^3 cells is a plane: 16 of them send two planes of 64 cells of six numbers.
CASES["cube"] = (CASES["gas"][0], "let.n=32")
_, cube = run("cube", 2)
options = argparse.Namespace(fill=0, cores=2, loaded=1.0, rate=None)
found = replay.predict(cube, 2, options)
if (found["sent"], found["neighbours"]) != (16 * 2 * 64 * 6 * 8, 1):
    failed.append(f"a cube of gas: {found}")
options.fill = 4 * 32**3
if replay.predict(cube, 2, options)["members"] != 8 * 32**3:
    failed.append("blocks do not become eight each")

for line in failed:
    print("FAILED:", line)
sys.exit(bool(failed))
