"""Counts instructions a particle-step, or a cell-sweep, of the cases in cases.txt with callgrind
and compares them with the record, or records them anew.

usage: instructions.py PROGRAM COMPILER GROUP... [--record]; PROGRAM is count_steps, COMPILER the
name, version and level of optimisation, a group what the names of cases begin with"""

import concurrent.futures
import csv
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
CASES = os.path.join(HERE, "cases.txt")
RECORD = os.path.join(HERE, "instructions.csv")
HEAD = ["compiler", "set", "case", "instructions"]
ALLOWED = 0.05  # more than recorded
SKIPPED = 77  # for ctest


def totals(path):
    with open(path) as file:
        return next(int(line.split()[1]) for line in file if line.startswith("totals:"))


def count(program, group):
    """Returns the instruction set that the program chose, and the counts by case."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "count")
        command = ["valgrind", "--quiet", "--tool=callgrind", "--toggle-collect=counted"]
        command += ["--dump-after=counted", f"--callgrind-out-file={out}", program, CASES, group]
        environment = {"PATH": os.environ["PATH"], "LC_ALL": "C", "OMP_NUM_THREADS": "1"}
        run = subprocess.run(command, capture_output=True, text=True, env=environment)
        if run.returncode:
            sys.exit(f"{' '.join(command)}: exit status {run.returncode}\n{run.stderr}")
        isa, *lines = run.stdout.split()
        counts = {}
        for number, line in enumerate(lines, 1):
            name, members, steps = line.split(",")
            counts[name] = totals(f"{out}.{number}") / (int(members) * int(steps))
        return isa, counts


def read_record():
    if not os.path.exists(RECORD):
        return {}
    with open(RECORD, newline="") as file:
        rows = list(csv.reader(file))[1:]
    return {tuple(row[:3]): float(row[3]) for row in rows}


def write_record(record, compiler, isa, counts):
    record = {key: value for key, value in record.items() if key[:2] != (compiler, isa)}
    record.update({(compiler, isa, name): value for name, value in counts.items()})
    with open(RECORD, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEAD)
        writer.writerows([*key, f"{record[key]:.1f}"] for key in sorted(record))


def compare(record, compiler, isa, counts, groups):
    """Prints a line a case and returns how many are wrong."""
    wrong = 0
    for name, now in counts.items():
        past = record.get((compiler, isa, name))
        if past is None:
            verdict, wrong = "not recorded", wrong + 1
        else:
            change = now / past - 1.0
            verdict = f"{100.0 * change:+.2f} %"
            if change > ALLOWED:
                verdict, wrong = f"{verdict}: more than {100.0 * ALLOWED:.0f} % above", wrong + 1
            elif change < -ALLOWED:
                verdict += ": fewer; record them"
        print(f"{name:36} {now:10.1f} {past or 0.0:10.1f}  {verdict}")
    for key in record:
        if key[:2] == (compiler, isa) and key[2].startswith(groups) and key[2] not in counts:
            print(f"{key[2]:36} recorded, but no case")
            wrong += 1
    return wrong


def main():
    words = [word for word in sys.argv[1:] if word != "--record"]
    program, compiler, groups = words[0], words[1], tuple(words[2:])
    if not shutil.which("valgrind"):
        print("skipped: valgrind is not installed (scripts/setup test)")
        return SKIPPED
    recording, record = "--record" in sys.argv, read_record()
    if not recording and not any(key[0] == compiler for key in record):
        print(f"skipped: nothing is recorded for {compiler}")
        return SKIPPED
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        parts = list(pool.map(lambda group: count(program, group), groups))
    isa = parts[0][0]
    counts = {name: value for part in parts for name, value in part[1].items()}
    if recording:
        write_record(record, compiler, isa, counts)
        compare(record, compiler, isa, counts, groups)
        return 0
    if not any(key[:2] == (compiler, isa) for key in record):
        print(f"skipped: nothing is recorded for {compiler} and {isa}")
        return SKIPPED
    wrong = compare(record, compiler, isa, counts, groups)
    if wrong:
        print("scripts/instructions --record records them anew; the commit must say why")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
