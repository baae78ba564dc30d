"""What the documents and the pages of the examples show as input is accepted: whole cases are right, and
solvers, schemes and their options, in tables and in `--set`, have the names that are shown."""
import os
import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(os.environ["BOLIDE_SOURCE_DIR"])
PAGES = [SOURCE / "README.md", *sorted(SOURCE.glob("docs/**/*.md")),
         *sorted(SOURCE.glob("examples/*/*/README.md"))]
BASE = """
format: 1
dimension: 2
resolution: 1 mm
solver: {sph: {method: contact}}
materials: {aluminium: {library: aluminium}}
bodies: {block: {material: aluminium, box: {from: [0 mm, 0 mm], to: [4 mm, 4 mm]}}}
run: {until: 1 us}
"""
CASE = re.compile(r"^```yaml\n(format: 1\n.*?)^```", re.DOTALL | re.MULTILINE)
FILE = re.compile(r"^<!-- file: (\S+) -->\n```yaml\n(.*?)^```", re.DOTALL | re.MULTILINE)
TABLE = re.compile(r"\b(solver: |solver=|method: )(?=\{)")
PATH = re.compile(r"--set (solver\.[\w.]+=[\w.-]+)")
WRONG = re.compile(r'unknown (key|choice|solver|scheme) "')


def table_at(text, start):
    """The flow map of TEXT that begins at START."""
    depth = 0
    for end in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        if depth == 0:
            return " ".join(text[start:end + 1].split())
    return text[start:]


def settings_of(text):
    """Values of `--set` that TEXT shows, or that say the same as a table in it."""
    settings = PATH.findall(text)
    for match in TABLE.finditer(text):
        table = table_at(text, match.end())
        settings.append(f"solver={{sph: {{method: {table}}}}}" if match[1] == "method: "
                        else f"solver={table}")
    return settings


def check(case, *words):
    result = subprocess.run([os.environ["BOLIDE"], "check", case, *words], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return result.returncode, result.stdout


def main():
    faults, cases, tables = [], 0, set()
    case = pathlib.Path("case.yaml")
    for page in PAGES:
        text = page.read_text()
        name = page.relative_to(SOURCE)
        for file, content in FILE.findall(text):  # of which another case may start
            pathlib.Path(file).write_text(content)
        for shown in (match[1] for match in CASE.finditer(text) if "bodies:" in match[1]):
            cases += 1
            case.write_text(shown)
            status, said = check(case)
            if status != 0:
                faults.append(f"{name}: a case ends with {status}:\n{said}")
        case.write_text(BASE)
        for setting in settings_of(text):
            tables.add(setting)
            said = check(case, "--set", setting)[1]
            if WRONG.search(said):
                faults.append(f"{name}: {setting}:\n{said}")
    if cases < 4 or len(tables) < 5:
        faults.append(f"found {cases} cases and {len(tables)} settings only")
    sys.exit("\n".join(faults) or None)


main()
