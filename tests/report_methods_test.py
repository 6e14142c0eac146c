#!/usr/bin/env python3
"""The report's page: the panel that holds all methods of global illumination."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python/report"))
import rows

try:
    import page
    import plots
except ImportError:  # the page is made where matplotlib is
    plots = None

METRIC = "irradiance after one bounce: mean((x - t1)(x - t2)) / (mean t)^2"


def phase(ms):
    return None if ms is None else {"median": ms, "q1": ms, "q3": ms}


def row(kernel, scene, error, update, shade, metric=METRIC, build=1000, device="opencl:a", size="10 receivers"):
    return {
        "kernel": kernel,
        "variant": "plain",
        "scene": scene,
        "size": size,
        "device": device,
        "options": {"format": "f16x4"},
        "knobs": {"resolution": 16},
        "error": {"metric": metric, "rounding": None, "storage": None, "device": None, "method": error},
        "time_ms": {"build": phase(build), "update": phase(update), "shade": phase(shade)},
        "bytes": None,
        "flops": None,
        "memory_bytes": 1 << 20,
        "on_frontier": False,
    }


REPORT = {
    "frontier": [
        row("cone_trace", "box", 0.1, 20, 10),
        row("light_propagation", "box", 1.0, 1, 1),
        row("light_propagation", "box", 0.5, 3, 1),
        row("light_propagation", "box", 0.7, 30, 30),  # slower than a better one
        row("probe_shade", "box", 0.2, 4, 2, device="vulkan:b"),
        row("cone_trace", "hall", 0.1, 1, 1),  # alone in its scene
        row("cone_trace", "box", 0.1, 1, 1, metric="another metric"),
        row("cone_trace", "box", 0.1, 1, 1, size="20 receivers"),  # other receivers
        row("probe_shade", "box", 0.3, None, None),  # no time
    ]
}


class AllMethods(unittest.TestCase):
    def test_rows_compare_where_scene_receivers_and_metric_are_the_same(self):
        views = rows.by_scene(REPORT)
        self.assertEqual(list(views), [("box", "10 receivers", METRIC)])
        self.assertEqual(len(views["box", "10 receivers", METRIC]), 5)

    def test_time_is_update_and_shade_without_build(self):
        self.assertEqual(rows.frame_time(REPORT["frontier"][0]), 30)
        self.assertEqual(rows.frame_time(row("a", "b", 1, None, 7)), 7)

    def test_the_best_get_more_exact_as_they_get_slower(self):
        mine = [r for r in rows.by_scene(REPORT)["box", "10 receivers", METRIC] if r["device"] == "opencl:a"]
        best = [(rows.frame_time(r), rows.total_error(r)) for r in rows.best_of(mine)]
        self.assertEqual(best, [(2, 1.0), (4, 0.5), (30, 0.1)])

    @unittest.skipIf(plots is None, "matplotlib is missing: the report says so in place of a page")
    def test_one_panel_a_scene_holds_all_kernels(self):
        with tempfile.TemporaryDirectory() as folder:
            figures = plots.draw_methods(REPORT, pathlib.Path(folder))
            self.assertEqual([(scene, metric, count) for scene, metric, count, _ in figures], [("box, 10 receivers", METRIC, 5)])
            svg = figures[0][3]
            self.assertEqual(svg.count("<title>"), 5)
            self.assertIn("light_propagation plain f16x4 resolution 16\n4 ms update + shade, error 0.5", svg)
            for kernel in ("cone_trace", "light_propagation", "probe_shade"):
                self.assertIn(f">{kernel}<", svg)
            section = page.methods(REPORT, figures)
            self.assertIn('id="methods"', section)
            self.assertIn("box, vulkan:b: which one to take", section)
            self.assertEqual(page.methods({"frontier": []}, []), "")

    @unittest.skipIf(plots is None, "matplotlib is missing: the report says so in place of a page")
    def test_faults_that_pass_are_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "score.json"
            self.assertEqual(page.mutation(path), "")
            fault = {"kernel": "k", "fault": "max for min", "before": "min(", "after": "max("}
            path.write_text(json.dumps([{**fault, "caught_by": "K.Bounds"}, {**fault, "caught_by": None}]))
            self.assertIn("1 of 2 deliberate faults", page.mutation(path))
            self.assertEqual(page.mutation(path).count("<tr class=bad>"), 1)


if __name__ == "__main__":
    unittest.main()
