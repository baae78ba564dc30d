"""What tests that draw cases by a seed share."""
import os
import pathlib
import subprocess


def run(name, text):
    """The exit status and the output of a run of the case TEXT."""
    case = pathlib.Path(f"{name}.yaml")
    case.write_text(text)
    result = subprocess.run([os.environ["BOLIDE"], "run", case, "--threads", "1", "--overwrite",
                             "--output", name], text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    return result.returncode, result.stdout
