"""Snapshots and checkpoints that several ranks write: the same numbers as one, a damaged byte is found, and what one rank
cannot write is an error of all that leaves nothing half written."""
import filecmp
import os
import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy

SOURCE = pathlib.Path(os.environ["BOLIDE_SOURCE_DIR"])
failed = []


def run(case, ranks, output, *options, before=""):
    """The status and what the ranks have said; BEFORE is what bash does on each first."""
    command = f'{before} exec "$BOLIDE" run {SOURCE}/tests/data/{case}.yaml --threads 1 --output {output} "$@"'
    ended = subprocess.run([os.environ["BOLIDE_MPIRUN"], "-n", str(ranks), "bash", "-c", command, "bolide", *options],
                           capture_output=True, text=True, stdin=subprocess.DEVNULL)
    return ended.returncode, ended.stdout + ended.stderr


def expect(right, text):
    if not right:
        failed.append(text)


def arrays_of(path):
    """All datasets by name; those of members in the order of their ids."""
    found, ids = {}, {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
    for name, numbers in found.items():
        if numbers.dtype == object:  # texts
            found[name] = numpy.array(numbers, "S")
        if name.endswith("/id"):
            ids[name.rpartition("/")[0]] = numpy.argsort(numbers.ravel(), kind="stable")
    for name in found:
        order = ids.get(name.rpartition("/")[0])
        if order is not None and len(found[name]) == len(order):
            found[name] = found[name][order]
    return found


def differing(one, other, leave):
    a, b = arrays_of(one), arrays_of(other)
    return sorted(set(a) ^ set(b)) + [name for name in a if name in b and name not in leave
                                      and a[name].tobytes() != b[name].tobytes()]


# The ledger is a sum whose digits depend on how many have added to it, and the checksums are of the order of members.
# Snapshots of particles whose order differs have other points, and hashes.
UNEQUAL = {"ledger", "checksums"}
UNORDERED = {"run/snapshot_hashes", "VTKHDF/Points"}
for case, same_order in (("everything", True), ("everything-gas", True), ("everything-levels", True),
                         ("everything-coupled", False)):
    for ranks in (1, 2, 3):
        folder = pathlib.Path(f"{case}-{ranks}")
        shutil.rmtree(folder, ignore_errors=True)
        status, text = run(case, ranks, folder, "--set", "output.pictures=[]")
        expect(status in (0, 1), f"{case} on {ranks} ranks: {text}")
    for ranks in (2, 3):
        one, folder = pathlib.Path(f"{case}-1"), pathlib.Path(f"{case}-{ranks}")
        leave = UNEQUAL if same_order else UNEQUAL | UNORDERED
        found = differing(one / "checkpoint.h5", folder / "checkpoint.h5", leave)
        expect(not found, f"{case} on {ranks} ranks: other {found} in the checkpoint")
        for path in sorted((one / "snapshots").iterdir()):
            other = folder / "snapshots" / path.name
            found = differing(path, other, leave)
            expect(not found, f"{case} on {ranks} ranks: other {found} in {path.name}")
            expect(not same_order or filecmp.cmp(path, other, shallow=False), f"{other} has other bytes")

# A byte in the middle of an array of which each rank reads a part, as it is read on resuming.
for name in ("particles/velocity", "particles/body"):
    shutil.rmtree("damaged", ignore_errors=True)
    shutil.copytree("everything-2", "damaged")
    with h5py.File("damaged/checkpoint.h5") as file:
        at = file[name].id.get_offset() + file[name].id.get_storage_size() // 2
    with open("damaged/checkpoint.h5", "r+b") as file:
        file.seek(at)
        byte = file.read(1)[0]
        file.seek(at)
        file.write(bytes([byte ^ 4]))
    status, text = run("everything", 2, "damaged", "--resume", "--set", "output.pictures=[]")
    expect(status == 4 and text.count(f"checkpoint.h5: {name} is damaged") == 1, f"damaged {name}: {status}, {text}")

# One rank may write less than its rows need: the last of three, then the first.
RANK = "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}"
for rank in (2, 0):
    shutil.rmtree("full", ignore_errors=True)
    status, text = run("everything", 3, "full", before=f"trap '' XFSZ; [ {RANK} != {rank} ] || ulimit -f 64;")
    left = [path.name for path in pathlib.Path("full/snapshots").iterdir()]
    expect(status == 4 and text.count("full/snapshots/000000.vtkhdf: ") == 1 and "File too large" in text,
           f"rank {rank} of 3 has no room: {status}, {text}")
    expect(not left, f"rank {rank} of 3 has no room: {left} is left")

# A disk that is full, where this user may make a small one.
small = "mkdir -p small && mount -t tmpfs -o size=300k none small"
if not subprocess.run(["unshare", "-rm", "bash", "-c", small], capture_output=True).returncode:
    script = f'{small} && "$BOLIDE_MPIRUN" -n 2 "$BOLIDE" run "$0" --threads 1 --output small/full; echo status $?; ls small/full/*'
    ended = subprocess.run(["unshare", "-rm", "bash", "-c", script, SOURCE / "tests/data/everything.yaml"],
                           capture_output=True, text=True, stdin=subprocess.DEVNULL)
    text = ended.stdout + ended.stderr
    expect("status 4" in text and "No space left on device" in text, f"a full disk: {text}")
    expect(".part" not in text, f"a full disk: half a file is left: {text}")

for line in failed:
    print("FAILED:", line)
sys.exit(bool(failed))
