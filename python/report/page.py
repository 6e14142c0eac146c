"""One HTML file that needs nothing beside it: tables, plots as SVG, pictures as data URIs."""

import base64
import html
import json
import pathlib

import rows
import takeover
from rows import number

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 1280px; padding: 1rem 1.5rem 4rem;
  color: #222; background: #fff }
h1 { font-size: 1.6rem }
h2 { margin-top: 2.5rem; border-bottom: 1px solid #ddd }
h3 { margin-top: 1.6rem }
table { border-collapse: collapse; font-size: 13px; margin: .5rem 0 }
th, td { padding: .2rem .6rem; text-align: left; border-bottom: 1px solid #eee; vertical-align: top }
th { background: #f6f6f6; position: sticky; top: 0 }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums }
tr.bad td { background: #fde8e8 }
.note { color: #555; max-width: 60rem }
.wide { overflow-x: auto } .wide svg { max-width: 100%; height: auto }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem }
figure { margin: 0; max-width: 384px }
figure img { width: 100%; image-rendering: auto }
figcaption { font-size: 12px; color: #555 }
summary { cursor: pointer; margin: .4rem 0 }
nav a { margin-right: 1rem }
#tip { position: fixed; display: none; background: #222; color: #fff; font-size: 12px;
  padding: .3rem .5rem; border-radius: 4px; white-space: pre; pointer-events: none; z-index: 9 }
"""
SCRIPT = """
const tip = document.getElementById('tip');
for (const point of document.querySelectorAll('g[id^=point]')) {
  const title = point.querySelector('title'), text = title.textContent;
  point.addEventListener('mousemove', e => {
    title.textContent = ''; tip.textContent = text; tip.style.display = 'block';
    tip.style.left = Math.min(e.clientX + 12, innerWidth - tip.offsetWidth - 8) + 'px';
    tip.style.top = e.clientY + 12 + 'px';
  });
  point.addEventListener('mouseleave', () => { title.textContent = text; tip.style.display = 'none'; });
}
"""
METRICS = {
    "max |x - t| / max |input|": "The largest difference of any channel of any pixel from the truth, over the largest "
    "value of the input. The truth is a convolution in double with the whole kernel (what is cut off sums to less than "
    "1e-16), at the same border.",
    "max |x - t| / max |input|, all levels": "The largest difference of any channel of any texel of any level (and "
    "direction) from the truth, over the largest value of level 0. The truth is the same reduction in double, from "
    "level 0 on, never from a rounded level.",
    "half L1 of the impulse response's error": "The share of the filter's weight that lies in the wrong place: half the "
    "sum of |response - true response| to a single pixel of 1.",
    "max |x - direct| / max |input|": "The largest difference of any channel of any pixel from the variant direct at the same "
    "radius in double, over the largest value of the input: what a cheaper variant leaves of the formula.",
    "1 / PSNR, as rms / max |input|": "The root mean square of the differences from the variant direct at the same radius in "
    "double, over the largest value of the input: its reciprocal is the peak signal to noise ratio.",
    "relmse_pixel, all pixels": "The mean over pixels and channels of (x - t)² / (t² + (0.01 mean t)²), t being the same picture "
    "rendered to convergence: noise that is left, and what the filter blurred.",
    "relmse_pixel, off edges": "The same without pixels beside an edge of depth or normals, which filters blur first.",
    "|mean of x - t| in steps of the format": "How far the mean of a level drifted from the truth's, in steps of the storage "
    "format: rounding that always goes one way would add up from level to level.",
    "max |x - t| of colour 0..1": "The largest difference of any channel of any voxel from the truth: the mean over the "
    "triangles in the voxel weighted by their exact areas within it, in double.",
    "voxels missing or extra": "How many voxels are set that the exact test in integers (separating axes) leaves empty, or the "
    "other way round. 0 is promised.",
    "voxels that differ from the window anew": "How many voxels of the window that scrolled differ in any bit from a window that "
    "was voxelized anew in its place. 0 is promised.",
    "voxels whose light differs from everything anew": "How many voxels' light differs in any bit from lighting everything anew. "
    "0 is promised.",
    "share of occupied voxels that differ from everything anew": "The share of occupied voxels that differ in any bit from "
    "voxelizing and lighting everything anew.",
    "root mean square of x - rays through the voxels": "Irradiance by cones against the cosine-weighted mean over many rays that "
    "march through the finest voxels in double: root mean square over the receivers, over the truth's mean. The error of cones "
    "and pyramid, not of voxels.",
    "irradiance after one bounce": "Against path tracing at the same receivers, which gives two independent halves t1 and t2: "
    "the mean of (x - t1)(x - t2) is the mean squared error without the noise of the truth; over the square of the truth's "
    "mean. 1 is a picture as wrong as its mean is large.",
    "reflected radiance": "Against path tracing of the same pixels in two independent halves t1 and t2: the mean of "
    "(x - t1)(x - t2), the mean squared error without the noise of the truth, over the square of the truth's mean. Misses count "
    "with what they fell back on.",
    "share of rays that end elsewhere than the exhaustive walk's": "The share of rays whose hit is another pixel, or that hit "
    "where the walk over every pixel on the way, in double, finds none, or the other way round.",
    "share of rays that end elsewhere than Embree's": "The share of rays off surfaces with another outcome than the exact ray "
    "through the triangles, or a hit farther from its than two texel footprints and 1 % of the distance.",
    "irradiance for random normals": "Irradiance looked up for random normals against quadrature over the texels that the probe "
    "saw, in double: root mean square, over the mean.",
    "energy in the dark room": "Two rooms with a wall between them, a lamp in one: the energy that reaches the surfaces of the "
    "other one, over the lamp's. The truth is 0.",
    "rms of E r^2 against the linear operator": "Irradiance times squared distance around one light, against the same scheme "
    "without its treatment of negative lobes, in double: root mean square. The truth is at most 1.",
    "rms of E r^2 against the inverse square": "Irradiance times squared distance around one light in free space, where it is "
    "the same everywhere, against that: root mean square. What propagation in steps of a cell makes of light, diffusion above all.",
}


def esc(value):
    return html.escape(str(value))


def meaning(metric):
    """What a metric says: METRICS by its whole name, or by how it begins."""
    return METRICS.get(metric) or next((text for name, text in METRICS.items() if metric.startswith(name)), "")


def table(head, body, bad=lambda row: False):
    """`head`: names, a leading # for numbers. `body`: (row, cells)."""
    numeric = [name.startswith("#") for name in head]
    cells = lambda tag, values: "".join(f'<{tag}{" class=n" if n else ""}>{v}</{tag}>' for n, v in zip(numeric, values))
    lines = [f"<tr>{cells('th', [esc(name.lstrip('#')) for name in head])}</tr>"]
    lines += [f'<tr{" class=bad" if bad(row) else ""}>{cells("td", map(esc, values))}</tr>' for row, values in body]
    return '<div class="wide"><table>' + "\n".join(lines) + "</table></div>"


def details(summary, content, is_open=False):
    return f'<details{" open" if is_open else ""}><summary>{esc(summary)}</summary>{content}</details>'


def percent(value):
    return "–" if value is None else f"{100 * value:.0f} %"


def frontier_table(report, points):
    def cells(row):
        gigabytes, of_copy, gigaflops, of_arithmetic = rows.achieved(report, row)
        parts = [number(row["error"][part]) for part in rows.PARTS]
        return [
            row["variant"],
            rows.options(row),
            rows.knobs(row),
            row["scene"],
            row["size"],
            number(rows.total_error(row)),
            *parts,
            number(rows.total_time(row), 4),
            f'{number(rows.total_time(row, "q1"))}–{number(rows.total_time(row, "q3"))}{" (busy)" if rows.busy(row) else ""}',
            number(gigabytes),
            percent(of_copy),
            number(gigaflops),
            percent(of_arithmetic),
            number(None if row["memory_bytes"] is None else row["memory_bytes"] / 2**20),
            "yes" if row["on_frontier"] else "",
        ]

    head = [
        "variant",
        "options",
        "knobs",
        "scene",
        "size",
        "#error",
        "#rounding",
        "#storage",
        "#device",
        "#method",
        "#ms",
        "#quartiles",
        "#GB/s",
        "#of copy",
        "#GFLOP/s",
        "#of peak",
        "#MiB",
        "frontier",
    ]
    return table(head, [(row, cells(row)) for row in points])


def kernel_section(report, kernel, pictures, figures, folder):
    parts = [f'<h2 id="{esc(kernel)}">{esc(kernel)}</h2>']
    points = [row for row in report["frontier"] if row["kernel"] == kernel]
    parts.append("<h3>Error against run time</h3>")
    for metric in dict.fromkeys(row["error"]["metric"] for row in points if "level" not in row["knobs"]):
        parts.append(f'<p class="note"><b>{esc(metric)}.</b> {esc(meaning(metric))}</p>')
    parts.append(
        '<p class="note">Error: the sum of its parts, no less than the whole. Rounding: float against double. Storage: '
        'rounding by the format of the result. Device: against C++ in float, 0 where the bits are equal. Method: '
        'double '
        'against the truth. A filled point is on the frontier: no setting whose error is not larger has a third quartile '
        'of time below its first; settings whose quartiles overlap are not told apart, and both stay. '
        'The pointer on a point names its setting.</p>'
    )
    mine = [figure for figure in figures if figure[0] == kernel]
    for index, (_, scene, metric, count, svg) in enumerate(mine):
        drawing = f'<div class="wide">{svg}</div>'
        parts.append(drawing if index == 0 else details(f"{scene}: {metric}, {count} points", drawing))
    shots = [picture for picture in pictures if picture["kernel"] == kernel]
    if shots:
        parts.append('<h3>Pictures</h3><div class="pictures">')
        for shot in shots:
            data = base64.b64encode((folder / shot["file"]).read_bytes()).decode()
            parts.append(
                f'<figure><img alt="{esc(shot["caption"])}" src="data:image/png;base64,{data}">'
                f'<figcaption>{esc(shot["caption"])}</figcaption></figure>'
            )
        parts.append("</div>")
    if kernel == "gaussian_blur":
        head, lines = takeover.table(report)
        parts.append(
            "<h3>Which variant at which σ</h3><p class=note>The cheapest variant whose error stays within the bound, and "
            "its time in ms. ≈: the quartiles do not tell them apart. –: no setting measured is so exact.</p>"
        )
        parts.append(table(head, [(line, line) for line in lines]))
    parts.append("<h3>Settings</h3>")
    for device in dict.fromkeys(row["device"] for row in points):
        here = [row for row in points if row["device"] == device]
        best = [row for row in here if row["on_frontier"]]
        parts.append(details(f"{device}: {len(best)} settings on the frontier", frontier_table(report, best)))
        parts.append(details(f"{device}: all {len(here)} settings", frontier_table(report, here)))
    parts += [defaults(report, kernel), stability(report, kernel), peers(report, kernel), left_out(report, kernel)]
    return "\n".join(parts)


def defaults(report, kernel):
    mine = [row for row in report.get("defaults", []) if row["kernel"] == kernel]
    if not mine:
        return ""
    beaten = [row for row in mine if row["better"]]
    lines = "".join(f"<p class=note>Where it is not: {esc(why)}.</p>" for why in dict.fromkeys(row["why"] for row in beaten))
    body = [
        (
            row,
            [
                row["device"],
                f'{row["scene"]}, {row["size"]}',
                row["metric"],
                rows.setting(row["setting"]),
                number(row["error"]),
                number(row["ms"]),
                rows.setting(row["better"]["setting"]),
                number(row["better"]["error"]),
                number(row["better"]["ms"]),
            ],
        )
        for row in beaten
    ]
    head = ["device", "scene", "metric", "default", "#error", "#ms", "the fastest that beats it", "#its error", "#its ms"]
    return (
        f"<h3>The default</h3><p class=note>On the frontier in {len(mine) - len(beaten)} of the {len(mine)} places where it was "
        f"measured.</p>{lines}" + (details(f"{len(beaten)} where something beats it", table(head, body)) if beaten else "")
    )


def methods(report, figures):
    """Every method of global illumination on the same scenes, receivers and metric."""
    if not figures:
        return ""
    parts = ['<h2 id="methods">Global illumination: error against time, all methods</h2>']
    parts.append(
        '<p class="note">Rows of all kernels that light the same receivers of the same scene, by the same metric against '
        'the same path-traced truth: what the error is, and what moving light costs a frame. Time is update (once for a '
        'change of light) and shade (once for a picture) together; what is built once for a scene is left out. The line '
        'joins what nothing is as exact as and faster.</p>'
    )
    for index, (scene, metric, count, svg) in enumerate(figures):
        drawing = f'<div class="wide">{svg}</div>'
        parts.append(drawing if index == 0 else details(f"{scene}: {metric}, {count} points", drawing))
    for (scene, size, metric), mine in rows.by_scene(report).items():
        for device in dict.fromkeys(row["device"] for row in mine):
            best = rows.best_of([row for row in mine if row["device"] == device])
            body = [
                (
                    row,
                    [
                        row["kernel"],
                        rows.setting(row),
                        number(rows.total_error(row)),
                        number(rows.frame_time(row), 4),
                        number(row["time_ms"]["update"] and row["time_ms"]["update"]["median"]),
                        number(row["time_ms"]["shade"] and row["time_ms"]["shade"]["median"]),
                        number(row["time_ms"]["build"] and row["time_ms"]["build"]["median"]),
                        number(None if row["memory_bytes"] is None else row["memory_bytes"] / 2**20),
                    ],
                )
                for row in best
            ]
            head = ["kernel", "setting", "#error", "#ms", "#update", "#shade", "#build", "#MiB"]
            parts.append(details(f"{scene}, {device}: which one to take, by time", table(head, body)))
    return "\n".join(parts)


def stability(report, kernel):
    mine = [row for row in report["stability"] if row["kernel"] == kernel]
    if not mine:
        return ""
    parts = ["<h3>Promises in extreme cases</h3>"]
    for device in dict.fromkeys(row["device"] for row in mine):
        here = sorted((row for row in mine if row["device"] == device), key=lambda row: row["pass"])
        kept = sum(row["pass"] for row in here)
        body = [
            (
                row,
                [
                    row["case"],
                    row["promise"],
                    number(row["bound"]),
                    number(row["measured"]),
                    "kept" if row["pass"] else "BROKEN",
                ],
            )
            for row in here
        ]
        parts.append(
            details(
                f"{device}: {kept} of {len(here)} kept",
                table(["case", "promise", "#bound", "#measured", ""], body, lambda row: not row["pass"]),
                kept < len(here),
            )
        )
    return "\n".join(parts)


def peers(report, kernel):
    mine = [row for row in report["peers"] if row["kernel"] == kernel]
    if not mine:
        return ""
    missed = lambda row: row["goal"] is not None and not (row["ratio"] is not None and row["ratio"] >= row["goal"])
    body = [
        (
            row,
            [
                row["peer"],
                row["version"],
                row["device"],
                rows.options(row, True),
                row["size"],
                number(row["own_ms"] and row["own_ms"]["median"]),
                number(row["time_ms"] and row["time_ms"]["median"]),
                number(row["ratio"]),
                f'{number(row["q1"])}–{number(row["q3"])}',
                number(row["own_error"]),
                number(row["error"]),
                number(row["goal"]) + (" missed" if missed(row) else ""),
            ],
        )
        for row in mine
    ]
    return (
        "<h3>Peers</h3><p class=note>Taken in turn: ours, peer, ours, peer. Ratio: median of the peer's time over "
        "ours, pair by pair; "
        "above 1 we are faster.</p>"
        + table(
            [
                "peer",
                "version",
                "device",
                "options",
                "size",
                "#ours, ms",
                "#peer, ms",
                "#ratio",
                "#quartiles",
                "#our error",
                "#its error",
                "#goal",
            ],
            body,
            missed,
        )
    )


def left_out(report, kernel):
    mine = [row for row in report["left_out"] if row["kernel"] == kernel]
    if not mine:
        return ""
    body = [
        (
            row,
            [
                row["what"],
                row["level"],
                row["device"],
                row["scene"],
                number(row["saved_ms"]),
                number(None if row["saved_bytes"] is None else row["saved_bytes"] / 2**20),
                number(row["error"]),
            ],
        )
        for row in mine
    ]
    return (
        "<h3>Left out where it is not needed</h3><p class=note>Level 1: code and bindings, 2: work, 3: whole passes "
        "or kernels. "
        "Bytes: traffic that is not moved.</p>"
        + table(["what", "#level", "device", "scene", "#saved ms", "#saved MiB", "#error"], body)
    )


def reproduction(report):
    mine = report["reproduction"]
    if not mine:
        return ""
    body = [
        (
            row,
            [
                row["claim"],
                row["source"],
                row["device"],
                number(row["source_value"]),
                number(row["measured"]),
                "–" if row["q1"] is None else f'{number(row["q1"])}–{number(row["q3"])}',
                row["rule"],
                row["verdict"],
                row["reason"],
            ],
        )
        for row in mine
    ]
    return "<h2>Claims measured again</h2>" + table(
        ["claim", "source", "device", "#claimed", "#measured", "#quartiles", "confirmed where it is", "verdict", "reason"], body
    )


MUTANTS = pathlib.Path(__file__).resolve().parents[2] / "tests/mutants/score.json"


def mutation(path=MUTANTS):
    """Deliberate faults in the kernels that were tried, and what noticed them (tests/mutation.py)."""
    if not path.exists():
        return ""
    faults = json.loads(path.read_text())
    body = [(row, [row["kernel"], row["fault"], row["before"], row["after"], row["caught_by"] or "nothing"]) for row in faults]
    caught = sum(1 for row in faults if row["caught_by"])
    return (
        f'<h2 id="mutation">The tests, tested</h2><p class=note>{caught} of {len(faults)} deliberate faults, built into the kernels '
        "one at a time, are noticed by the tests of the C++ execution alone.</p>"
        + details("the list", table(["kernel", "fault", "text", "in its place", "noticed by"], body, lambda row: not row["caught_by"]))
    )


def limits(report):
    machine = report["machine"]
    entries = [("machine", entry) for entry in machine.get("limits", [])]
    entries += [(device["id"], entry) for device in report["devices"] for entry in device["limits"]]
    body = [
        (
            entry,
            [
                where,
                entry["what"],
                entry["size"],
                number(entry["bytes_per_pixel"]),
                number(entry["rate"]),
                entry["unit"],
                f'{number(entry["q1"])}–{number(entry["q3"])}',
                entry["form"],
            ],
        )
        for where, entry in entries
    ]
    return table(["where", "what", "size", "#bytes/pixel", "#rate", "unit", "#quartiles", "form"], body)


def first_use(report):
    parts = []
    for device in report["devices"]:
        slowest = sorted(device["first_use"], key=lambda use: -(use["compile_ms"] + use["first_run_ms"]))[:25]
        body = [(use, [use["label"], number(use["compile_ms"]), number(use["first_run_ms"])]) for use in slowest]
        parts.append(
            details(
                f'{device["id"]}: the slowest of {len(device["first_use"])} first uses',
                table(["setting", "#compile, ms", "#first run, ms"], body),
            )
        )
    return "\n".join(parts)


def page(report, pictures, figures, folder, all_methods=()):
    machine, guard = report["machine"], report["machine"]["guard"]
    kernels = list(dict.fromkeys(row["kernel"] for row in report["frontier"]))
    broken = [row for row in report["stability"] if not row["pass"]]
    died = [device for device in report["devices"] if device["died"]]
    parts = [
        "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
        "content='width=device-width'><title>luxel report</title>",
        f"<style>{STYLE}</style><div id=tip></div><h1>luxel: error against run time</h1>",
        f'<p class=note>{esc(machine["cpu"])}, {machine["cores"]} cores; {esc(machine["system"])}; luxel '
        f'{esc(machine["luxel"])}, '
        f'{esc(machine["compiler"])}; {esc(machine["taken"])}{"; quick report" if machine["quick"] else ""}.</p>',
        f'<p><b>{len(report["frontier"])} settings measured, {len(report["stability"])} promises, '
        + (f'{len(broken)} of them broken' if broken else "all kept")
        + "."
        + "".join(f' {esc(device["id"])} died.' for device in died)
        + "</b></p>",
        "<nav>"
        + "".join(f'<a href="#{esc(kernel)}">{esc(kernel)}</a>' for kernel in kernels)
        + ('<a href="#methods">all methods</a>' if all_methods else "")
        + '<a href="#machine">machine</a></nav>',
    ]
    parts += [kernel_section(report, kernel, pictures, figures, folder) for kernel in kernels]
    parts.append(methods(report, all_methods))
    parts.append(reproduction(report))
    parts.append(mutation())
    parts.append('<h2 id="machine">Devices and limits</h2>')
    parts.append(
        table(
            ["device", "driver", "profile", "problems"],
            [(d, [d["id"], d["driver"], d["profile"], "; ".join(map(str, d["problems"]))]) for d in report["devices"]],
            lambda d: d["died"],
        )
    )
    parts.append(
        f'<p class=note>A loop of multiply-adds on two threads ran beside each row, at best at '
        f'{number(guard["best_gflops"], 4)} GFLOP/s; '
        f'rows taken while it ran below {number(guard["threshold"])} of that were taken again. '
        f'{len(guard["flagged"])} rows stayed so.</p>'
    )
    parts.append("".join(f"<p class=note>Skipped: {esc(line)}</p>" for line in machine.get("skipped", [])))
    parts.append(
        "<h3>Limits, measured in the same run</h3><p class=note>Copies and triad move each byte once in and once "
        "out. Arithmetic is a "
        "product and a sum, which stay apart as in every kernel here (contraction is off, so that all devices give "
        "the same bits).</p>"
    )
    parts.append(details("all limits", limits(report)))
    parts.append(
        "<h3>First use</h3><p class=note>Compilation and first run, with empty caches.</p>" + first_use(report)
    )
    parts.append(f"<script>{SCRIPT}</script></html>")
    return "\n".join(parts)
