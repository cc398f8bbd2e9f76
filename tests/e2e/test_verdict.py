"""The verdict on a scan: what is said of bad scans, and in the same words wherever it is said."""

import html
import json
import re

import harness
from harness import NARROW

HEIGHT = ("--height", "150mm")
SCANNER = (*NARROW, "--frames", "40", "--fps", "4", "--noise", "gaussian:0.5mm")


class Verdict(harness.TestCase):
    def scan(self, name, *args, object=("builtin:letter-a", *HEIGHT), reconstruct=()):
        """Simulates and reconstructs; what is printed, and the first object's verdict as JSON."""
        self.ok("simulate", *object, *SCANNER, *args, "--out", name)
        told = self.ok("reconstruct", name, "-o", f"{name}.ply", "--report", f"{name}.json",
                       "--report", f"{name}.html", *reconstruct).stdout
        report = json.loads((self.dir / f"{name}.json").read_text())
        self.assert_same_words(name, told, report["objects"])
        return told, report["objects"][0]["verdict"]

    def assert_same_words(self, name, told, objects):
        """On the command line, in the JSON and on the page (the studio's test compares its card)."""
        page = html.unescape((self.dir / f"{name}.html").read_text())
        for one in objects:
            verdict = one["verdict"]
            self.assertIn(f"Verdict: {verdict['colour'].upper()}\n", told)
            self.assertIn(f'<span class="badge {verdict["colour"]}">', page)
            for s in verdict["sentences"]:
                level = "note" if s["topic"] in ("help", "thin") else s["level"]
                self.assertRegex(told, rf"  {s['topic']} +{level} +{re.escape(s['text'])}\n")
                self.assertIn(f">{s['text']}</td>", page)

    def text(self, verdict, topic):
        return " | ".join(s["text"] for s in verdict["sentences"] if s["topic"] == topic)

    def level(self, verdict, topic):
        return {s["level"] for s in verdict["sentences"] if s["topic"] == topic}

    def test_a_whole_turn_can_be_printed_and_says_how_its_frames_agree(self):
        told, verdict = self.scan("whole", "--turns", "1.1")
        self.assertNotEqual(verdict["colour"], "red")
        self.assertIn("can be printed", self.text(verdict, "mesh"))
        agreement = self.text(verdict, "agreement")
        for what in ("Half of the frames", "Neighbouring frames differ", "Frames a turn apart"):
            self.assertIn(what, agreement)
        self.assertIn("When the calibration was made is not known.", self.text(verdict, "calibration"))
        self.assertIn("The platter in it lies", self.text(verdict, "calibration"))
        self.assertRegex(self.text(verdict, "invented"),
                         r"cm2 \(\d+ %\) of the surface was not measured.*is the base, which "
                         r"stood on the platter.*The largest holes: [\d.]+ cm2 (underneath|on )")
        self.assertRegex(self.text(verdict, "help"), r"A second pass would show \d+ cm2 more: ")
        page = (self.dir / "whole.html").read_text()
        self.assertIn("How well the frames agree", page)
        columns = json.loads((self.dir / "whole.json").read_text())["objects"][0]["frame_residuals"]
        self.assertEqual(columns["frame"], list(range(40)))
        self.assertEqual(len(columns["off_mm"]), 40)
        self.assertLess(max(columns["off_mm"]), 0.6)

    def test_a_letter_of_70_degrees_is_red_and_a_scan_that_broke_off_not_green(self):
        for name, turns, colour in (("seventy", 70 / 360, "red"), ("broken", 0.4, "amber")):
            told, verdict = self.scan(name, "--turns", str(turns))
            self.assertEqual(verdict["colour"], colour, told)
            self.assertNotIn("can be printed", told)
            looks = re.match(r"The frames look from (\d+) of 360 degrees",
                             self.text(verdict, "turn"))
            # 39 steps, and 20 degrees beside the first and the last frame.
            self.assertAlmostEqual(float(looks[1]), 360 * turns * 39 / 40 + 40, delta=1)
            self.assertIn("A whole turn would show", self.text(verdict, "help"))

    def test_a_stale_calibration_is_red_where_it_is_kept_and_has_an_age(self):
        self.ok("simulate", "builtin:letter-a", *HEIGHT, *SCANNER, "--table-x", "6mm", "--table-tilt", "1deg",
                "--calibration", "nominal", "--out", "stale")
        description = self.dir / "stale" / "recording.json"
        recording = json.loads(description.read_text())
        self.assertNotIn("capture", recording, "a virtual recording has no date")
        recording["capture"] = {"started_at": "2026-11-01T08:00:00Z",
                                "turntable_calibrated_at": "2026-08-01T08:00:00Z"}
        description.write_text(json.dumps(recording))
        told = self.ok("reconstruct", "stale", "-o", "m.ply", "--report", "m.json",
                       "--calibration", "recorded").stdout
        verdict = json.loads((self.dir / "m.json").read_text())["objects"][0]["verdict"]
        self.assertNotEqual(verdict["colour"], "green", told)
        said = self.text(verdict, "calibration")
        self.assertIn("made 3 months before this recording (2026-08-01)", said)
        self.assertRegex(said, r"The platter in it lies [\d.]+ mm \w+, [456]\.\d mm aside")
        told = self.ok("reconstruct", "stale", "-o", "m.ply").stdout
        self.assertIn("The turntable was found from the motion in this recording", told)

    def test_an_object_that_moved_is_said_when_and_how_far(self):
        moved = ("--turns", "1.1", "--object-move-at", "5s", "--object-move", "6mm")
        told, verdict = self.scan("kept", *moved, reconstruct=("--calibration", "recorded"))
        self.assertEqual(verdict["colour"], "red", told)
        self.assertRegex(self.text(verdict, "disturbance"),
                         r"The object moved by [\d.]+ mm at [\d.]+ s.*Nothing was done about it")
        self.assertEqual(self.level(verdict, "agreement"), {"fair"})
        told, verdict = self.scan("right", *moved)
        self.assertIn("Its frames were put right or left out", self.text(verdict, "disturbance"))
        self.assertEqual(self.level(verdict, "agreement"), {"good"}, told)

    def test_thin_walls_are_told(self):
        told, verdict = self.scan("thin", object=("builtin:scorpion",))
        self.assertRegex(self.text(verdict, "thin"), r"Walls thinner than [\d.]+ mm, .*, make up [\d.]+ % of the surface")


if __name__ == "__main__":
    harness.main()
