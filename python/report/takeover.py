#!/usr/bin/env python3
"""Which variant of gaussian_blur is cheapest at which sigma, from measured rows; fills the table of the kernel's README.

usage: takeover.py REPORT.json README.md     replaces what stands between <!-- takeover --> and <!-- /takeover -->
"""

import json
import pathlib
import sys

import rows

ERRORS = (1e-2, 1e-3, 1e-4)
METRIC = "max |x - t| / max |input|"
START, END = "<!-- takeover -->", "<!-- /takeover -->"


def settings(report):
    """Rows that compare: plain f32x4 with borders clamped, on the scene that most sigmas were measured on."""
    plain = [
        row
        for row in report["frontier"]
        if row["kernel"] == "gaussian_blur"
        and row["error"]["metric"] == METRIC
        and row["options"].get("format") == "f32x4"
        and row["options"].get("border") == "clamp"
        and not any(row["options"].get(name) for name in ("difference", "keep_alpha", "drop_taps"))
    ]
    views = {}
    for row in plain:
        views.setdefault((row["scene"], row["size"]), set()).add(row["knobs"]["sigma"])
    best = max(views, key=lambda view: len(views[view]), default=None)
    return [row for row in plain if (row["scene"], row["size"]) == best]


def cheapest(candidates):
    """The variant of the least median, and those that the quartiles do not tell from it; "" where there is none."""
    if not candidates:
        return ""
    first = min(candidates, key=rows.total_time)
    level = rows.total_time(first, "q3")
    alike = {}
    for row in sorted(candidates, key=rows.total_time):
        if rows.total_time(row, "q1") <= level:
            alike.setdefault(row["variant"], row)
    names = " ≈ ".join(alike)
    return f"{names} {rows.number(rows.total_time(first))}"


def table(report):
    """(head, lines): a line a device and sigma, a cell an error."""
    found, lines = settings(report), []
    for device in dict.fromkeys(row["device"] for row in found):
        here = [row for row in found if row["device"] == device]
        for sigma in sorted({row["knobs"]["sigma"] for row in here}):
            mine = [row for row in here if row["knobs"]["sigma"] == sigma]
            cells = [cheapest([row for row in mine if rows.total_error(row) <= error]) for error in ERRORS]
            lines.append([device, rows.number(sigma), *(cell or "–" for cell in cells)])
    return ["device", "σ", *(f"error ≤ {error:g}" for error in ERRORS)], lines


def markdown(report):
    head, lines = table(report)
    if not lines:
        return ""
    found = settings(report)
    text = [f"Cheapest variant and its time in ms ({found[0]['scene']}, {found[0]['size']}, f32x4; ≈: not told apart by quartiles):", ""]
    text += ["| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *lines]]
    return "\n".join(text)


def main():
    if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    report, readme = json.loads(pathlib.Path(sys.argv[1]).read_text()), pathlib.Path(sys.argv[2])
    before, start, rest = readme.read_text().partition(START)
    _, end, after = rest.partition(END)
    text = markdown(report)
    if not start or not end or not text:
        print(f"{readme}: no {START} … {END}" if text else "the report has no rows of gaussian_blur", file=sys.stderr)
        return 2
    readme.write_text(f"{before}{START}\n{text}\n{END}{after}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
