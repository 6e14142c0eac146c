#!/usr/bin/env python3
"""Whether two reports agree: errors to the last digit, the frontier up to the noise of times."""

import copy
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python/report"))
import compare


def row(variant, error, ms, on_frontier, kernel="gaussian_blur"):
    return {
        "kernel": kernel,
        "variant": variant,
        "device": "cpu:float",
        "scene": "landscape",
        "size": "512x512",
        "options": {"format": "f32x4"},
        "knobs": {"sigma": 4},
        "error": {"metric": "max", "rounding": 0, "storage": None, "device": 0, "method": error},
        "time_ms": {"build": None, "update": None, "shade": {"median": ms, "q1": 0.9 * ms, "q3": 1.1 * ms, "n": 9}},
        "on_frontier": on_frontier,
    }


class Compare(unittest.TestCase):
    first = {"frontier": [row("a", 1e-3, 1, True), row("b", 1e-3, 2, False), row("c", 1e-4, 4, True)]}

    def agree(self, change):
        second = copy.deepcopy(self.first)
        change(second["frontier"])
        results = [compare.compare(a, b)[1] for a, b in ((self.first, second), (second, self.first))]
        self.assertEqual(results[0], results[1])
        return results[0]

    def test_a_report_agrees_with_itself(self):
        self.assertTrue(self.agree(lambda rows: None))

    def test_the_last_digit_counts(self):
        def change(rows):
            rows[2]["error"]["method"] = 1.0000000000000002e-4

        self.assertFalse(self.agree(change))

    def test_but_not_where_the_definition_leaves_it_to_timing(self):
        first = {"frontier": [row("last_write", 1e-3, 1, True, "voxelize")]}
        second = {"frontier": [row("last_write", 2e-3, 1, True, "voxelize")]}
        self.assertTrue(compare.compare(first, second)[1])
        self.assertFalse(compare.compare(*({"frontier": [{**r["frontier"][0], "kernel": "mip_build"}]} for r in (first, second)))[1])

    def test_quartiles_that_overlap_may_change_the_frontier(self):
        def change(rows):
            rows[1] = row("b", 1e-3, 1.1, True)

        self.assertTrue(self.agree(change))

    def test_an_order_that_is_clear_both_ways_may_not(self):
        def change(rows):
            rows[0], rows[1] = row("a", 1e-3, 2, False), row("b", 1e-3, 1, True)

        self.assertFalse(self.agree(change))

    def test_but_where_a_busy_machine_was_timed(self):
        def change(rows):
            rows[0], rows[1] = row("a", 1e-3, 2, False), row("b", 1e-3, 1, True)
            rows[0]["time_ms"]["shade"]["busy"] = True

        self.assertTrue(self.agree(change))

    def test_reports_without_a_common_setting_do_not_agree(self):
        self.assertFalse(compare.compare({"frontier": []}, self.first)[1])


if __name__ == "__main__":
    unittest.main()
