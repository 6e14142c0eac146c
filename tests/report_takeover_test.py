#!/usr/bin/env python3
"""The report's page: which settings its frontier lines pass through, and the table of the cheapest variants."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python/report"))
import rows
import takeover


def row(variant, error, median, spread=0.0, sigma=4, device="cpu:float", **options):
    return {
        "kernel": "gaussian_blur",
        "variant": variant,
        "device": device,
        "scene": "landscape",
        "size": "512x512",
        "options": {"format": "f32x4", "border": "clamp", **options},
        "knobs": {"sigma": sigma},
        "error": {"metric": takeover.METRIC, "rounding": 0, "storage": None, "device": 0, "method": error},
        "time_ms": {
            "build": None,
            "update": None,
            "shade": {"median": median, "q1": median * (1 - spread), "q3": median * (1 + spread), "n": 9},
        },
    }


class FrontierLine(unittest.TestCase):
    def variants(self, points):
        return [point["variant"] for point in rows.frontier_line(points)]

    def test_settings_that_differ_beyond_their_quartiles_all_stay(self):
        points = [row("c", 1e-4, 4), row("a", 1e-2, 1), row("b", 1e-3, 2)]
        self.assertEqual(self.variants(points), ["a", "b", "c"])

    def test_a_setting_that_a_more_exact_one_is_as_fast_as_is_left_out_whichever_median_is_less(self):
        for a, b in ((1.0, 1.02), (1.02, 1.0)):
            points = [row("coarse", 1e-2, a, 0.05), row("exact", 1e-3, b, 0.05), row("slow", 1e-4, 3, 0.05)]
            self.assertEqual(self.variants(points), ["exact", "slow"])

    def test_it_never_turns_back(self):
        points = [row(str(i), 10 ** -(i % 5), 1 + (i * 7 % 11) / 10, 0.03) for i in range(25)]
        line = rows.frontier_line(points)
        self.assertGreater(len(line), 0)
        for first, second in zip(line, line[1:]):
            self.assertLess(rows.total_time(first), rows.total_time(second))
            self.assertGreater(rows.total_error(first), rows.total_error(second))

    def test_of_two_alike_one_stays(self):
        self.assertEqual(len(rows.frontier_line([row("a", 1e-3, 1), row("b", 1e-3, 1)])), 1)


class Takeover(unittest.TestCase):
    report = {
        "frontier": [
            row("separable", 5e-5, 8),
            row("box", 5e-3, 2, 0.05),
            row("pyramid", 5e-4, 2.05, 0.05),
            row("recursive", 5e-4, 4),
            row("direct", 1e-6, 0.1, format="f16x4"),
            row("direct", 1e-6, 0.1, border="wrap"),
            row("direct", 1e-6, 0.1, drop_taps=True),
            row("separable", 5e-5, 1, sigma=0.5),
        ]
    }

    def test_each_bound_names_the_cheapest_and_what_quartiles_do_not_tell_from_it(self):
        head, lines = takeover.table(self.report)
        self.assertEqual(head, ["device", "σ", "error ≤ 0.01", "error ≤ 0.001", "error ≤ 0.0001"])
        self.assertEqual(lines[0], ["cpu:float", "0.5", "separable 1", "separable 1", "separable 1"])
        self.assertEqual(lines[1], ["cpu:float", "4", "box ≈ pyramid 2", "pyramid 2.05", "separable 8"])

    def test_what_is_not_reached_is_a_dash(self):
        _, lines = takeover.table({"frontier": [row("box", 5e-3, 2)]})
        self.assertEqual(lines, [["cpu:float", "4", "box 2", "–", "–"]])

    def test_a_readme_is_filled_between_its_marks(self):
        with tempfile.TemporaryDirectory() as folder:
            import json

            report, readme = pathlib.Path(folder, "report.json"), pathlib.Path(folder, "README.md")
            report.write_text(json.dumps(self.report))
            readme.write_text(f"before\n{takeover.START}\nstale\n{takeover.END}\nafter\n")
            sys.argv = ["takeover.py", str(report), str(readme)]
            self.assertEqual(takeover.main(), 0)
            text = readme.read_text()
            self.assertIn("| cpu:float | 4 | box ≈ pyramid 2 |", text)
            self.assertNotIn("stale", text)
            self.assertTrue(text.startswith("before\n") and text.endswith("\nafter\n"))


if __name__ == "__main__":
    unittest.main()
