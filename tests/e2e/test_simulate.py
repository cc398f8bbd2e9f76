"""The simulator as a person uses it: recordings that the rest of turnscan takes like any other."""

import csv
import json
import re
import subprocess

import harness
import recordings
from harness import FAILED, NARROW, SENSOR, USAGE, ply_cube

QUICK = ("--frames", "40", "--quiet")


class Simulate(harness.TestCase):
    def simulate(self, *args):
        return self.ok("simulate", *args, *QUICK)

    def rows(self, table):
        return list(csv.DictReader((self.dir / table).read_text().splitlines()))

    def figures(self, mesh, recording):
        self.ok("evaluate", mesh, "--reference", f"{recording}/truth/object.ply",
                "--seen-from", recording, "--json", "figures.json")
        return json.loads((self.dir / "figures.json").read_text())

    def test_a_recording_becomes_the_object_that_it_was_made_from(self):
        self.simulate("builtin:letter-a", "--height", "220mm", "--scanner", "kinect-v2",
                      "--noise", "none", "--out", "rec")
        self.ok("reconstruct", "rec", "-o", "m.ply")
        self.assertLess(self.figures("m.ply", "rec")["accuracy"]["median_m"], 0.0003)

    def test_a_line_scanner_gives_points_that_reconstruct(self):
        self.ok("simulate", "builtin:cylinder", "--scanner", "gocator,distance=0.5m,elevation=0deg",
                "--frames", "300", "--noise", "none", "--out", "rec", "--quiet")
        info = json.loads(self.ok("info", "rec", "--json").stdout)
        self.assertEqual(info["sensors"][0]["kind"], "point-scanner")
        self.ok("reconstruct", "rec", "-o", "m.ply", "--calibration", "recorded")
        self.assertLess(self.figures("m.ply", "rec")["accuracy"]["median_m"], 0.0001)

    def test_several_scanners_make_one_object(self):
        self.simulate("builtin:letter-a", *NARROW,
                      "--scanner", f"{SENSOR},azimuth=140deg,elevation=40deg,distance=0.7m",
                      "--noise", "none", "--table-x", "10mm", "--table-tilt", "2deg",
                      "--out", "rec")
        self.ok("reconstruct", "rec", "-o", "m.ply")
        self.assertLess(self.figures("m.ply", "rec")["accuracy"]["median_m"], 0.0003)
        rows = self.rows("rec/frames.csv")
        self.assertEqual([r["sensor"] for r in rows[:4]], ["0", "1", "0", "1"])

    def test_frames_at_a_speed_are_what_they_are(self):
        self.ok("simulate", "builtin:cylinder", *NARROW, "--frames", "92", "--fps", "3", "--speed",
                "10.4478deg/s", "--out", "rec", "--quiet")
        rows = self.rows("rec/truth/poses.csv")
        self.assertEqual(len(rows), 92)
        self.assertAlmostEqual(float(rows[-1]["angle_deg"]), 10.4478 * 91 / 3, places=4)

    def test_the_truth_stands_in_for_a_calibration_that_was_left_out(self):
        self.simulate("builtin:cylinder", *NARROW, "--calibration", "none", "--no-angles", "--out", "rec")
        header = json.loads((self.dir / "rec/recording.json").read_text())
        self.assertNotIn("turntable", header)
        self.assertNotIn("T_table_sensor", header["sensors"][0])
        self.ok("reconstruct", "rec", "-o", "m.ply", "--turntable", "rec/truth/calibration.json")
        self.assertLess(self.figures_of_bare("m.ply"), 0.0006)

    def figures_of_bare(self, mesh):
        self.ok("evaluate", mesh, "--reference", "rec/truth/object.ply", "--json", "f.json")
        return json.loads((self.dir / "f.json").read_text())["accuracy"]["median_m"]

    def test_the_same_seed_gives_the_same_bytes_for_any_number_of_threads(self):
        for name, more in (("a", ("--threads", "1")), ("b", ("--threads", "2")),
                           ("c", ("--seed", "2"))):
            self.ok("simulate", "builtin:letter-a", "--frames", "6", "--noise", "model", *more,
                    "--out", name, "--quiet")
        def content(name):
            return {str(p.relative_to(self.dir / name)): p.read_bytes()
                    for p in (self.dir / name).rglob("*") if p.is_file()}
        self.assertEqual(content("a"), content("b"))
        self.assertNotEqual(content("a")["depth/000003.png"], content("c")["depth/000003.png"])

    def test_a_scene_file_says_the_same_as_flags_and_flags_go_before_it(self):
        (self.dir / "scene.toml").write_text(
            "[object]\nfile = 'builtin:cylinder'\nheight = '120mm'\n[motion]\nframes = 5\n"
            "[noise]\nnoise = 'none'\n[[scanner]]\nmodel = 'ideal'\nroll = '10deg'\n")
        self.ok("simulate", "--scene", "scene.toml", "--out", "a", "--quiet")
        self.ok("simulate", "builtin:cylinder", "--height", "120mm", "--frames", "5", "--noise",
                "none", "--scanner", "ideal,roll=10deg", "--out", "b", "--quiet")
        self.ok("simulate", "--scene", "scene.toml", "--frames", "3", "--out", "c", "--quiet")
        self.ok("simulate", "--scene", "a/truth/scene.toml", "--out", "d", "--quiet")
        image = {name: (self.dir / name / "depth/000002.png").read_bytes() for name in "abcd"}
        self.assertEqual(image["a"], image["b"])
        self.assertEqual(image["a"], image["d"])
        self.assertEqual(len(list((self.dir / "c/depth").iterdir())), 3)

    def test_a_copy_of_a_preset_is_a_scanner(self):
        preset = harness.ROOT / "data" / "scanners" / "kinect-v2.toml"
        text = preset.read_text().replace('far = "4.5m"', 'far = "0.9m"')
        (self.dir / "near.toml").write_text(text)
        self.ok("simulate", "builtin:cylinder", "--scanner", "near.toml", "--frames", "2",
                "--noise", "none", "--out", "rec", "--report", "r.json", "--quiet")
        samples = json.loads((self.dir / "r.json").read_text())["scanners"][0]["samples"]
        self.assertGreater(samples["too-far"], 1000)
        self.assertGreater(samples["measured"], 1000)
        self.assertEqual(sum(samples.values()), 2 * 512 * 424)

    def test_the_empty_table_can_be_recorded(self):
        out = self.simulate("builtin:empty", *NARROW, "--room", "clutter", "--out", "rec").stdout
        self.assertIn("measured", out)
        self.assertFalse((self.dir / "rec/truth/object.ply").exists())
        self.assertTrue((self.dir / "rec/truth/calibration.json").exists())

    def test_profiles_that_see_nothing_are_frames(self):
        self.ok("simulate", "builtin:letter-a", "--no-platter", "--scanner",
                "gocator,aim-x=80mm,distance=0.5m,elevation=0deg", "--frames", "60",
                "--out", "rec", "--quiet")
        info = json.loads(self.ok("info", "rec", "--json").stdout)
        self.assertEqual(info["frames"], 60)
        self.assertEqual(info["dropped_frames"], 0)

    def test_the_other_side_is_a_pass_of_its_own(self):
        self.simulate("builtin:letter-a", *NARROW, "--tip", "180deg", "--pass", "1", "--out", "rec")
        rows = self.rows("rec/frames.csv")
        self.assertEqual({r["pass"] for r in rows}, {"1"})
        pose = json.loads((self.dir / "rec/truth/truth.json").read_text())["object"]["T_table_object"]
        self.assertAlmostEqual(pose[1][1], -1.0, places=6)

    def test_passes_follow_each_other_in_one_recording(self):
        self.ok("simulate", "builtin:letter-a", *NARROW, "--frames", "4", "--next-pass",
                "tip=90deg", "--next-pass", "tip=180deg,yaw=40deg", "--samples", "--out", "rec", "--quiet")
        rows = self.rows("rec/frames.csv")
        self.assertEqual([r["pass"] for r in rows], [p for p in "012" for _ in range(4)])
        times = [float(r["time_s"]) for r in rows]
        self.assertEqual(times, sorted(times))
        truth = self.rows("rec/truth/poses.csv")
        self.assertEqual([r["pass"] for r in truth], [r["pass"] for r in rows])
        # The scanner stays, the object is laid another way.
        self.assertEqual([truth[0][k] for k in ("tx", "ty", "tz")],
                         [truth[8][k] for k in ("tx", "ty", "tz")])
        lying = json.loads((self.dir / "rec/truth/truth.json").read_text())["next_passes"]
        self.assertAlmostEqual(lying[1]["T_table_object"][1][1], -1.0, places=6)
        self.assertTrue((self.dir / "rec/truth/object-pass2.ply").exists())
        self.assertEqual(len(list((self.dir / "rec/truth/samples").iterdir())), 12)
        info = json.loads(self.ok("info", "rec", "--json").stdout)
        self.assertEqual(info["frames"], 12)
        self.ok("simulate", "--scene", "rec/truth/scene.toml", "--out", "again", "--quiet")
        for frame in ("depth/000000.png", "depth/000011.png"):
            self.assertEqual((self.dir / "again" / frame).read_bytes(),
                             (self.dir / "rec" / frame).read_bytes())

    def test_a_pass_of_several_is_reconstructed_by_itself(self):
        self.ok("simulate", "builtin:letter-a", "--height", "100mm", *NARROW, "--frames",
                "12", "--next-pass", "tip=90deg", "--out", "rec", "--quiet")
        self.ok("reconstruct", "rec", "--pass", "1", "--method", "volumetric", "-o", "lying.ply",
                "--quiet")
        self.ok("evaluate", "lying.ply", "--reference", "rec/truth/object-pass1.ply", "--json",
                "e.json")
        judged = json.loads((self.dir / "e.json").read_text())
        self.assertLess(judged["accuracy"]["median_m"], 1e-3)

    def test_dropped_frames_are_recorded_as_such(self):
        self.ok("simulate", "builtin:cylinder", *NARROW, "--frames", "60", "--dropped", "0.3", "--out",
                "rec", "--quiet")
        info = json.loads(self.ok("info", "rec", "--json").stdout)
        self.assertEqual(info["frames"], 60)
        self.assertTrue(5 < info["dropped_frames"] < 35)


class Refused(harness.TestCase):
    def refuse(self, code, *args, says):
        before = self.files()
        self.refused(code, "simulate", *args, "--frames", "2", "--out", "rec", says=says)
        self.assertEqual(self.files(), before)

    def test_wrong_options(self):
        for args, says in (((), "OBJECT"), (("builtin:cylinder", "--height", "250"), "height"),
                           (("builtin:cylinder", "--scanner", "ideal,height=3m"), "scanner"),
                           (("builtin:cylinder", "--noise", "loud"), "noise = loud"),
                           (("builtin:cylinder", "--noise", "physics", "--scanner", "ideal"),
                            "physics"),
                           (("builtin:cylinder", "--distance", "-1m"), "distance"),
                           (("builtin:cylinder", "--start-ramp", "10s"), "start-ramp"),
                           (("builtin:cylinder", "--next-pass", "tip=90"), "next-pass"),
                           (("builtin:cylinder", "--scene", "none.toml"), "none.toml")):
            self.refused(FAILED if "none.toml" in args else USAGE, "simulate", *args, "--frames",
                         "2", "--out", "rec", says=says)
        self.assertEqual(self.files(), [])

    def test_objects_that_are_none(self):
        (self.dir / "points.ply").write_text(
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n0 0 0\n")
        cube = ply_cube(0.1)
        (self.dir / "nan.ply").write_text(cube.replace("0.05 0.1 0.05", "nan 0.1 0.05"))
        for name in ("none.ply", "points.ply", "nan.ply"):
            self.refuse(FAILED, name, says=name)
        self.refuse(FAILED, "builtin:teapot", says="doll")

    def test_scanners_that_cannot_be(self):
        self.refuse(FAILED, "builtin:cylinder", "--scanner", "kinect-v3", says="kinect-v2")
        for text, says in (("near = '2m'\nfar = '1m'\nrows = 4\ncolumns = 4\nfy = 4\n", "near"),
                           ("rows = 0\ncolumns = 4\nfy = 4\n", "samples"),
                           ("rows = 4\n", "own.toml"), ("rows = 4\nlens = 2\n", "own.toml:2")):
            (self.dir / "own.toml").write_text(text)
            self.refuse(USAGE, "builtin:cylinder", "--scanner", "own.toml", says=says)

    def test_a_folder_with_content_is_never_touched(self):
        (self.dir / "rec").mkdir()
        (self.dir / "rec" / "diary.txt").write_text("dear")
        self.refuse(FAILED, "builtin:cylinder", says="rec")

    def test_a_truth_that_cannot_be_written_leaves_nothing(self):
        # Files may have 200 kB: enough for frames, too little for the doll.
        command = ("trap '' XFSZ; ulimit -f 200; exec \"$0\" simulate builtin:doll --frames 2 "
                   "--out rec --quiet")
        result = subprocess.run(["bash", "-c", command, harness.BIN], cwd=self.dir, text=True,
                                capture_output=True, stdin=subprocess.DEVNULL, timeout=100)
        self.assertEqual(result.returncode, FAILED, result.stderr)
        self.assert_one_line_error(result.stderr)
        self.assertIn("object.ply", result.stderr)
        self.assertEqual(self.files(), [])

    def test_a_full_disk_leaves_nothing(self):
        (self.dir / "disk").mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", "disk"],
                               cwd=self.dir, capture_output=True)
        if mount.returncode != 0:
            self.skipTest("no file system may be mounted here")
        try:
            for more in ((), ("--samples",)):
                self.refused(FAILED, "simulate", recordings.mesh_of("doll"), "--frames", "40", "--out",
                             "disk/rec", "--quiet", *more, says="disk/rec")
                self.assertEqual(list((self.dir / "disk").iterdir()), [])
        finally:
            subprocess.run(["umount", "disk"], cwd=self.dir, check=True)


class Damaged(harness.TestCase):
    """A mesh need not be perfect to be looked at."""

    def depths(self, text, name):
        (self.dir / f"{name}.ply").write_text(text)
        self.ok("simulate", f"{name}.ply", *NARROW, "--frames", "3", "--noise", "none", "--out", name,
                "--quiet")
        return (self.dir / name / "depth/000001.png").read_bytes()

    def test_inverted_open_and_degenerate_meshes_work(self):
        cube = ply_cube(0.1)
        good = self.depths(cube, "good")
        self.assertEqual(self.depths(cube.replace("4 0 1 3 2", "4 2 3 1 0"), "inverted"), good)
        self.depths(ply_cube(0.1, hole=True), "open")
        faces = int(re.search(r"element face (\d+)", cube).group(1))
        more = cube.replace(f"element face {faces}", f"element face {faces + 3}")
        # A face twice, one that is a line, and one that is a point.
        self.assertEqual(self.depths(more + "4 0 1 3 2\n3 0 0 1\n3 2 2 2\n", "worse"), good)

    def test_a_scanner_inside_the_object_sees_its_inside(self):
        (self.dir / "room.ply").write_text(ply_cube(4.0))
        self.ok("simulate", "room.ply", "--no-platter", *NARROW, "--frames", "2", "--noise", "none",
                "--aim-height", "2m", "--out", "rec", "--report", "r.json", "--quiet")
        samples = json.loads((self.dir / "r.json").read_text())["scanners"][0]["samples"]
        self.assertGreater(samples["measured"], 0.9 * 2 * 256 * 212)


if __name__ == "__main__":
    harness.main()
