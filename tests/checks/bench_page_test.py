"""scripts/bench --markdown: every table of the page is written from one run, or has no figures."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))
import performance_page  # noqa: E402

PAGE = (ROOT / "docs/research/performance.md").read_text()
FIGURES = {"accuracy_median": 0.0541, "accuracy_p95": 0.3, "completeness_median": 0.05,
           "completeness_p95": 0.31, "f": {"0.5": 0.9, "1": 0.95, "2": 0.99}}
PROCESS = {"wall": 4.56, "cpu": 7.0, "peak_mb": 110.0, "closed": True, "seen": FIGURES}
ROWS = {
    "doll": [{"program": "turnscan", **PROCESS}, {"program": "PCL", "failed": "it ended with 1"}],
    "table61": [{"program": "turnscan poisson", **PROCESS}],
    "steps": [{"case": "doll-20cm, 36 frames", **PROCESS, "stages": {"frames": 1.5, "write": 0.001},
               "instructions": {"all": 4e9, "  fit": 1e9}}],
    "volume": [{"program": "160 frames", "times_wall": 4.11, "times_cpu": 5.0}],
    "kernels": [{"program": "png decode", "items_per_s": 6.5e8, "bytes_per_s": 1.2e9}],
    "outliers": [{"frame": "room", "program": way, "ns_per_point": ns}
                 for way, ns in (("pcl", 1800.0), ("one thread", 1200.0), ("all cores", 600.0))],
    "samples": [{"scene": "line", "triangles": 100000, "program": "drawn", "ms": 5.4}],
    "python": [{"program": "command", **PROCESS}],
}
EXPECTED = {
    "doll": ("| seconds | 4.6 | failed |", "0.054 (0.30)"), "table61": ("| turnscan poisson |",),
    "steps": ("frames 1.50.", "| &ensp;fit | 1.00 | 25.0 |"), "volume": ("| 160 frames | 4.1 | 5.0 |",),
    "kernels": ("| png decode | 650 | 1.2 |",), "outliers": ("| room | 1800 | 1200 | 600 | 1.5 times |",),
    "samples": ("| line | 100 k | 5.4 |",), "python": ("| peak memory, MB | 110 |",),
}


def filled(rows):
    return performance_page.fill(PAGE, {
        "machine": {"processor": "P", "cores": 2, "load": 0.1}, "revision": "abc", "command": "bench all",
        "rows": [{"suite": suite, **row} for suite, own in rows.items() for row in own]})


def blocks(page):
    return {m[2]: m[0] for m in performance_page.BLOCK.finditer(page)}


class BenchPage(unittest.TestCase):
    def test_has_a_place_for_every_table_that_a_run_makes(self):
        self.assertEqual(set(blocks(PAGE)), {"run", *performance_page.WRITERS})

    def test_writes_the_figures_of_the_run_and_its_revision(self):
        found = blocks(filled(ROWS))
        self.assertIn("Revision abc; P, 2 cores", found["run"])
        for name, texts in EXPECTED.items():
            for text in texts:
                self.assertIn(text, found[name])

    def test_leaves_no_figure_of_an_earlier_run(self):
        for name, text in blocks(filled({})).items():
            if name != "run":
                self.assertIn("Not measured in this run.", text)
                self.assertNotIn("|", text)

    def test_can_be_filled_again(self):
        self.assertEqual(filled(ROWS), performance_page.fill(filled(ROWS), {
            "machine": {"processor": "P", "cores": 2, "load": 0.1}, "revision": "abc", "command": "bench all",
            "rows": [{"suite": suite, **row} for suite, own in ROWS.items() for row in own]}))


if __name__ == "__main__":
    unittest.main()
