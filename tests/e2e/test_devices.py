"""turnscan devices, and calibrate --device: sensors that are virtual, played back, or stood in for."""

import json
import pathlib
import unittest

import harness

RIG = "virtual:cylinder?elevation=30deg&noise=gaussian:1mm&room=desk"
FAKENECT = next(iter(pathlib.Path("/usr/lib").glob("*/fakenect/libfreenect.so.0.5")), None)


class Devices(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.env = {"XDG_STATE_HOME": str(self.dir / "state")}

    def test_lists_what_there_is_and_as_json(self):
        out = self.ok("devices", "--json", "d.json").stdout
        self.assertIn("virtual:OBJECT", out)
        self.assertIn("replay:RECORDING", out)
        listed = json.loads((self.dir / "d.json").read_text())
        self.assertIn("doll", listed["virtual"]["objects"])
        for driver in listed["drivers"]:
            self.assertIn(f"{driver['name']}:", out)

    def test_no_driver_and_no_device_are_clear_sentences(self):
        self.refused(1, "calibrate", "--device", "telepathy:", says=["no driver of that name"])
        self.refused(2, "calibrate", "--device", "doll", says=["no scheme"])
        self.refused(1, "calibrate", "--device", "virtual:doll?fault=busy", says=["another program"])
        self.refused(1, "calibrate", "--device", "virtual:doll?fault=denied", says=["udev"])
        self.refused(1, "calibrate", "--device", "virtual:cylinder?fault=lost@1s&prepared=1",
                     says=["stopped answering"])
        folder = self.dir / "none"
        folder.mkdir()
        env = {**self.env, "TURNSCAN_PLUGINS": str(folder)}
        self.assertIn("No drivers are installed", self.ok("devices", env=env).stdout)
        self.refused(1, "calibrate", "--device", "freenect:", env=env, says=["no driver"])

    def test_sensors_that_are_not_connected_are_not_found(self):
        drivers = {d["name"] for d in self.drivers()}
        for name, what in (("freenect", "no Kinect is connected"),
                           ("openni2", "no OpenNI 2 sensor is connected")):
            if name in drivers:
                self.refused(1, "calibrate", "--device", f"{name}:", says=[what])

    def drivers(self):
        self.ok("devices", "--json", "list.json")
        return json.loads((self.dir / "list.json").read_text())["drivers"]

    @unittest.skipUnless(FAKENECT, "libfreenect's fakenect is not installed")
    def test_a_kinect_that_fakenect_plays_is_connected(self):
        if "freenect" not in {d["name"] for d in self.drivers()}:
            self.skipTest("the driver was not built")
        env = {**self.env, "LD_LIBRARY_PATH": str(FAKENECT.parent)}
        self.assertIn("freenect:0", self.ok("devices", env=env).stdout)

    def test_a_calibration_is_kept_and_says_when_the_table_has_moved(self):
        run = {"env": self.env}
        self.refused(1, "calibrate", "--device", RIG, "--check", **run, says=["never calibrated"])
        out = self.ok("calibrate", "--device", RIG, "--detect", **run).stdout
        self.assertIn("Stored for virtual-kinect-v2-0", out)
        kept = self.dir / "state/turnscan/calibrations/virtual-kinect-v2-0.json"
        self.assertTrue(kept.exists())
        out = self.ok("calibrate", "--device", RIG + "&seed=2", "--check", **run).stdout
        self.assertIn("stands as calibrated", out)
        self.refused(1, "calibrate", "--device", RIG + "&table-x=12mm", "--check", **run,
                     says=["moved", "calibrate anew"])
        before = kept.read_bytes()
        self.refused(1, "calibrate", "--device", "virtual:empty?platter=0", "--detect", **run)
        self.assertEqual(kept.read_bytes(), before)

    def test_the_motion_of_an_object_calibrates_a_device(self):
        out = self.ok("calibrate", "--device",
                      "virtual:letter-a?frames=60&noise=gaussian:1mm&elevation=30deg&room=desk",
                      "--from-motion", "--device-frames", "60", env=self.env).stdout
        self.assertIn("speed", out)

    def test_a_recording_and_a_device_exclude_each_other(self):
        self.refused(2, "calibrate", "x", "--device", RIG, says=["both given"])
        self.refused(2, "calibrate", says=["RECORDING", "--device"])


if __name__ == "__main__":
    harness.main()
