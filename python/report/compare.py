#!/usr/bin/env python3
"""Whether two reports of one machine agree: the errors of every setting to the last digit, and the frontier up to the noise of times.

usage: compare.py A B     each a report's folder or its report.json; exit status 1 where they do not agree

A setting that is on the frontier in one report alone is noise as long as some setting that beats it in the other is not
clearly slower here: the first quartile of its time does not lie above the third of the setting's own. Times that a report
says were taken while the machine did something else decide nothing.
"""

import json
import pathlib
import sys

import rows

# What these write depends on which invocation comes last, by their definition.
BY_TIMING = {("voxelize", "moving_average"), ("voxelize", "last_write")}


def read(name):
    path = pathlib.Path(name)
    return json.loads((path / "report.json" if path.is_dir() else path).read_text())


def key(row):
    fields = ("kernel", "variant", "device", "scene", "size", "options", "knobs")
    return json.dumps([*(row[field] for field in fields), row["error"]["metric"]], sort_keys=True)


def group(row):
    return row["kernel"], row["device"], row["scene"], row["size"], row["error"]["metric"]


def settings(report):
    found = {}
    for row in report["frontier"]:
        found[key(row)] = row
    return found


def by_timing(row):
    return any((row["kernel"], word) in BY_TIMING for word in (row["variant"], *map(str, row["options"].values())))


def slower(row, other):
    """Beyond what quartiles leave open."""
    return rows.total_time(row, "q1") > rows.total_time(other, "q3")


def unlike(there, here, name, other):
    """Whether `other`, faster than `name` there, is slower here, and no busy machine explains it."""
    return not rows.busy(there[other]) and not rows.busy(here[other]) and slower(here[other], here[name])


def flips(there, here):
    """Settings off the frontier `there` and on it `here`: [(key, whether no noise explains it)]."""
    groups = {}
    for name in there.keys() & here.keys():
        groups.setdefault(group(there[name]), []).append(name)
    found = []
    for names in groups.values():
        for name in names:
            if there[name]["on_frontier"] or not here[name]["on_frontier"]:
                continue
            beating = [
                other
                for other in names
                if rows.total_error(there[other]) <= rows.total_error(there[name]) and slower(there[name], there[other])
            ]
            quiet = not rows.busy(there[name]) and not rows.busy(here[name])
            found.append((name, quiet and bool(beating) and all(unlike(there, here, name, other) for other in beating)))
    return found


def compare(a, b):
    """(lines that say what was found, whether the reports agree)"""
    a, b = settings(a), settings(b)
    both = sorted(a.keys() & b.keys())
    apart = [name for name in both if a[name]["error"] != b[name]["error"]]
    excused = [name for name in apart if by_timing(a[name])]
    wrong = [name for name in apart if not by_timing(a[name])]
    changed = flips(a, b) + flips(b, a)
    beyond = [name for name, unexplained in changed if unexplained]
    lines = [
        f"{len(both)} settings are in both reports, {len(a) - len(both)} in the first alone, {len(b) - len(both)} in the second alone",
        f"errors: {len(both) - len(apart)} equal to the last digit, {len(wrong)} different, {len(excused)} different that depend on timing",
        f"frontier: {len(both) - len(changed)} the same, {len(changed) - len(beyond)} changed within the noise of times, {len(beyond)} beyond it",
        *(f"error: {name}" for name in wrong),
        *(f"frontier: {name}" for name in beyond),
    ]
    return lines, not wrong and not beyond and bool(both)


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    lines, agree = compare(*map(read, arguments))
    print("\n".join(lines))
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
