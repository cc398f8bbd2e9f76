"""turnscan evaluate --elements: elements fitted to a mesh, their distances and angles, as table, JSON and CSV."""

import csv
import json

import harness
from harness import FAILED, USAGE


def ball(name, side):
    return {"name": name, "type": "sphere", "point_mm": [75.3 * side, 20, 0], "diameter_mm": 40.4, "within_mm": 1,
            "min_mm": [-100 if side < 0 else 63, 0, -30], "max_mm": [-63 if side < 0 else 100, 50, 30]}


BAR = {"name": "bar", "type": "cylinder", "point_mm": [0, 20, 0], "direction": [1, 0, 0], "diameter_mm": 12,
       "within_mm": 0.5}


class Elements(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.ok("simulate", "builtin:ball-bar", "--frames", "1", "--out", "bar", "--quiet")
        self.mesh = "bar/truth/object.ply"

    def write(self, **content):
        (self.dir / "elements.json").write_text(json.dumps(content))

    def test_the_true_ball_bar_is_150_mm_long_to_a_micrometre(self):
        self.write(elements=[ball("left", -1), ball("=right", 1)],
                   relations=[{"name": "length", "type": "distance", "of": ["left", "=right"]}])
        result = self.ok("evaluate", self.mesh, "--elements", "elements.json", "--json", "figures.json",
                         "--elements-csv", "figures.csv")
        self.assertRegex(result.stdout, r"length +distance of left and =right +150\.000")
        figures = json.loads((self.dir / "figures.json").read_text())
        length = figures["relations"][0]["distance_m"]
        self.assertAlmostEqual(length["value"], 0.150, delta=1e-6)
        self.assertAlmostEqual(length["nominal"], 0.1506, delta=1e-9)
        self.assertAlmostEqual(length["deviation"], -0.0006, delta=1e-6)
        self.assertLess(length["sigma"], 1e-6)
        left = figures["elements"][0]
        self.assertEqual((left["name"], left["type"]), ("left", "sphere"))
        self.assertGreater(left["points"], 500)
        self.assertLess(left["form_m"], 1e-6)
        self.assertAlmostEqual(left["diameter_m"]["value"], 0.040, delta=1e-6)
        rows = list(csv.DictReader((self.dir / "figures.csv").read_text().splitlines()))
        self.assertEqual(len(rows), 2 * 4 + 1)
        self.assertEqual(rows[4]["element"], "'=right", "a formula in a spreadsheet")
        self.assertAlmostEqual(float(rows[-1]["value"]), 150, delta=1e-3)

    def test_with_a_reference_the_elements_are_those_of_the_aligned_mesh(self):
        self.write(elements=[ball("left", -1)])
        self.ok("evaluate", self.mesh, "--reference", self.mesh, "--align", "icp", "--samples", "2000", "--elements",
                "elements.json", "--json", "figures.json")
        figures = json.loads((self.dir / "figures.json").read_text())
        self.assertIn("accuracy", figures)
        self.assertEqual(figures["inspection"]["elements"][0]["name"], "left")

    def test_at_its_ends_a_ball_bar_is_as_thick_as_it_is_long(self):
        result = self.ok("evaluate", self.mesh, "--thickness-map", "walls.ply")
        self.assertRegex(result.stdout, r"Walls: [\d.]+mm thin at least, 3[78](\.\d+)?mm in the mean, 190mm at most")
        self.assertIn(b"property uchar red", (self.dir / "walls.ply").read_bytes()[:500])

    def test_a_report_has_the_elements(self):
        self.write(elements=[ball("<left>", -1)])
        self.ok("report", self.mesh, "--elements", "elements.json", "--out", "bar.html")
        page = (self.dir / "bar.html").read_text()
        self.assertIn("&lt;left&gt;</th><td>diameter</td>", page)

    def test_errors_name_the_element_and_write_nothing(self):
        before = self.files()
        for wrong, says in (({**ball("left", -1), "type": "ball"}, "element 'left': its type 'ball' is none of"),
                            ({**ball("left", -1), "diameter_mm": "40"}, "element 'left'"),
                            ({**ball("left", -1), "point_mm": [0, 500, 0]}, "element 'left': the 0 points"),
                            ({**BAR, "direction": [0, 0, 0]}, "element 'bar'")):
            self.write(elements=[wrong])
            self.refused(FAILED, "evaluate", self.mesh, "--elements", "elements.json", "--json", "figures.json",
                         says=says)
        self.write(elements=[BAR, BAR])
        self.refused(FAILED, "evaluate", self.mesh, "--elements", "elements.json", says="'bar' is there twice")
        self.write(elements=[BAR], relations=[{"name": "d", "type": "distance", "of": ["bar", "hole"]}])
        self.refused(FAILED, "evaluate", self.mesh, "--elements", "elements.json", says="no element 'hole'")
        self.refused(USAGE, "evaluate", self.mesh, "--elements-csv", "figures.csv", says="--elements")
        self.assertEqual(self.files(), sorted(before + ["elements.json"]))


if __name__ == "__main__":
    harness.main()
