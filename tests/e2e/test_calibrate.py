"""turnscan calibrate, and what reconstruct does with and without a calibration."""

import json
import unittest

import harness
import recordings
from harness import DATA, FAILED, NARROW, SENSOR, USAGE

CENTER_M, AXIS = (0.0, 0.0861, 0.9262), (0.0, -0.9563, -0.2924)  # of the demo's virtual camera


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


class Calibrate(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.rec = recordings.folder_of("letter-a")

    def calibrate(self, *args):
        self.ok("calibrate", *args, "--json", "c.json")
        return json.loads((self.dir / "c.json").read_text())

    def assert_true_place(self, found, metres):
        self.assertLess(distance(found["axis"], AXIS), 0.004)
        self.assertLess(distance(found["center_m"], CENTER_M), metres)

    def bare(self):
        """The recording without turntable and angles."""
        recordings.copy(self.rec, self.dir / "bare")
        path = self.dir / "bare" / "recording.json"
        recording = json.loads(path.read_text())
        del recording["turntable"]
        for sensor in recording["sensors"]:
            sensor.pop("T_table_sensor", None)
        path.write_text(json.dumps(recording))
        path = self.dir / "bare" / "frames.csv"
        rows = [line.split(",") for line in path.read_text().splitlines()]
        column = rows[0].index("angle_deg")
        for row in rows[1:]:
            row[column] = ""
        path.write_text("".join(",".join(row) + "\n" for row in rows))
        return "bare"

    def test_motion_alone_gives_place_speed_and_angles(self):
        found = self.calibrate(self.bare(), "--from-motion")
        self.assert_true_place(found, 0.001)
        self.assertEqual(found["method"], "motion")
        self.assertAlmostEqual(found["speed_deg_s"], 180.0, delta=1.0)  # 6 degrees a frame, 30 fps
        self.assertEqual(len(found["angles_deg"]), 60)
        self.assertAlmostEqual(found["angles_deg"][30], 180.0, delta=0.5)

    def test_detection_gives_place_and_radius(self):
        found = self.calibrate(self.rec, "--detect")
        self.assert_true_place(found, 0.003)
        self.assertAlmostEqual(found["radius_m"], 0.15, delta=0.003)
        self.assertGreater(found["confidence"], 0.7)

    def test_picked_points_and_what_is_wrong_with_them(self):
        rim = "x_m,y_m,z_m\n0.15,0.0861,0.9262\n-0.15,0.0861,0.9262\n0,0.04222,1.06965\n"
        (self.dir / "p.csv").write_text(rim)
        self.assert_true_place(self.calibrate(self.rec, "--points", "p.csv"), 0.001)
        excel = rim.replace(",", ";").replace(".", ",").replace("x_m", "X [m]")
        (self.dir / "excel.csv").write_bytes(excel.encode("utf-16"))
        self.assert_true_place(self.calibrate(self.rec, "--points", "excel.csv"), 0.001)
        (self.dir / "same.csv").write_text(rim + "0.15,0.0861,0.9262\n")
        self.refused(FAILED, "calibrate", self.rec, "--points", "same.csv", says="points 1 and 4")
        (self.dir / "word.csv").write_text(rim + "a,b,c\n")
        self.refused(FAILED, "calibrate", self.rec, "--points", "word.csv", says="line 5")
        (self.dir / "columns.csv").write_text("a,b\n1,2\n")
        self.refused(FAILED, "calibrate", self.rec, "--points", "columns.csv", says="x_mm")

    def test_a_saved_calibration_is_used_and_reads_back_the_same(self):
        self.ok("calibrate", self.bare(), "--save", "a.json")
        self.ok("reconstruct", "bare", "-o", "m.ply", "--turntable", "a.json", *harness.FAST)
        self.ok("info", "m.ply")

    def test_a_recording_without_calibration_is_reconstructed_and_that_is_said(self):
        out = self.ok("reconstruct", self.bare(), "-o", "m.ply", *harness.FAST).stdout
        self.assertIn("found from motion", out)
        self.refused(FAILED, "reconstruct", "bare", "-o", "n.ply", "--calibration", "recorded")
        self.refused(USAGE, "reconstruct", "bare", "-o", "n.ply", "--calibration", "magic")

    def test_angles_of_the_wrong_sign_beside_a_stated_turntable_are_corrected(self):
        recordings.copy(self.rec, self.dir / "mirrored")
        path = self.dir / "mirrored" / "recording.json"
        recording = json.loads(path.read_text())
        recording["turntable"].pop("speed_rad_s")
        path.write_text(json.dumps(recording))
        path = self.dir / "mirrored" / "frames.csv"
        rows = [line.split(",") for line in path.read_text().splitlines()]
        column = rows[0].index("angle_deg")
        for row in rows[1:]:
            row[column] = str(-float(row[column]))
        path.write_text("".join(",".join(row) + "\n" for row in rows))
        right = self.ok("reconstruct", self.rec, "-o", "right.ply", *harness.FAST).stdout
        self.assertNotIn("wrong way round", right)
        out = self.ok("reconstruct", "mirrored", "-o", "m.ply", *harness.FAST).stdout
        self.assertIn("count the wrong way round", out)
        self.ok("evaluate", "m.ply", "--reference", "right.ply", "--samples", "20000", "--json", "e.json")
        self.assertLess(json.loads((self.dir / "e.json").read_text())["accuracy"]["median_m"], 1e-4)

    def test_a_table_that_has_moved_since_it_was_calibrated_is_noticed_and_found_anew(self):
        scene = ("simulate", recordings.mesh_of("doll"), "--height", "160mm", "--frames", "60", *NARROW,
                 "--fps", "6", "--turns", "1.1", "--calibration", "nominal")
        self.ok(*scene, "--table-x", "5mm", "--table-tilt", "1deg", "-o", "moved")
        out = self.ok("reconstruct", "moved", "-o", "m.ply", "--voxel-size", "2mm").stdout
        self.assertIn("beside the one about which the object turns", out)
        self.assertIn("found from motion", out)
        self.ok("evaluate", "m.ply", "--reference", "moved/truth/object.ply", "--align", "icp",
                "--samples", "20000", "--json", "e.json")
        self.assertLess(json.loads((self.dir / "e.json").read_text())["accuracy"]["median_m"], 3e-4)
        # What somebody gives is used, but not without a word.
        table = json.loads((self.dir / "moved" / "recording.json").read_text())["turntable"]
        (self.dir / "t.json").write_text(json.dumps(table))
        out = self.ok("reconstruct", "moved", "-o", "m.ply", "--turntable", "t.json",
                      *harness.FAST).stdout
        self.assertIn("given (--calibration motion estimates another)", out)
        out = self.ok("reconstruct", "moved", "-o", "m.ply", "--speed", "45deg/s",
                      *harness.FAST).stdout
        self.assertIn("slower than stated", out)
        # A table that stands where it should is not doubted.
        self.ok(*scene, "-o", "right")
        out = self.ok("reconstruct", "right", "-o", "m.ply", *harness.FAST).stdout
        self.assertNotIn("the object turns", out)

    def test_the_offset_of_depth_is_found_kept_and_used(self):
        found = self.calibrate(self.rec, "--detect", "--depth-bias", "--platter-radius", "150mm")
        self.assertLess(abs(found["depth"]["bias_m"]), 0.01)
        self.refused(USAGE, "calibrate", self.rec, "--depth-bias", says="--platter-radius")
        self.refused(USAGE, "calibrate", self.rec, "--depth-also", self.rec, says="--depth-bias")
        self.refused(FAILED, "calibrate", self.rec, "--depth-bias", "--platter-radius", "150mm",
                     "--depth-also", self.rec, says="two distances")
        (self.dir / "k").mkdir()
        (self.dir / "k" / "calib_depth.yaml").write_text("%YAML:1.0\n---\ndepthShift: -25.5\n")
        found = self.calibrate(self.rec, "--detect", "--iai-kinect2", "k")
        self.assertAlmostEqual(found["depth"]["bias_m"], -0.0255)
        self.refused(FAILED, "calibrate", self.rec, "--iai-kinect2", "none", says="calib_depth.yaml")

    def test_a_calibrated_camera_is_kept_used_and_not_mistaken_for_another(self):
        # iai_kinect2's files are of a Kinect v2, with all of its pixels.
        self.ok("simulate", "builtin:letter-a", "--frames", "24", "--aim-height", "90mm", "-o", "whole")
        whole = self.dir / "whole"
        camera = json.loads((whole / "recording.json").read_text())["sensors"][0]["intrinsics"]
        (self.dir / "k").mkdir()
        (self.dir / "k" / "calib_ir.yaml").write_text(
            "%YAML:1.0\ncameraMatrix: !!opencv-matrix\n   data: [ {}, 0., {},\n      0., {}, {}, 0., "
            "0., 1. ]\ndistortionCoefficients: !!opencv-matrix\n   data: [ 0., 0., 0., 0., 0. ]\n"
            .format(1.02 * camera["fx"], camera["cx"], 1.02 * camera["fy"], camera["cy"]))
        found = self.calibrate(whole, "--detect", "--iai-kinect2", "k", "--save", "s.json")
        self.assertAlmostEqual(found["camera"]["intrinsics"]["fx"], 1.02 * camera["fx"])
        self.assertAlmostEqual(found["radius_m"], 0.15 / 1.02, delta=0.002)
        self.ok("reconstruct", whole, "-o", "m.ply", "--turntable", "s.json", *harness.FAST)
        text = (self.dir / "s.json").read_text().replace('"width": 512', '"width": 500')
        (self.dir / "s.json").write_text(text)
        self.refused(USAGE, "reconstruct", whole, "-o", "n.ply", "--turntable", "s.json",
                     says="512 x 424")

    def test_a_ball_is_a_gauge_of_depth(self):
        self.refused(USAGE, "calibrate", self.rec, "--gauge-ball", "100mm", says="--depth-bias")
        self.refused(FAILED, "calibrate", self.rec, "--depth-bias", "--gauge-ball", "300mm",
                     says="no ball")

    def test_ways_that_exclude_each_other(self):
        self.refused(USAGE, "calibrate", self.rec, "--detect", "--from-motion")
        self.refused(USAGE, "calibrate", self.rec, "--check", "--json", "c.json")

    def test_check_says_what_is_right(self):
        out = self.ok("calibrate", self.rec, "--check").stdout
        self.assertIn("Direction", out)
        self.assertNotIn("WRONG", out)

    def test_check_finds_a_halt_and_a_slip_that_nobody_recorded(self):
        scene = ["simulate", recordings.mesh_of("doll"), "--height", "180mm", "--frames", "90", *NARROW,
                 "--fps", "8", "--turns", "1.2"]
        halt = ["--halt-at", "5s", "--halt", "1.5s"]
        for name, fault, says in (
                ("halt", halt, "WRONG +Motor: about [456].* s the table slowed down or stopped"),
                ("slip", ["--slip-at", "6s", "--slip", "45deg"],
                 "WRONG +Motor: about [56].* s the table slipped ahead by about [45]\\d deg")):
            self.ok(*scene, *fault, "--no-angles", "-o", name)
            result = self.refused(FAILED, "calibrate", name, "--check")
            self.assertRegex(result.stdout, says)
        # An encoder that saw it makes it right; one that did not is found out.
        self.ok(*scene, *halt, "-o", "encoded")
        self.assertIn("the recorded angles follow it", self.ok("calibrate", "encoded", "--check").stdout)
        frames = (self.dir / "encoded" / "frames.csv").read_text().splitlines()
        column = frames[0].split(",").index("angle_deg")
        rows = [line.split(",") for line in frames]
        for i, row in enumerate(rows[1:]):
            row[column] = str(432.0 / 90 * i)
        (self.dir / "encoded" / "frames.csv").write_text("".join(",".join(r) + "\n" for r in rows))
        self.assertRegex(self.refused(FAILED, "calibrate", "encoded", "--check").stdout,
                         "WRONG +Motor: about [456].* the table slowed down or stopped.*"
                         "the recorded angles do not follow it")

    def test_two_sensors_at_different_azimuths_are_brought_to_one_heading(self):
        sensor = f"{SENSOR},elevation={{}},azimuth={{}},distance=0.7m"
        self.ok("simulate", recordings.mesh_of("doll"), "--height", "180mm", "--frames", "40", "--turns", "1.1",
                "--scanner", sensor.format("15deg", "0deg"), "--scanner",
                sensor.format("40deg", "130deg"), "-o", "two")
        truth = json.loads((self.dir / "two" / "recording.json").read_text())
        truth = truth["sensors"][1]["T_table_sensor"]
        found = self.calibrate("two", "--from-motion", "--no-motion-angles", "--no-motion-table")
        other = found["other_sensors"][0]
        self.assertEqual(len(found["angles_deg"]), 80)
        for row, true_row in zip(other["T_table_sensor"], truth):
            for value, true_value in zip(row, true_row):
                self.assertAlmostEqual(value, true_value, delta=0.008)

    def test_each_of_two_sensors_gets_its_own_offset_of_depth(self):
        sensor = f"{SENSOR},elevation={{}},azimuth={{}},distance=0.7m"
        self.ok("simulate", recordings.mesh_of("doll"), "--height", "180mm", "--frames", "40", "--turns", "1.1",
                "--scanner", sensor.format("35deg", "0deg"), "--scanner",
                sensor.format("40deg", "60deg"), "-o", "off")
        file = self.dir / "off" / "recording.json"
        recording = json.loads(file.read_text())
        recording["sensors"][1]["depth_bias_m"] = 0.02
        file.write_text(json.dumps(recording))
        found = self.calibrate("off", "--from-motion", "--depth-bias", "--platter-radius", "150mm",
                               "--save", "off.json")
        for depth in (found["depth"], found["other_sensors"][0]["depth"]):
            self.assertAlmostEqual(depth["bias_m"], 0.0, delta=0.005)
        self.ok("reconstruct", "off", "-o", "off.ply", "--turntable", "off.json", *harness.FAST)
        self.refused(USAGE, "calibrate", "off", "--iai-kinect2", "k", "--iai-kinect2", "k",
                     "--iai-kinect2", "k", says="2 sensors")

    @unittest.skipUnless((DATA / "d435_bear").is_dir(), "the data are not there")
    def test_a_real_bear_from_eight_depth_images_alone(self):
        estimate = json.loads((DATA / "d435_bear" / "poses_estimated.json").read_text())
        self.ok("import", DATA / "d435_bear" / "poses_estimated.json", "-o", "bear")
        found = self.calibrate("bear", "--from-motion", "--no-motion-angles", "--no-motion-table")
        self.assertLess(distance(found["axis"], estimate["axis_dir"]), 0.0175)
        off = [c - p for c, p in zip(found["center_m"], estimate["axis_point"])]
        along = sum(o * a for o, a in zip(off, estimate["axis_dir"]))
        self.assertLess(sum(o * o for o in off) - along * along, 0.0021 ** 2)
        self.assertAlmostEqual(found["radius_m"], 0.126, delta=0.001)
        for angle, truth in zip(found["angles_deg"], estimate["angle_rad_closed"]):
            self.assertAlmostEqual(angle, truth * 57.29578, delta=1.5)


if __name__ == "__main__":
    harness.main()
