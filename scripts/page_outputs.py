"""The outputs of the program that pages quote: their marks, and the record of each page.

    <!-- file: plate.yaml -->  before a block: the file that a reader saves from it
    <!-- file: hole.yaml, from plate.yaml -->  the same; the block replaces lines of another file,
                               from its first key to its last
    <!-- output -->            before a block of commands (`$ ...`) and what they print
    <!-- output: {lines: [check, report]} -->  only lines that match, with `...` for the others

The record of docs/NAME.md is docs/outputs/NAME.txt: the files by their hash, each command and all
that it printed. Wall-clock times and rates are …, the table of times after a run is `...`, and
lines of progress are left out."""
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent
PART = re.compile(
    r"<!-- file: (?P<name>\S+?)(?:, from (?P<base>\S+))? -->\n```\w*\n(?P<text>.*?)^```$|"
    r"<!-- output(?:: (?P<mark>.*?))? -->\n```text\n(?P<shown>.*?)^```$",
    re.S | re.M)
COMMAND = re.compile(r"^\$ (?:.*\\\n)*.*\n", re.M)
TIMES = re.compile(r"(?:^  \w[\w ]*? +[\d.]+ s +[\d.]+ %\n)+", re.M)
PROGRESS = re.compile(r"^step \d+  t .*  left .*\n", re.M)


class Wrong(Exception):
    """A mark that cannot be filled."""


def record_of(page):
    return ROOT / "docs" / "outputs" / (page.stem.lower() + ".txt")


def key_of(line):
    return line.split(":")[0]


def patched(base, text):
    """BASE with its lines from the first key of TEXT to the last one replaced by TEXT."""
    lines, keys = base.splitlines(True), [key_of(line) for line in text.splitlines()
                                          if re.match(r"\w", line)]
    start = next(i for i, line in enumerate(lines) if key_of(line) == keys[0])
    end = next(i for i, line in enumerate(lines) if key_of(line) == keys[-1]) + 1
    while end < len(lines) and not re.match(r"\w", lines[end]):
        end += 1
    return "".join(lines[:start]) + text + "".join(lines[end:])


def steps_of(text):
    """What a reader of a page does, in order: (match, name of a file, its text or None)."""
    files = {}
    for match in PART.finditer(text):
        name, own = match["name"], match["text"]
        if name:
            base = files.get(match["base"] if name not in files else name)
            files[name] = own if base is None or not match["base"] else patched(base, own)
        yield match, name, files.get(name)


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def head_of(text):
    """The files of a page, as its record names them."""
    last = {name: own for _, name, own in steps_of(text) if name}
    return "".join(f"# {name} {digest(own)}\n" for name, own in last.items())


def masked(text):
    text = PROGRESS.sub("", TIMES.sub("  ...\n", text))
    text = re.sub(r"[\d.]+ (?:[kMG] )?((?:particle |cell )?updates/s)", r"… \1", text)
    text = re.sub(r"(after |, )[\d.]+ s\b", r"\1… s", text)
    text = re.sub(r"steps, \S+ \w+ \+ \S+ \w+ for output", "steps, … + … for output", text)
    text = re.sub(r"\((?:a guess|at the rate of the last run);", "(…;", text)
    return re.sub(r"^seconds .*$", lambda line: re.sub(
        r"[\d.]+", lambda n: "…".rjust(len(n[0])), line[0]), text, flags=re.M)


def printed(page, program):
    """Runs the commands of PAGE in an empty folder; the record of what they print. Its scripts run
    with this Python and the package of the source tree."""
    text = page.read_text()
    with tempfile.TemporaryDirectory() as folder:
        build = pathlib.Path(folder) / "build" / "release"
        build.mkdir(parents=True)
        (build / "bolide").symlink_to(program)
        (build / "python3").symlink_to(sys.executable)
        environment = dict(os.environ, PATH=f"{build}:{os.environ['PATH']}", OMP_NUM_THREADS="2",
                           XDG_CACHE_HOME=str(build.parent / "cache"),
                           PYTHONPATH=str(ROOT / "python"), PYTHONDONTWRITEBYTECODE="1")
        environment.pop("BOLIDE", None)
        parts = [head_of(text)]
        for match, name, own in steps_of(text):
            if name:
                (pathlib.Path(folder) / name).write_text(own)
                continue
            for command in COMMAND.findall(match["shown"]):
                run = subprocess.run(["bash", "-c", command[2:]], cwd=folder, env=environment,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                     check=False)
                parts.append(command + masked(run.stdout))
    return "".join(parts)


def record(page, program):
    """Writes what the commands of PAGE print to its record."""
    path, text = record_of(page), printed(page, program)
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)


def chosen(output, patterns):
    """The lines of OUTPUT that match one of PATTERNS, and `...` for those between them."""
    lines = []
    for line in output.splitlines(True):
        if any(re.search(pattern, line) for pattern in patterns):
            lines.append(line)
        elif not lines or lines[-1].strip() != "...":
            lines.append("...\n")
    return "".join(lines)


def filled(text, page):
    """TEXT of PAGE with its outputs as the record has them, and the number of outputs."""
    matches = [match for match, name, _ in steps_of(text) if not name]
    if text.count("<!-- output") != len(matches):
        raise Wrong("a mark of an output without its block")
    if not matches:
        return text, 0
    path = record_of(page)
    again = "`scripts/figures --record-outputs` makes it"
    if not path.exists():
        raise Wrong(f"no record {os.path.relpath(path, ROOT)}: {again}")
    recorded = path.read_text()
    if not recorded.startswith(head_of(text)):
        raise Wrong(f"the record of outputs is of other files: {again}")
    outputs = dict(zip(COMMAND.findall(recorded), COMMAND.split(recorded)[1:]))

    def fill(match):
        if match["name"]:
            return match[0]
        lines = (yaml.safe_load(match["mark"]) or {}).get("lines") if match["mark"] else None
        shown = ""
        for command in COMMAND.findall(match["shown"]):
            if command not in outputs:
                raise Wrong(f"the record has no output of {command.strip()}: {again}")
            shown += command + (chosen(outputs[command], lines) if lines else outputs[command])
        start, end = (place - match.start() for place in match.span("shown"))
        return match[0][:start] + shown + match[0][end:]

    return PART.sub(fill, text), len(matches)
