"""Cases: what `bolide check` and `bolide run` do with a case file."""
import json
import os
import pathlib
import shutil
import subprocess

from .results import Results

MISTAKE = 2
CHECKS_FAILED = 1


class Refused(ValueError):
    """A mistake in a case or on the command line. The text is the program's."""


class Failed(RuntimeError):
    """A run that ended before its time: an impossible state, a full disk, a signal. The text is the
    program's; `status` is its exit status. `--resume` continues what has a checkpoint."""

    def __init__(self, text, status):
        super().__init__(text)
        self.status = status


def as_json(value, indent=None):
    """VALUE as JSON that the program reads: flags are `yes` and `no` in a case."""
    def plain(part):
        if isinstance(part, bool):
            return "yes" if part else "no"
        if isinstance(part, dict):
            return {key: plain(one) for key, one in part.items()}
        return [plain(one) for one in part] if isinstance(part, (list, tuple)) else part

    return json.dumps(plain(value), indent=indent, ensure_ascii=False)


def find_program():
    """The program: $BOLIDE, the one in PATH, or the one that came with this package."""
    given = os.environ.get("BOLIDE") or shutil.which("bolide")
    if given:
        return given
    for folder in pathlib.Path(__file__).resolve().parents:
        for place in ("bin/bolide", "build/release/bolide"):
            if os.access(folder / place, os.X_OK) and (folder / place).is_file():
                return str(folder / place)
    raise FileNotFoundError("there is no program bolide in PATH; set the environment variable BOLIDE")


class Case:
    """A case file, or the folder of a case.yaml, with values that replace those of the file.

    form: None, "short" or "long", as the options of the program."""

    def __init__(self, path, form=None, program=None):
        if form not in (None, "short", "long"):
            raise ValueError(f'form is "short" or "long", not {form!r}')
        self.path = os.fspath(path)
        self.form = form
        self.settings = {}
        self.program = program

    @classmethod
    def of(cls, tree, path, **options):
        """Writes the case TREE, a dict as the file would have it, to PATH. Quantities are texts with
        their units, "800 m/s"."""
        pathlib.Path(path).write_text(as_json(tree, 1) + "\n", encoding="utf-8")
        return cls(path, **options)

    def set(self, key, value):
        """Replaces the value of KEY, bodies.flyer.velocity; None removes it. Returns the case."""
        text = value if isinstance(value, str) else "" if value is None else as_json(value)
        self.settings.pop(key, None)
        self.settings[key] = text
        return self

    def check(self):
        """What `bolide check` prints: the size of the case and a forecast of steps and time. Raises
        Refused with all mistakes of the case."""
        return self._call("check", [])

    def run(self, folder, threads=None, ranks=None, resume=False, overwrite=False,
            change=False):
        """Runs the case into FOLDER and returns its Results. Checks that fail raise nothing: see
        Results.checks. With resume, a run continues from its checkpoint; with change also where
        loads, boundaries and the like have changed. An interrupt (Ctrl-C) lets the program write its checkpoint first."""
        words = ["--output", os.fspath(folder)]
        words += ["--threads", str(threads)] if threads else []
        words += ["--ranks", str(ranks)] if ranks else []
        words += ["--resume"] if resume else []
        words += ["--overwrite"] if overwrite else []
        words += ["--change"] if change else []
        self._call("run", words)
        return Results(folder)

    def _call(self, command, words):
        words = [self.program or find_program(), command, self.path, *words]
        words += [f"--{self.form}"] if self.form else []
        for key, value in self.settings.items():
            words += ["--set", f"{key}={value}"]
        with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              encoding="utf-8", errors="replace") as process:
            printed, mistakes = self._wait(process)
        text = mistakes.strip() or printed.strip()
        if process.returncode == MISTAKE:
            raise Refused(text)
        if process.returncode not in (0, CHECKS_FAILED):
            raise Failed(text, process.returncode)
        return printed

    @staticmethod
    def _wait(process):
        try:
            return process.communicate()
        except KeyboardInterrupt:  # the program got it too, and stops with a checkpoint
            process.communicate()
            raise

    def __repr__(self):
        return f"<Case {self.path}>"
