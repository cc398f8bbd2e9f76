"""Files of other programs straight: reconstructed, looked at and played without an import first."""

import json
import shutil

import harness
import recordings
from harness import FAILED, FAST, USAGE, foreign_scan
from recordings import shared_recording


def as_json_png(folder):
    """The shared recording as depth images with a JSON file beside them."""
    recording = shared_recording()
    facts = json.loads((recording / "recording.json").read_text())
    sensor, table = facts["sensors"][0], facts["turntable"]
    camera = {**sensor["intrinsics"], "depth_unit_m": sensor["depth_unit_m"]}
    lines = (recording / "frames.csv").read_text().splitlines()
    names = lines[0].split(",")
    rows = [dict(zip(names, line.split(","))) for line in lines[1:]]
    folder.mkdir()
    for i, row in enumerate(rows):
        shutil.copy(recording / row["file"], folder / f"depth_{i}.png")
    (folder / "views.json").write_text(json.dumps({
        "intrinsics": camera, "angle_deg": [float(row["angle_deg"]) for row in rows],
        "axis_dir": table["axis"], "axis_point": table["center_m"], "platter_height_m": 0,
        "radius_m": table["radius_m"]}))
    return folder / "views.json"


class Straight(harness.TestCase):
    def test_a_reconstruction_is_that_of_the_imported_recording(self):
        views = as_json_png(self.dir / "views")
        self.ok("reconstruct", views, "-o", "straight.ply", *FAST)
        self.ok("reconstruct", views, "-o", "kept.ply", "--keep-recording", "kept", *FAST)
        self.ok("import", views, "--out", "imported")
        self.ok("reconstruct", "imported", "-o", "imported.ply", *FAST)
        straight = (self.dir / "straight.ply").read_bytes()
        self.assertEqual(straight, (self.dir / "kept.ply").read_bytes())
        self.assertEqual(straight, (self.dir / "imported.ply").read_bytes())
        frames = (self.dir / "imported/frames.csv").read_text()
        self.assertEqual(frames, (self.dir / "kept/frames.csv").read_text())
        # What is kept is in the way of nothing, and nothing is in its way.
        self.refused(FAILED, "reconstruct", views, "-o", "m.ply", "--keep-recording", "kept",
                     says="kept")
        self.refused(USAGE, "reconstruct", "kept", "-o", "m.ply", "--keep-recording", "again",
                     says="--keep-recording")
        self.refused(USAGE, "reconstruct", "kept", "-o", "m.ply", "--import", "depth-unit=1mm",
                     says="--import")

    def test_what_is_missing_is_asked_for_and_taken(self):
        scans = foreign_scan(self.dir / "scans")
        for command in (("info",), ("reconstruct", "-o", "m.ply")):
            self.refused(FAILED, command[0], scans, *command[1:], says="--import depth-unit=1mm")
        self.refused(USAGE, "info", scans, "--import", "depth-unitt=1mm", says="depth-unitt")
        said = self.ok("info", scans, "--import", "depth-unit=1mm").stdout
        for words in ("frames:      3, 0 dropped", "32 x 24 pixels", "size: ", "1mm a step"):
            self.assertIn(words, said.replace("1 mm", "1mm"))
        figures = json.loads(self.ok("info", scans, "--import", "depth-unit=1mm", "--json").stdout)
        self.assertEqual(figures["bytes"], sum(p.stat().st_size for p in scans.iterdir()))

    def test_a_source_plays_it(self):
        scans = foreign_scan(self.dir / "scans")
        device = "replay:scans?speed=max"
        self.refused(FAILED, "capture", "--device", device, "-o", "r", "--frames", "3",
                     says="depth-unit")
        self.ok("capture", "--device", device + "&depth-unit=1mm", "-o", "r", "--frames", "3")
        self.assertEqual(json.loads(self.ok("info", "r", "--json").stdout)["frames"], 3)
        self.refused(USAGE, "capture", "--device", "replay:r?depth-unit=1mm", "-o", "q",
                     "--frames", "3", says="depth-unit")

    def test_a_scan_says_what_cannot_be_as_reconstruct_does(self):
        far = recordings.copy(shared_recording(), self.dir / "far")
        facts = json.loads((far / "recording.json").read_text())
        facts["sensors"][0]["depth_unit_m"] *= 100
        (far / "recording.json").write_text(json.dumps(facts))
        cause = self.refused(FAILED, "reconstruct", "far", "-o", "m.ply", *FAST).stderr.split("; ")[0]
        self.assertIn("the unit is another one", cause)
        self.refused(FAILED, "scan", "--device", "replay:far?speed=max", "--no-wait", "-o", "m.ply",
                     "--recording", "again", *FAST, says=cause.split(": ", 1)[1].split(" (")[0])


if __name__ == "__main__":
    harness.main()
