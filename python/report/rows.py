"""Reading of report rows: totals, labels, limits. As bench/report/frontier.cpp and table.cpp have them."""

PARTS = ("rounding", "storage", "device", "method")
BYTES_PER_PIXEL = {"f32x4": 16, "f32x2": 8, "f16x4": 8}


def total_error(row):
    """Sum of the parts: by the triangle inequality no less than |result - truth|."""
    return sum(row["error"][part] or 0 for part in PARTS)


def total_time(row, quartile="median"):
    return sum(phase[quartile] for phase in row["time_ms"].values() if phase)


def busy(row):
    """Whether the machine did something else meanwhile."""
    return any(phase.get("busy") for phase in row["time_ms"].values() if phase)


BOUNCE = "irradiance after one bounce"


def frame_time(row, quartile="median"):
    """What moving light costs a frame: update and shade, without what is built once."""
    return sum(row["time_ms"][phase][quartile] for phase in ("update", "shade") if row["time_ms"].get(phase))


def by_scene(report):
    """{(scene, size, metric): rows} of whole scenes that kernels of several names light at the same receivers."""
    views = {}
    for row in report["frontier"]:
        if row["error"]["metric"].startswith(BOUNCE) and frame_time(row) > 0:
            views.setdefault((row["scene"], row["size"], row["error"]["metric"]), []).append(row)
    return {view: mine for view, mine in views.items() if len({row["kernel"] for row in mine}) > 1}


def best_of(mine):
    """Those of one device that nothing is as exact as and faster, the fastest first."""
    best = []
    for row in sorted(mine, key=lambda row: (frame_time(row), total_error(row))):
        if not best or total_error(row) < total_error(best[-1]):
            best.append(row)
    return best


def frontier_line(points):
    """Those of the frontier's settings that a line passes through, from fast and coarse to slow and exact: a setting that a
    more exact one is as fast as, as far as quartiles tell, is left out, so that the line never turns back.
    """
    def beats(other, row):
        a, b = total_error(other), total_error(row)
        if a == b:
            return (total_time(other), id(other)) < (total_time(row), id(row))
        return a < b and total_time(other, "q1") <= total_time(row, "q3")

    kept = [row for row in points if not any(beats(other, row) for other in points if other is not row)]
    return sorted(kept, key=total_time)


def number(value, digits=3):
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, (int, float)):
        return str(value)
    return f"{value:.{digits}g}"


def knobs(row):
    return " ".join(f"{name} {number(value, 4)}" for name, value in row["knobs"].items())


def options(row, every=False):
    words = []
    for name, value in row["options"].items():
        if isinstance(value, bool):
            if value:
                words.append(name)
        elif every or value not in ("clamp", "buffer", "floor", "cells", 2):
            words.append(str(value))
    return " ".join(words)


def setting(row):
    return f"{row['variant']} {options(row)} {knobs(row)}".strip()


def limit(report, device, what, row=None):
    """The limit of a device that stands beside a row: of the same size and bytes per pixel for copies."""
    for entry in next((d["limits"] for d in report["devices"] if d["id"] == device), []):
        if entry["what"] != what:
            continue
        width = BYTES_PER_PIXEL.get(row["options"].get("format"), 4) if row else 0
        if row is None or (entry["size"] == row["size"] and entry["bytes_per_pixel"] == width):
            return entry["rate"]
    return None


def achieved(report, row):
    """(GB/s, share of the copy of the same size, GFLOP/s, share of the arithmetic limit); None where unknown."""
    ms = total_time(row)
    if not ms:
        return None, None, None, None
    rate = lambda work: work / ms * 1e-6 if work is not None else None
    share = lambda value, top: value / top if value is not None and top else None
    gigabytes, gigaflops = rate(row["bytes"]), rate(row["flops"])
    return (
        gigabytes,
        share(gigabytes, limit(report, row["device"], "copy", row)),
        gigaflops,
        share(gigaflops, limit(report, row["device"], "arithmetic")),
    )
