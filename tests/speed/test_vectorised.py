"""Judges the machine code of the kernels: the hot loops of hot_loops.txt must be vectorised.

It counts arithmetic instructions, packed and scalar, by the source function that they come from,
which debugging information names through all inlining, and by the compiled function that they are
in. The compiler's report names a loop only by the place of its first statement, often in a function
that is inlined there.

usage: test_vectorised.py SET COMPILER KERNELS [--show]; KERNELS has lines NAME SET OBJECT"""

import collections
import fnmatch
import os
import re
import subprocess
import sys

SKIPPED = 77  # for ctest
VECTORISED = 90.0  # per cent
TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "hot_loops.txt")
WHOLE_WIDTH = {"v3": "ymm", "v4": "zmm"}
ARITHMETIC = re.compile(r"^v?(?:add|sub|mul|div|sqrt|max|min|fn?m(?:add|sub)\d+)([ps])d\s")


class Count:
    def __init__(self):
        self.packed = self.scalar = self.whole = 0

    def add(self, kind, whole):
        self.packed += kind == "p"
        self.scalar += kind == "s"
        self.whole += whole

    def share(self):
        return 100.0 * self.packed / (self.packed + self.scalar)


def count(path, width):
    """Returns the counts of an object by (compiled function, source function)."""
    command = ["objdump", "-d", "--no-show-raw-insn", "-l", "--inlines", path]
    listing = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    counts = collections.defaultdict(Count)
    compiled = inner = None
    outer, fresh = [], False
    for line in listing.splitlines():
        if line.startswith("inlined by "):  # ... FILE:LINE (FUNCTION), from the innermost on
            if fresh:
                outer, fresh = [], False
            outer.append(line[line.rindex("(") + 1 : -1])
        elif line.startswith(" "):
            code = line.split("\t", 1)[-1]
            found = ARITHMETIC.match(code)
            fresh = True
            if found and compiled:
                whole = found[1] == "p" and width in code
                for function in {compiled, inner, *outer}:
                    counts[compiled, function].add(found[1], whole)
        elif line.endswith(">:"):
            compiled = inner = line[line.index("<") + 1 : -2]
            outer = []
        elif line.endswith("():"):
            inner, outer = line[:-3], []
        else:  # FILE:LINE; what it is inlined by follows, if anything
            outer, fresh = [], False
    return counts


def read_table(path):
    """Compilers that it holds for, rows, and what is scalar."""
    compilers, rows, scalar = [], [], []
    for line in open(path):
        words = line.split("#")[0].split()
        if words and words[0] == "scalar":
            scalar.append(tuple(words[1:]))
        elif words and words[0] == "compiler":
            compilers.append(" ".join(words[1:]))
        elif words:
            rows.append((words[0], words[1], float(words[2]), "half" in words[3:]))
    return compilers, rows, scalar


def places_of(counts, kernel, function, place="*"):
    match = fnmatch.fnmatch
    return {
        (name, compiled): c
        for name, by in counts.items()
        for (compiled, source), c in by.items()
        if match(name, kernel) and match(source, function) and match(compiled, place)
    }


def judge(row, counts, scalar, show):
    """Returns what is wrong with a loop, as lines."""
    kernel, function, least, half = row
    places = places_of(counts, kernel, function)
    if not places:
        return [f"{kernel} {function}: no code of this name; did it get another?"]
    for exception in scalar:
        if exception[:2] == (kernel, function):
            for place in places_of(counts, *exception):
                places.pop(place, None)
    if show and places:
        worst = min(places, key=lambda place: places[place].share())
        share = places[worst].share()
        print(f"{kernel} {function}: {share:.0f} % in {worst[1]}, {least:.0f} asked")
    wrong = []
    for (name, compiled), c in sorted(places.items()):
        where = f"{name} {function} in {compiled}: {c.packed} packed, {c.scalar} scalar operations"
        if c.share() < least:
            wrong.append(f"{where}, {c.share():.0f} % packed in place of {least:.0f} %")
        elif not half and not c.whole:
            wrong.append(f"{where}, none of the whole width")
    return wrong


def judge_scalar(exception, counts):
    places = places_of(counts, *exception)
    if places and all(c.share() >= VECTORISED for c in places.values()):
        return [f"{' '.join(exception)}: vectorised now; move it to the loops that are judged"]
    return []


def main():
    isa, compiler, kernels = sys.argv[1:4]
    show = "--show" in sys.argv
    built = [line.split() for line in open(kernels)]
    built = [words for words in built if words[1] == isa]
    if not built:
        print(f"skipped: this build has no kernels for {isa}")
        return SKIPPED
    compilers, rows, scalar = read_table(TABLE)
    if compiler not in compilers:
        print(f"skipped: {os.path.basename(TABLE)} is not for {compiler}")
        return SKIPPED
    counts = {name: count(path, WHOLE_WIDTH[isa]) for name, _, path in built}
    wrong = [line for row in rows for line in judge(row, counts, scalar, show)]
    wrong += [line for exception in scalar for line in judge_scalar(exception, counts)]
    for line in wrong:
        print(line)
    print(f"{isa}: {len(rows)} hot loops in {len(counts)} kernels, {len(wrong)} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
