"""The program `luxel` from Python: reports and tuning, with their progress shown as they run."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading

from . import _luxel


def program():
    """Path of the program: the environment variable LUXEL_PROGRAM, else `luxel` on the PATH. Errors: luxel.Error."""
    found = os.environ.get("LUXEL_PROGRAM") or shutil.which("luxel")
    if not found or not os.access(found, os.X_OK):
        raise _luxel.Error("the program luxel is not found; install luxel, or set LUXEL_PROGRAM to it")
    return found


def call(arguments, progress=None):
    """Runs the program; each line of its progress goes to `progress` (default: one line on stderr that is rewritten, in a notebook
    too). Returns what it printed. Errors: luxel.Error with the program's own line; ValueError for wrong use."""
    def show(line):
        sys.stderr.write("\r" + line[:100].ljust(100))
        sys.stderr.flush()
    progress = progress or show
    with subprocess.Popen([program(), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, bufsize=1) as child:
        last = ""
        with tempfile.TemporaryFile("w+") as printed:
            reader = threading.Thread(target=lambda: [printed.write(line) for line in child.stdout])
            reader.start()
            try:
                for line in child.stderr:
                    for part in line.replace("\r", "\n").splitlines():
                        if part.strip():
                            last = part.strip()
                            progress(last)
            except BaseException:
                child.terminate()
                raise
            reader.join()
            status = child.wait()
            printed.seek(0)
            text = printed.read()
    if progress is show and last:
        sys.stderr.write("\n")
    if status == 2:
        raise ValueError(last.removeprefix("luxel: "))
    return text, status


def report(folder="luxel-report", *, quick=False, kernels=(), devices=(), progress=None):
    """Measures as `luxel report` does, and returns the report (report.json; index.html lies beside it in `folder`). kernels, devices:
    names; all where empty. A broken promise is no exception: it stands in the report. Errors: luxel.Error, ValueError."""
    arguments = ["report", "-o", folder] + (["--quick"] if quick else [])
    for word, names in (("--kernel", kernels), ("--device", devices)):
        for name in names:
            arguments += [word, name]
    call(arguments, progress)
    path = pathlib.Path(folder) / "report.json"
    if not path.exists():
        raise _luxel.Error(f"the report ended without {path}")
    return json.loads(path.read_text())


def tune(kernel, *, max_error=None, max_ms=None, scene=None, device=None, progress=None):
    """The cheapest setting of a kernel within an error, or the most exact within a time, as `luxel tune` finds it: its JSON.
    Errors: ValueError (neither or both are given, or wrong use), luxel.Error where no setting is found."""
    if (max_error is None) == (max_ms is None):
        raise ValueError("tune: one of max_error and max_ms is expected")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "tune.json"
        arguments = ["tune", kernel, "--json", path]
        for word, value in (("--max-error", max_error), ("--max-ms", max_ms), ("--scene", scene), ("--device", device)):
            if value is not None:
                arguments += [word, value]
        text, status = call(arguments, progress)
        if status != 0 or not path.exists():
            raise _luxel.Error(text.strip().splitlines()[-1] if text.strip() else "tune found no setting")
        return json.loads(path.read_text())
