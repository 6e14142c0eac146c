#!/usr/bin/env python3
"""Builds the deliberate faults of tests/mutants/ into the kernels, one at a time, and runs each kernel's tests, which must notice.

The tests run on the C++ execution alone, where nothing but the truth and the tests' own promises can give a fault away: the
other executions are compared with this one, and would notice every fault by that. Exit status 1 where a fault passes.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "kernels/portable"))
from generate import read_mutants  # noqa: E402


def run(command, **more):
    return subprocess.run(command, capture_output=True, text=True, **more)


class Build:
    def __init__(self, folder, jobs):
        self.folder, self.jobs = folder, jobs

    def configure(self, mutant):
        done = run(["cmake", "--preset", "ci", "-B", self.folder, f"-DLUXEL_MUTANT={mutant}", "-DLUXEL_PYTHON=OFF"], cwd=ROOT)
        if done.returncode:
            sys.exit(done.stderr)

    def tests(self, pattern):
        """{label: [test]} of a kernel."""
        listed = json.loads(run(["ctest", "--show-only=json-v1", "-R", pattern], cwd=self.folder).stdout)["tests"]
        if not listed:
            sys.exit(f"no test is named {pattern}")
        found = {"quick": [], "full": []}
        for test in listed:
            label = next(p["value"][0] for p in test["properties"] if p["name"] == "LABELS")
            found[label].append(test["name"])
        return found

    def make(self, tests):
        targets = sorted({name.removesuffix("_full") for name in tests})
        return run(["ninja", "-C", self.folder, f"-j{self.jobs}", *targets])

    def check(self, tests):
        """What noticed a fault, None where nothing did."""
        if not tests:
            return None
        pattern = "^(" + "|".join(map(re.escape, tests)) + ")$"
        done = run(["ctest", "-R", pattern, "--stop-on-failure", "--output-on-failure", "--timeout", "300"], cwd=self.folder,
                   env={**os.environ, "LUXEL_BACKENDS": "cpu"})
        if done.returncode == 0:
            return None
        failed = re.findall(r"^\[  FAILED  \] (\S+?),? .*\(\d+ ms\)", done.stdout, re.MULTILINE)
        late = re.findall(r"(\w+) .*\*\*\*Timeout", done.stdout)
        return failed[0] if failed else f"{late[0]} does not end" if late else done.stdout.strip().splitlines()[-1]


def judge(build, kernel, mutants, tests):
    """A row for each fault, as it is known."""
    for number, (name, file, before, after) in enumerate(mutants):
        begin = time.monotonic()
        build.configure(f"{kernel}:{number}")
        made = build.make(tests["quick"] + tests["full"])
        if made.returncode:
            sys.exit(f"{kernel}: {name}: does not compile\n{made.stdout[-3000:]}")
        caught = build.check(tests["quick"]) or build.check(tests["full"])
        print(f"{kernel:18} {name:60} {caught or 'PASSES UNNOTICED'}  ({time.monotonic() - begin:.0f} s)", flush=True)
        yield {"kernel": kernel, "fault": name, "file": file, "before": before, "after": after, "caught_by": caught}


def main():
    cli = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    cli.add_argument("kernels", nargs="*", help="all by default")
    cli.add_argument("--build", type=pathlib.Path, default=ROOT / "build/mutation")
    cli.add_argument("--out", type=pathlib.Path, default=ROOT / "tests/mutants/score.json", help="the list with what noticed each")
    cli.add_argument("--jobs", type=int, default=os.cpu_count())
    args = cli.parse_args()
    lists = {path.stem: path for path in sorted((ROOT / "tests/mutants").glob("*.txt"))}
    kernels = args.kernels or list(lists)
    rows = json.loads(args.out.read_text()) if args.out.exists() else []
    build = Build(args.build, args.jobs)
    for kernel in kernels:
        mutants, pattern = read_mutants(lists[kernel])
        build.configure("")
        tests = build.tests(pattern)
        made = build.make(tests["quick"] + tests["full"])
        unsound = made.returncode or build.check(tests["quick"])
        if unsound:
            sys.exit(f"{kernel}: its tests fail without any fault: {unsound}\n{made.stdout[-3000:] if made.returncode else ''}")
        rows = [row for row in rows if row["kernel"] != kernel]
        for row in judge(build, kernel, mutants, tests):
            rows.append(row)
            rows.sort(key=lambda r: r["kernel"])
            args.out.write_text(json.dumps(rows, indent=1) + "\n")
    build.configure("")
    missed = [row for row in rows if row["kernel"] in kernels and not row["caught_by"]]
    checked = [row for row in rows if row["kernel"] in kernels]
    print(f"{len(checked) - len(missed)} of {len(checked)} faults are noticed")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
