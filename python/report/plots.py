"""Error against run time, a panel a device; every point says its setting when the pointer is on it."""

import html
import io
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

import rows

plt.rcParams.update(
    {
        "svg.fonttype": "none",
        "svg.hashsalt": "luxel",
        "font.family": "sans-serif",
        "font.size": 9,
        "axes.grid": True,
        "grid.color": "#dddddd",
        "grid.linewidth": 0.6,
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
    }
)

MARKERS = "osD^vPX*<>"
FLOOR = 1e-9  # where errors of zero are drawn


def draw(report, folder):
    """[(kernel, scene, metric, number of points, svg)]; also writes each as SVG and PNG into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    figures = []
    for kernel in dict.fromkeys(row["kernel"] for row in report["frontier"]):
        mine = [
            row
            for row in report["frontier"]
            if row["kernel"] == kernel and rows.total_time(row) > 0 and "level" not in row["knobs"]
        ]
        views = {}
        for row in mine:
            views.setdefault((row["scene"], row["size"], row["error"]["metric"]), []).append(row)
        for index, (view, points) in enumerate(sorted(views.items(), key=lambda item: -len(item[1]))):
            devices = list(dict.fromkeys(row["device"] for row in points))
            if len(points) < 3 * len(devices):
                continue
            scene, size, metric = view
            figure = panels(points, devices, f"{kernel} on {scene}, {size}", metric)
            figures.append(
                (kernel, f"{scene}, {size}", metric, len(points), save(figure, points, folder / f"{kernel}_{index}"))
            )
        levels = [row for row in report["frontier"] if row["kernel"] == kernel and "level" in row["knobs"]]
        if levels:
            figure = level_panels(levels, kernel)
            metric = "|mean of x - t| in steps of the format"
            figures.append(
                (
                    kernel,
                    f"{levels[0]['scene']}, {levels[0]['size']}",
                    metric,
                    len(levels),
                    save(figure, levels, folder / f"{kernel}_levels"),
                )
            )
    return figures


def draw_methods(report, folder):
    """[(scene, metric, number of points, svg)]: every method of global illumination on one scene, a panel a device."""
    folder.mkdir(parents=True, exist_ok=True)
    figures = []
    for index, ((scene, size, metric), points) in enumerate(rows.by_scene(report).items()):
        devices = list(dict.fromkeys(row["device"] for row in points))
        kernels = list(dict.fromkeys(row["kernel"] for row in points))
        colours = dict(zip(kernels, plt.cm.viridis(np.linspace(0.0, 0.85, len(kernels)))))
        figure, axes = plt.subplots(1, len(devices), figsize=(5.2 * len(devices), 4.4), sharey=True, squeeze=False)
        for axis, device in zip(axes[0], devices):
            axis.set_xscale("log")
            axis.set_yscale("log")
            mine = [row for row in points if row["device"] == device]
            best = rows.best_of(mine)
            for number, row in enumerate(points):
                if row["device"] != device:
                    continue
                on = row in best
                axis.plot(
                    [rows.frame_time(row)],
                    [max(rows.total_error(row), FLOOR)],
                    marker=MARKERS[kernels.index(row["kernel"]) % len(MARKERS)],
                    ms=6 if on else 4.5,
                    mfc=colours[row["kernel"]] if on else "none",
                    mec=colours[row["kernel"]],
                    ls="",
                    gid=f"point{number}",
                    zorder=3,
                )
            axis.plot(
                [rows.frame_time(row) for row in best],
                [max(rows.total_error(row), FLOOR) for row in best],
                color="#444444",
                lw=0.9,
                zorder=2,
            )
            axis.set_title(device if len(device) < 46 else device[:44] + "…", fontsize=9)
            axis.set_xlabel("update + shade, ms")
        axes[0][0].set_ylabel(metric)
        handles = [
            plt.Line2D([], [], color=colours[k], marker=MARKERS[i % len(MARKERS)], ls="", ms=6, label=k)
            for i, k in enumerate(kernels)
        ]
        figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=6, frameon=False)
        figure.suptitle(f"{scene}, {size}: all methods", y=1.0)
        figure.tight_layout()
        label = lambda row: (
            f"{row['kernel']} {rows.setting(row)}\n{rows.number(rows.frame_time(row), 4)} ms update + shade, "
            f"error {rows.number(rows.total_error(row))}"
        )
        svg = save(figure, points, folder / f"methods_{index}", label)
        figures.append((f"{scene}, {size}", metric, len(points), svg))
    return figures


def save(figure, points, path, label=None):
    figure.savefig(path.with_suffix(".png"), dpi=110, bbox_inches="tight")
    svg = titled(figure, points, label)
    path.with_suffix(".svg").write_text(svg)
    plt.close(figure)
    return svg


def level_panels(points, kernel):
    """Drift of each level of a pyramid, a line a format."""
    devices = list(dict.fromkeys(row["device"] for row in points))
    formats = list(dict.fromkeys(row["options"]["format"] for row in points))
    colours = dict(zip(formats, plt.cm.viridis(np.linspace(0.0, 0.9, len(formats)))))
    figure, axes = plt.subplots(1, len(devices), figsize=(5.2 * len(devices), 3.4), sharey=True, squeeze=False)
    for axis, device in zip(axes[0], devices):
        axis.set_yscale("log")
        axis.axhline(1 / 16, color="#aa3333", lw=1, ls="--")
        axis.set_title(device if len(device) < 46 else device[:44] + "…", fontsize=9)
        axis.set_xlabel("level (dashed: bound for levels of 16³ texels or more)")
        for kind in formats:
            mine = sorted(
                (row["knobs"]["level"], max(rows.total_error(row), FLOOR), index)
                for index, row in enumerate(points)
                if row["device"] == device and row["options"]["format"] == kind
            )
            axis.plot(
                [level for level, _, _ in mine], [drift for _, drift, _ in mine], color=colours[kind], lw=1, label=kind
            )
            for level, drift, index in mine:
                axis.plot([level], [drift], marker="o", ms=5, color=colours[kind], ls="", gid=f"point{index}")
    axes[0][0].set_ylabel("|mean drift|, steps of the format")
    axes[0][0].legend(frameon=False)
    figure.suptitle(f"{kernel}: drift over the levels of {points[0]['scene']}, {points[0]['size']}", y=1.0)
    figure.tight_layout()
    return figure


def colour_key(row):
    """What the colours of a panel tell apart: what is asked for, not how it is done."""
    if "sigma" in row["knobs"]:
        return f"σ {rows.number(row['knobs']['sigma'])}"
    return row["options"].get("format", row["variant"])


def receiver(row):
    """What is asked for: rows with the same compare. Variants of a blur give the same, those of a pyramid do not."""
    how = () if {"sigma", "cones"} & row["knobs"].keys() else (row["variant"],)
    return (
        colour_key(row),
        row["options"].get("format"),
        row["options"].get("border"),
        row["options"].get("sizes"),
        row["options"].get("ratio"),
        row["options"].get("samples"),
        *how,
    )


def natural(text):
    return [float(part) if index % 2 else part for index, part in enumerate(re.split(r"(\d+(?:\.\d+)?)", text))]


def panels(points, devices, title, metric):
    keys = sorted(dict.fromkeys(map(colour_key, points)), key=natural)
    colours = dict(zip(keys, plt.cm.viridis(np.linspace(0.0, 0.9, max(len(keys), 1)))))
    kinds = list(dict.fromkeys(kind(row) for row in points))
    markers = {k: MARKERS[i % len(MARKERS)] for i, k in enumerate(kinds)}
    figure, axes = plt.subplots(1, len(devices), figsize=(5.2 * len(devices), 4.4), sharey=True, squeeze=False)
    for axis, device in zip(axes[0], devices):
        panel(axis, [(i, row) for i, row in enumerate(points) if row["device"] == device], colours, markers)
        axis.set_title(device if len(device) < 46 else device[:44] + "…", fontsize=9)
        axis.set_xlabel("time, ms (bar: first to third quartile)")
    axes[0][0].set_ylabel(metric)
    handles = [plt.Line2D([], [], color=colours[key], lw=3, label=key) for key in keys]
    handles += [plt.Line2D([], [], color="#444444", marker=markers[k], ls="", ms=6, label=k) for k in kinds]
    handles += [plt.Line2D([], [], color="#444444", marker="o", ls="", ms=6, mfc="none", label="not on the frontier")]
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=6, frameon=False)
    figure.suptitle(title, y=1.0)
    figure.tight_layout()
    return figure


def kind(row):
    words = [row["variant"]]
    if row["options"].get("input") == "image" and row["variant"] != "sampler":
        words.append("image")
    return " ".join(words)


def panel(axis, numbered, colours, markers):
    axis.set_xscale("log")
    axis.set_yscale("log")
    frontiers = {}
    for index, row in numbered:
        time, error = rows.total_time(row), max(rows.total_error(row), FLOOR)
        colour = colours[colour_key(row)]
        on = row["on_frontier"]
        axis.plot(
            [rows.total_time(row, "q1"), rows.total_time(row, "q3")], [error, error], color=colour, lw=1, alpha=0.6
        )
        axis.plot(
            [time],
            [error],
            marker=markers[kind(row)],
            ms=6 if on else 4.5,
            mfc=colour if on else "none",
            mec=colour,
            ls="",
            gid=f"point{index}",
            zorder=3,
        )
        if on:
            frontiers.setdefault(receiver(row), []).append(row)
    for (key, *_), points in frontiers.items():
        line = [(rows.total_time(row), max(rows.total_error(row), FLOOR)) for row in rows.frontier_line(points)]
        axis.plot(*zip(*line), color=colours[key], lw=0.9, alpha=0.7, zorder=2)


def titled(figure, points, label=None):
    """SVG text in which each point has a <title>: its setting, time and error, or what `label` makes of its row."""
    text = io.StringIO()
    figure.savefig(text, format="svg", bbox_inches="tight", metadata={"Date": None})
    svg = re.sub(r"^.*?(?=<svg )", "", text.getvalue(), flags=re.DOTALL)

    def title(match):
        row = points[int(match.group(1))]
        if label:
            return f'{match.group(0)}<title>{html.escape(label(row))}</title>'
        parts = ", ".join(
            f"{part} {rows.number(row['error'][part])}" for part in rows.PARTS if row["error"][part] is not None
        )
        text = (
            f"{rows.setting(row)}\n{rows.number(rows.total_time(row), 4)} ms, error {rows.number(rows.total_error(row))}"
            f"\n{parts}" + ("" if row["on_frontier"] else "\nnot on the frontier")
            + ("\ntimed while the machine was busy" if rows.busy(row) else "")
        )
        return f'{match.group(0)}<title>{html.escape(text)}</title>'

    return re.sub(r'<g id="point(\d+)">', title, svg)
