"""The page to send, opened in a browser: the model is drawn, switches and keys work, nothing is
asked of a network, nothing complains, and no text becomes markup.

TURNSCAN_SCREENSHOTS=FOLDER keeps what the browser shows at 1440 and 390 pixels width, and on paper.
"""

import json
import os
import pathlib
import shutil
import sys
import unittest

import browser
import harness
from harness import SENSOR
import recordings
from recordings import shared_recording

SHOTS = os.environ.get("TURNSCAN_SCREENSHOTS")
SKIPPED = 77


def missing():
    """What the tests in a browser need and is not here; empty when all is."""
    if not browser.find():
        return "there is no chromium (scripts/setup test)"
    folders = pathlib.Path(shutil.which(harness.BIN) or harness.BIN).resolve().parents
    if not any((f / "share/turnscan/page/viewer.js").exists() for f in list(folders)[:4]):
        return "turnscan was built without the 3D view (scripts/setup page)"
    return ""


MISSING = missing()

# How many pixels of the canvas differ from its first, and the mean of red, green and blue.
PIXELS = """(() => {
  const canvas = document.getElementById('model');
  const copy = document.createElement('canvas');
  copy.width = canvas.width; copy.height = canvas.height;
  const context = copy.getContext('2d');
  context.drawImage(canvas, 0, 0);
  const data = context.getImageData(0, 0, copy.width, copy.height).data;
  let other = 0, sum = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    const far = Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) +
      Math.abs(data[i + 2] - data[2]);
    if (far < 24) continue;
    ++other;
    for (let c = 0; c < 3; ++c) sum[c] += data[i + c];
  }
  return {share: other / (data.length / 4), mean: sum.map((s) => s / Math.max(other, 1))};
})()"""


def mode(name):
    return f"document.querySelector('input[name=mode][value={name}]')"


class Page(harness.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, name, width=1440, height=900):
        page = self.browser.open(self.dir / name, width, height)
        page.wait("document.getElementById('model').dataset.state === 'drawn'")
        return page

    def keep(self, page, name):
        if SHOTS:
            page.screenshot(pathlib.Path(SHOTS) / f"{name}.png")

    def assert_quiet(self, page):
        self.assertEqual(page.requests(), [])
        self.assertEqual(page.complaints(), [])

    def show(self, page, name):
        page.evaluate(f"{mode(name)}.click()")
        page.wait(f"document.getElementById('model').dataset.shown === '{name}'")
        return page.evaluate(PIXELS)

    def test_the_page_of_a_scan_works_at_both_widths(self):
        self.ok("reconstruct", recordings.folder_of("letter-a"), "--out", "a.ply", "--report", "scan.html",
                "--report", "a.json")
        page = self.open("scan.html")
        drawn = page.evaluate(PIXELS)
        self.assertGreater(drawn["share"], 0.05, "the canvas is empty")
        self.assertLess(drawn["share"], 0.9)
        self.assertEqual(page.evaluate("document.title"), "a - turnscan report")
        for word in ("Dimensions", "Parameters", "Speed over the turn"):
            self.assertIn(word, page.evaluate("document.body.innerText"))
        self.assertEqual(page.evaluate("document.images.length"), 6)
        self.assertTrue(page.evaluate(
            "[...document.images].every((i) => i.complete && i.naturalWidth > 100 && i.alt)"))
        self.assert_quiet(page)
        self.keep(page, "scan-1440")
        narrow = self.open("scan.html", 390, 844)
        self.assertGreater(narrow.evaluate(PIXELS)["share"], 0.03)
        self.assertLessEqual(narrow.evaluate("document.documentElement.scrollWidth"), 390)
        self.assert_quiet(narrow)
        self.keep(narrow, "scan-390")

    def test_switches_show_what_is_known_of_each_vertex(self):
        (self.dir / "cube.ply").write_text(harness.ply_cube(0.1))
        (self.dir / "larger.ply").write_text(harness.ply_cube(0.102))
        report = {"objects": [{
            "verdict": {"colour": "amber", "sentences": [
                {"topic": "Turn", "level": "fair", "text": "Seen from 300 of 360 degrees",
                 "value": 300, "unit": "deg"}]},
            "expected_error_m": [1e-4] * 4 + [5e-4] * 4, "seen_by": [10] * 4 + [80] * 4,
            "invented": [False] * 6 + [True] * 2}]}
        (self.dir / "cube.json").write_text(json.dumps(report))
        self.ok("report", "cube.ply", "--made-by", "cube.json", "--reference", "larger.ply",
                "--out", "cube.html")
        page = self.open("cube.html")
        colors = {name: self.show(page, name)["mean"]
                  for name in ("colour", "expected_error", "deviation", "seen_by", "invented")}
        for a in colors:
            for b in colors:
                if a < b:
                    far = sum(abs(x - y) for x, y in zip(colors[a], colors[b]))
                    self.assertGreater(far, 10, f"{a} and {b} look alike: {colors}")
        self.assertGreater(colors["deviation"][2], colors["deviation"][0] + 15,
                           "inside the reference is blue")
        self.assertIn("invented", page.evaluate("document.getElementById('legend').innerText"))
        self.assertIn("Seen from 300", page.evaluate("document.body.innerText"))
        self.keep(page, "cube-1440")
        self.keep(self.open("cube.html", 390, 844), "cube-390")
        self.assert_quiet(page)

    def test_keys_turn_and_zoom_the_model(self):
        (self.dir / "cube.ply").write_text(harness.ply_cube(0.1))
        self.ok("report", "cube.ply", "--out", "cube.html")
        page = self.open("cube.html")
        start = page.evaluate(PIXELS)
        page.evaluate("document.getElementById('model').focus()")
        for _ in range(3):
            page.press("+")
        nearer = page.evaluate(f"new Promise((done) => requestAnimationFrame(() => "
                               f"requestAnimationFrame(() => done({PIXELS}))))")
        self.assertGreater(nearer["share"], 1.5 * start["share"])
        page.press("Home")
        page.press("ArrowUp")
        self.assertEqual(page.evaluate("document.activeElement.id"), "model")
        # Everything that can be operated is reached by the tab key and has a name.
        self.assertTrue(page.evaluate(
            "[...document.querySelectorAll('button, input, canvas, summary')].every((e) => "
            "(e.getAttribute('aria-label') || e.closest('label')?.textContent || e.textContent)"
            ".trim() && e.tabIndex >= 0)"))
        self.assert_quiet(page)

    def test_hostile_names_stay_text(self):
        attack = "</script><script>window.hit=1</script><img src=x onerror=window.hit=1>"
        folder = self.dir / "sub"
        folder.mkdir()
        # Names of files may hold anything but a slash.
        name = attack.replace("/", "") + ".obj"
        cube = "o " + attack + "\n" + "".join(
            f"v {x} {y} {z}\n" for x in (0, .1) for y in (0, .1) for z in (0, .1))
        faces = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
        (folder / name).write_text(cube + "".join(
            f"f {' '.join(map(str, f))}\n" for f in faces))
        report = {"version": attack, "notes": [attack], "objects": [{"notes": [attack]}],
                  "parameters": [{"option": attack, "value": attack, "reason": attack}],
                  "options": {attack: attack}, "seconds": {attack: 1}}
        (self.dir / "r.json").write_text(json.dumps(report))
        self.ok("report", f"sub/{name}", "--made-by", "r.json", "--title", attack, "--out", "x.html")
        page = self.open("x.html")
        self.assertIsNone(page.evaluate("window.hit"))
        self.assertEqual(page.evaluate("document.querySelector('h1').textContent"), attack)
        self.assertEqual(page.evaluate("document.querySelectorAll('img').length"), 6)
        # What came in after all would not be run.
        page.evaluate("document.body.append(Object.assign(document.createElement('script'), "
                      "{textContent: 'window.hit = 1'}))")
        self.assertIsNone(page.evaluate("window.hit"))
        self.assertIn("Content Security Policy", " ".join(page.complaints()))

    def test_a_large_mesh_stays_below_5_MB(self):
        truth = recordings.folder_of("doll") / "truth" / "object.ply"
        result = self.ok("report", str(truth), "--reference", str(truth), "--out", "doll.html")
        info = json.loads(self.ok("info", "--json", str(truth)).stdout)
        triangles = sum(mesh["triangles"] for mesh in info["objects"])
        self.assertGreater(triangles, 200000)
        size = (self.dir / "doll.html").stat().st_size
        self.assertLess(size * 200000 / triangles, 5e6, result.stdout)
        page = self.open("doll.html")
        self.assertGreater(page.evaluate(PIXELS)["share"], 0.03)
        self.assert_quiet(page)
        self.keep(page, "doll-1440")

    def test_it_prints(self):
        (self.dir / "cube.ply").write_text(harness.ply_cube(0.1))
        self.ok("report", "cube.ply", "--out", "cube.html")
        pdf = self.open("cube.html").pdf()
        self.assertTrue(pdf.startswith(b"%PDF"))
        if SHOTS:
            (pathlib.Path(SHOTS) / "cube.pdf").write_bytes(pdf)


class WithoutBrowser(harness.TestCase):
    def test_what_cannot_be_made_is_refused(self):
        (self.dir / "cube.ply").write_text(harness.ply_cube(0.1))
        (self.dir / "bad.json").write_text("[")
        self.refused(harness.USAGE, "report", "cube.ply", "--out", "page.txt", says=".html")
        self.refused(harness.FAILED, "report", "none.ply", "--out", "page.html", says="none.ply")
        self.refused(harness.FAILED, "report", "cube.ply", "--made-by", "bad.json", "--out",
                     "page.html", says="JSON")
        self.refused(harness.USAGE, "report", "cube.ply", "--out", "cube.ply", says="")
        self.refused(harness.USAGE, "reconstruct", "rec", "--out", "m.ply", "--report", "a.html",
                     "--report", "b.html", says="both pages")
        self.assertEqual(self.files(), ["bad.json", "cube.ply"])

    def test_a_program_without_the_viewer_makes_a_page_of_pictures_and_says_so(self):
        data = self.dir / "data"
        data.mkdir()
        (data / "scanners").symlink_to(harness.ROOT / "data" / "scanners")
        (self.dir / "cube.ply").write_text(harness.ply_cube(0.1))
        result = self.ok("report", "cube.ply", "--out", "cube.html",
                         env={"TURNSCAN_DATA": str(data)})
        self.assertIn("no 3D view", result.stdout)
        page = (self.dir / "cube.html").read_text()
        self.assertIn("The model in 3D is not in this page", page)
        self.assertNotIn("<script", page)
        self.assertNotIn("<canvas", page)
        self.assertEqual(page.count("<img "), 6)

    def test_the_page_of_a_recording_is_that_of_its_mesh(self):
        self.ok("report", shared_recording(), "--out", "page.html")
        page = (self.dir / "page.html").read_text()
        self.assertIn("<h1>cylinder</h1>", page)
        self.assertIn("Speed over the turn", page)
        self.assertIn("voxel-size", page)
        self.assertEqual(self.files(), ["page.html"])

    def test_a_scan_writes_a_page_and_json(self):
        self.ok("scan", "--device", f"virtual:letter-a?sensor={SENSOR}&fps=10&speed=60deg/s", "--speed", "60deg/s",
                "--out", "c.ply", "--report", "c.html", "--report", "c.json", "--no-wait")
        self.assertIn("<h1>c</h1>", (self.dir / "c.html").read_text())
        self.assertTrue(json.loads((self.dir / "c.json").read_text())["reconstruction"])


if __name__ == "__main__":
    if MISSING:
        print(f"SKIPPED: {MISSING}: the page was not opened in a browser", flush=True)
        done = unittest.TextTestRunner(verbosity=2).run(
            unittest.defaultTestLoader.loadTestsFromTestCase(WithoutBrowser))
        sys.exit(SKIPPED if done.wasSuccessful() else 1)
    harness.main()
