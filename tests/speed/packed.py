"""Judges what runs: of the arithmetic that small cases execute, the fraction that is packed.

A loop may have a packed copy that is never taken, for example behind a check of overlap that always
fails; test_vectorised.py, which reads the machine code, does not see that. callgrind counts each
instruction of the cases in packed.txt, and objdump says which of them are packed. valgrind has no
AVX-512, so these are the kernels for AVX2.

usage: packed.py PROGRAM COMPILER; PROGRAM is count_steps, COMPILER the name, version and level of
optimisation"""

import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile

from instructions import CASES, HERE, SKIPPED
from test_vectorised import ARITHMETIC

TABLE = os.path.join(HERE, "packed.txt")


def read_table():
    compilers, rows = [], {}
    for line in open(TABLE):
        words = line.split("#")[0].split()
        if words and words[0] == "compiler":
            compilers.append(" ".join(words[1:]))
        elif words:
            rows[words[0]] = float(words[1])
    return compilers, rows


def arithmetic(program):
    """Addresses of arithmetic: 'p' where it is packed, 's' where it is scalar."""
    command = ["objdump", "-d", "--no-show-raw-insn", program]
    kinds = {}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as listing:
        for line in listing.stdout:
            place, _, code = line.partition(":\t")
            found = ARITHMETIC.match(code)
            if found:
                kinds[int(place, 16)] = found[1]
    return kinds


def executed(path, program):
    """Yields addresses of PROGRAM and how often each was executed, from callgrind's file. A line
    has the address, absolute or relative to the line before, the line of the source, the count."""
    here, at, after_call, names = False, 0, False, {}
    for line in open(path):
        found = re.match(r"c?ob=\((\d+)\)(?: (.*))?", line)
        if found:
            if found[2]:
                names[found[1]] = found[2]
            if not line.startswith("c"):
                here = names[found[1]] == program
        elif line.startswith("calls="):
            after_call = True
        elif line[0] in "0+-*" and line.count(" ") == 2:
            place, _, count = line.split()
            at = at if place == "*" else int(place, 16) if place[0] == "0" else at + int(place)
            if here and not after_call:
                yield at, int(count)
            after_call = False


def shares(program, case, kinds):
    """The packed fraction of the arithmetic, in per cent, of the cases whose names begin so."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "count")
        command = ["valgrind", "--quiet", "--tool=callgrind", "--dump-instr=yes"]
        command += ["--toggle-collect=counted", "--dump-after=counted"]
        command += [f"--callgrind-out-file={out}", program, CASES, case]
        environment = {"PATH": os.environ["PATH"], "LC_ALL": "C", "OMP_NUM_THREADS": "1"}
        run = subprocess.run(command, capture_output=True, text=True, env=environment)
        if run.returncode:
            sys.exit(f"{' '.join(command)}: exit status {run.returncode}\n{run.stderr}")
        isa, *lines = run.stdout.split()
        result = {}
        for number, line in enumerate(lines, 1):
            sums = {"p": 0, "s": 0}
            for address, count in executed(f"{out}.{number}", program):
                if address in kinds:
                    sums[kinds[address]] += count
            result[line.split(",")[0]] = 100.0 * sums["p"] / max(sums["p"] + sums["s"], 1)
        return isa, result


def main():
    program, compiler = os.path.realpath(sys.argv[1]), sys.argv[2]
    if not shutil.which("valgrind"):
        print("skipped: valgrind is not installed (scripts/setup test)")
        return SKIPPED
    compilers, rows = read_table()
    if compiler not in compilers:
        print(f"skipped: {os.path.basename(TABLE)} is not for {compiler}")
        return SKIPPED
    kinds = arithmetic(program)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        parts = list(pool.map(lambda case: shares(program, case, kinds), rows))
    if parts[0][0] != "v3":
        print(f"skipped: the program chose the set {parts[0][0]}")
        return SKIPPED
    wrong = 0
    for (case, least), (_, found) in zip(rows.items(), parts):
        share = found.get(case, 0.0)
        wrong += share < least
        print(f"{case:28} {share:5.1f} % packed, {least:.0f} % asked")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
