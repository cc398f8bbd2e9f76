"""turnscan capture, scan, turntable and info --repair: what is recorded stays recorded."""

import fcntl
import json
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time

import harness
import recordings
from harness import CANCELLED, FAILED, SENSOR, USAGE, run, start
from table import Table

# Small frames, rendered once: what is tested is what happens to them afterwards.
SMALL = "virtual:cylinder?height=200mm&sensor=kinect-v1&distance=3m&prepared=15&speed=720deg/s"
TIMED = ("--quiet", "--min-free", "0")
KILLS = int(os.environ.get("TURNSCAN_TEST_KILLS", "12"))
RESUMES = int(os.environ.get("TURNSCAN_TEST_RESUMES", "1"))


def frames_of(recording):
    lines = (recording / "frames.csv").read_bytes().split(b"\n")[1:-1]
    return [line.decode().split(",") for line in lines]


def description(recording):
    return json.loads((recording / "recording.json").read_text())


class Capture(harness.TestCase):
    def capture(self, *args, device=SMALL, out="r"):
        return self.ok("capture", "--device", device, "-o", out, *TIMED, *args)

    def assert_complete(self, out="r", least=1):
        recording = self.dir / out
        self.assertTrue(description(recording)["complete"])
        self.assertGreaterEqual(len(frames_of(recording)), least)
        self.ok("info", out)

    def test_turns_with_a_report(self):
        self.capture("--turns", "2", "--speed", "720deg/s", "--report", "r.json")
        self.assert_complete()
        report = json.loads((self.dir / "r.json").read_text())
        self.assertAlmostEqual(report["turns"], 2.0, delta=0.2)
        self.assertEqual(report["dropped"], {"sensor": 0, "queue": 0, "refused": 0, "disk": 0})
        self.assertEqual(report["frames"], len(frames_of(self.dir / "r")))

    def test_a_second_run_never_overwrites(self):
        self.capture("--frames", "3")
        before = {p: p.read_bytes() for p in (self.dir / "r").rglob("*") if p.is_file()}
        self.refused(FAILED, "capture", "--device", SMALL, "-o", "r", "--frames", "3",
                     says="never overwritten")
        self.assertEqual(
            before, {p: p.read_bytes() for p in (self.dir / "r").rglob("*") if p.is_file()})

    def test_until_stopped_ends_well_and_otherwise_ctrl_c_says_so(self):
        for args, code in ((["--until-stopped"], 0), (["--seconds", "300"], CANCELLED)):
            with self.subTest(args=args):
                out = f"r{code}"
                process = start("capture", "--device", SMALL + "&realtime=1", "-o", out, *TIMED,
                                *args, cwd=self.dir)
                self.wait_for_frames(out, 5)
                process.send_signal(signal.SIGINT)
                _, err = process.communicate(timeout=60)
                self.assertEqual(process.returncode, code, err)
                if code:
                    self.assert_one_line_error(err)
                    self.assertIn("is complete", err)
                self.assert_complete(out, 5)

    def wait_for_frames(self, out, count):
        for _ in range(12000):
            table = self.dir / out / "frames.csv"
            if table.exists() and table.read_bytes().count(b"\n") > count:
                return
            time.sleep(0.01)
        self.fail("no frames came")

    def test_what_goes_wrong_with_the_device(self):
        for fault, says in (("lost@0.5s", "stopped answering"), ("missing", "no device"),
                            ("busy", "another program"), ("denied", "may not open")):
            with self.subTest(fault=fault):
                out = "r-" + fault[:4]
                self.refused(FAILED, "capture", "--device", f"{SMALL}&fault={fault}", "-o", out,
                             "--frames", "500", says=says)
                if fault.startswith("lost"):
                    self.assert_complete(out, 10)
                else:
                    self.assertFalse((self.dir / out).exists())

    def test_a_stall_of_five_seconds_is_survived(self):
        # Not in real time: the sensor's clock jumps by 5 s.
        self.capture("--seconds", "6", device=SMALL + "&fault=stall@0.5s+5s")
        times = [float(line[1]) for line in frames_of(self.dir / "r")]
        self.assertGreater(max(b - a for a, b in zip(times, times[1:])), 4.9)

    def test_frames_that_are_wrong_become_dropped_lines(self):
        self.capture("--frames", "30", device=SMALL + "&fault=size@0.2s,backwards@0.5s")
        dropped = [line for line in frames_of(self.dir / "r") if line[-1] == "dropped"]
        self.assertEqual(len(dropped), 2)

    def mounted(self, options):
        """A small file system in memory, in the folder small."""
        mount = self.dir / "small"
        mount.mkdir()
        made = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", mount],
                              capture_output=True)
        if made.returncode != 0:
            self.skipTest("mounting is not allowed here")
        return mount

    def test_a_disk_that_may_only_be_read(self):
        mount = self.mounted("ro")
        try:
            self.refused(FAILED, "capture", "--device", SMALL, "-o", "small/r", "--frames", "3",
                         says="small/r")
        finally:
            subprocess.run(["umount", mount], check=True)

    def test_a_full_disk(self):
        mount = self.mounted("size=1m")
        try:
            full = ("capture", "--device", SMALL, "-o", "small/r", "--until-stopped")
            self.refused(FAILED, *full, "--min-free", "0", says="small/r holds the")
            self.ok("info", "small/r")
            self.assertGreater(len(frames_of(mount / "r")), 5)
            shutil.rmtree(mount / "r")
            self.refused(FAILED, *full, says="MB are free")
            self.assertFalse((mount / "r").exists())
            self.refused(FAILED, *full, "--min-free", "300000", says=("MB are free", "is complete"))
            self.assert_complete("small/r", 5)
        finally:
            subprocess.run(["umount", mount], check=True)

    def test_a_folder_that_may_not_be_written(self):
        (self.dir / "locked").mkdir()
        (self.dir / "locked").chmod(0o500)
        if os.access(self.dir / "locked", os.W_OK):
            self.skipTest("this user may write everywhere")
        self.refused(FAILED, "capture", "--device", SMALL, "-o", "locked/r", "--frames", "3")

    def test_standard_output_that_is_full(self):
        with open("/dev/full", "w") as full:
            process = start("capture", "--device", SMALL, "-o", "r", "--frames", "5", *TIMED,
                            cwd=self.dir, stdout=full)
            _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, FAILED)
        self.assert_one_line_error(err)
        self.assert_complete("r", 5)

    def test_a_pipe_for_messages_that_nobody_reads(self):
        reader, writer = os.pipe()
        fcntl.fcntl(writer, fcntl.F_SETFL, os.O_NONBLOCK)
        try:
            while True:
                os.write(writer, b"x" * 4096)
        except BlockingIOError:
            pass
        fcntl.fcntl(writer, fcntl.F_SETFL, 0)
        process = start("capture", "--device", SMALL, "-o", "r", "--frames", "200", "--min-free",
                        "0", cwd=self.dir, stderr=writer)
        process.communicate(timeout=60)
        os.close(reader)
        os.close(writer)
        self.assertEqual(process.returncode, 0)
        self.assert_complete("r", 200)

    def test_wrong_usage(self):
        for args, says in ((("--turns", "1", "--frames", "3"), "exclude each other"),
                           (("--crop",), "calibrate first"), (("--stops", "8"), "no motor"),
                           (("--turns", "0"), "turns")):
            self.refused(USAGE, "capture", "--device", SMALL, "-o", "r", *args, says=says)
        self.refused(USAGE, "capture", "--device", "virtual", "-o", "r")
        self.assertEqual(self.files(), [])


class Scan(harness.TestCase):
    """One go; small images and few frames."""
    FAST = ("--quiet", "--min-free", "0", "--voxel-size", "3mm")

    def setUp(self):
        super().setUp()
        self.device = f"virtual:{self.truth()}?sensor={SENSOR}&fps=6&speed=12deg/s"

    def assert_closed(self, mesh="doll.3mf"):
        info = json.loads(self.ok("info", "--json", mesh).stdout)["objects"]
        self.assertEqual(len(info), 1)
        self.assertTrue(info[0]["closed"], info)
        return info[0]

    def assert_as_reconstructed(self, name="doll"):
        """One run, two commands: the recording of a scan gives its mesh, its notes and its verdict."""
        self.ok("reconstruct", f"{name}.recording", "-o", "again.3mf", "--voxel-size", "3mm",
                "--report", "again.json", "--quiet")
        self.assertEqual((self.dir / f"{name}.3mf").read_bytes(),
                         (self.dir / "again.3mf").read_bytes())
        scan = json.loads((self.dir / "r.json").read_text())
        again = json.loads((self.dir / "again.json").read_text())
        self.assertEqual(scan["next_pass"], again["next_pass"])
        made = scan["reconstruction"]
        self.assertEqual(made["notes"], again["notes"])
        for ours, theirs in zip(made["objects"], again["objects"], strict=True):
            self.assertIsNotNone(ours["verdict"])
            for key in ("verdict", "frame_residuals", "notes"):
                self.assertEqual(ours.get(key), theirs.get(key), key)
        return again

    def truth(self):
        return recordings.mesh_of("doll")

    def ok(self, *args, **more):
        # Calibrations are kept in a home of the test's own.
        return super().ok(*args, env={"XDG_STATE_HOME": str(self.dir / "state")}, **more)

    def test_nothing_is_known(self):
        self.ok("scan", "--device", self.device, "-o", "doll.3mf", "--report", "r.json", *self.FAST)
        self.assertEqual(len(list(self.dir.glob("state/turnscan/calibrations/*.json"))), 1)
        self.assert_closed()
        report = json.loads((self.dir / "r.json").read_text())
        self.assertEqual(report["capture"]["turns_counted_by"], "motion")
        self.assertAlmostEqual(report["capture"]["turns"], 1.01, delta=0.05)
        # After half a turn the speed was looked for once more.
        self.assertAlmostEqual(math.degrees(report["capture"]["speed_rad_s"]), 12.0, delta=0.03)
        self.assertTrue(description(self.dir / "doll.recording")["complete"])
        # It was calibrated and reconstructed from most of the turn, and the rest fitted it.
        self.assertTrue(report["ahead"]["kept"], report)
        self.assertAlmostEqual(report["ahead"]["frames"], 0.8 * report["capture"]["frames"],
                               delta=5)
        self.assertLess(report["ahead"]["closure_mm"], report["ahead"]["closure_limit_mm"])
        # The next scan knows where the table is, and with its speed works while frames come.
        self.ok("scan", "--device", self.device, "-o", "next.3mf", "--report", "r.json", "--speed",
                "12deg/s", *self.FAST)
        self.assert_closed("next.3mf")
        report = json.loads((self.dir / "r.json").read_text())
        self.assertIn("stored calibration of this device", " ".join(report["notes"]))
        self.ok("reconstruct", "next.recording", "-o", "again.3mf", "--calibration", "recorded",
                "--method", "volumetric", "--voxel-size", "3mm", "--quiet")
        self.assertEqual((self.dir / "next.3mf").read_bytes(),
                         (self.dir / "again.3mf").read_bytes())

    def test_what_was_worked_out_ahead_is_not_kept_when_the_turn_does_not_close(self):
        # The table jumps after the frames that the calibration is from.
        self.ok("scan", "--device", self.device + "&slip-at=20s&slip=60deg", "--ahead", "0.55",
                "-o", "doll.3mf", "--report", "r.json", *self.FAST)
        report = json.loads((self.dir / "r.json").read_text())
        self.assertFalse(report["ahead"]["kept"], report)
        self.assertIn("was not kept", " ".join(report["notes"]))
        self.assert_closed()
        # Then the whole recording was worked on, as it would be now.
        self.assert_as_reconstructed()

    def test_all_is_known_and_the_object_comes_later(self):
        self.ok("scan", "--device", self.device + "&calibration=true&appears=4s", "-o", "doll.3mf",
                "--report", "r.json", *self.FAST)
        self.assert_closed()
        frames = frames_of(self.dir / "doll.recording")
        self.assertGreater(float(frames[0][1]), 4.0)
        # The stream's mesh is the one that the recording gives.
        self.assert_as_reconstructed()
        # The next scan keeps the first recording.
        self.refused(FAILED, "scan", "--device", self.device + "&fault=lost@8s", "-o", "doll.3mf",
                     "--min-free", "0", says=("doll-2.recording holds", "is complete"))

    def test_a_slip_on_a_known_table_is_put_right_after_the_turn(self):
        self.ok("scan", "--device", self.device + "&calibration=true&slip-at=15s&slip=20deg",
                "-o", "doll.3mf", "--report", "r.json", *self.FAST)
        again = self.assert_as_reconstructed()
        self.assertIn("moved", " ".join(again["notes"]))

    def scan_killed_and_resumed(self, device, at, *more):
        """The lines of frames.csv at the kill; None if all was recorded by then."""
        args = ("scan", "--device", device, "-o", "doll.3mf", "--report", "r.json", "--no-wait",
                "--min-free", "0", *more, *self.FAST)
        process = start(*args, cwd=self.dir, env={"XDG_STATE_HOME": str(self.dir / "state")})
        table = self.dir / "doll.recording" / "frames.csv"
        while process.poll() is None and (
                not table.exists() or table.read_bytes().count(b"\n") <= at):
            time.sleep(0.005)
        process.kill()
        _, err = process.communicate()
        self.assertIn(process.returncode, (0, -signal.SIGKILL), err)
        lines = len(frames_of(self.dir / "doll.recording"))
        # On a busy machine the turn may be over before the kill, and with fewer frames.
        if description(self.dir / "doll.recording")["complete"]:
            return None
        self.ok(*args, "--resume", "doll.recording")
        return lines

    def test_a_scan_of_a_source_that_waits_goes_on_as_if_nothing_had_happened(self):
        self.ok("scan", "--device", self.device, "-o", "whole.3mf", "--no-wait", *self.FAST)
        harness.remove(self.dir / "state")
        self.scan_killed_and_resumed(self.device, 40)
        self.assertEqual((self.dir / "doll.recording/frames.csv").read_bytes(),
                         (self.dir / "whole.recording/frames.csv").read_bytes())
        self.assertEqual((self.dir / "doll.3mf").read_bytes(),
                         (self.dir / "whole.3mf").read_bytes())

    def f_score(self, mesh):
        self.ok("evaluate", mesh, "--reference", self.truth(), "--align", "icp", "--samples",
                "50000", "--json", "e.json")
        judged = json.loads((self.dir / "e.json").read_text())
        return next(s["f"] for s in judged["scores"] if s["threshold_m"] == 0.001)

    def test_a_turn_that_was_cut_short_is_resumed_as_a_new_stretch(self):
        device = (f"virtual:{self.truth()}?sensor={SENSOR}&fps=12&speed=24deg/s&calibration=true"
                  "&realtime=1&prepared=200")
        self.ok("scan", "--device", device, "-o", "whole.3mf", "--no-wait", "--min-free", "0",
                *self.FAST)
        before = self.scan_killed_and_resumed(device, 40)
        recording = self.dir / "doll.recording"
        self.assertEqual(description(recording)["resumed_at"], [before])
        frames = frames_of(recording)
        self.assertGreater(len(frames), before + 80)
        times = [float(line[1]) for line in frames]
        self.assertEqual(times, sorted(times))
        notes = " ".join(json.loads((self.dir / "r.json").read_text())["reconstruction"]["notes"])
        self.assertIn("found from motion", notes)
        self.assert_closed()
        self.assertAlmostEqual(self.f_score("doll.3mf"), self.f_score("whole.3mf"), delta=0.005)

    def test_turns_that_are_killed_at_random_moments_are_resumed(self):
        device = (f"virtual:{self.truth()}?sensor={SENSOR}&fps=12&speed=24deg/s&calibration=true"
                  "&realtime=1&prepared=200")
        self.ok("scan", "--device", device, "-o", "whole.3mf", "--no-wait", "--min-free", "0",
                *self.FAST)
        whole = self.f_score("whole.3mf")
        chance = random.Random(2)
        late = 0
        for kill in range(RESUMES):
            at = chance.randrange(2, 170)
            with self.subTest(kill=kill, at=at):
                if self.scan_killed_and_resumed(device, at) is None:
                    late += 1
                else:
                    self.assertAlmostEqual(self.f_score("doll.3mf"), whole, delta=0.005)
            harness.remove(self.dir / "doll.recording")
            harness.remove(self.dir / "state")
            (self.dir / "doll.3mf").unlink(missing_ok=True)
        print(f"{RESUMES} kills of a turn: {RESUMES - late} resumed, {late} when all was recorded", flush=True)

    def test_seconds_bound_the_wait_for_an_object(self):
        self.refused(FAILED, "scan", "--device", self.device + "&calibration=true&appears=60s",
                     "--seconds", "3", "-o", "doll.3mf", *self.FAST,
                     says=("within 3.0 s", "--no-wait"))
        self.assertFalse((self.dir / "doll.recording").exists())

    def test_two_sensors_make_one_mesh_without_a_double_surface(self):
        # At different heights, on different sides, with clocks that do not agree.
        device = f"virtual:{self.truth()}?sensor={SENSOR}&fps=3&speed=12deg/s&calibration=true"
        self.ok("scan", "--device", device + "&elevation=12deg", "--device",
                device + "&elevation=50deg&azimuth=120deg&seed=2&serial=1&clock=3s",
                "-o", "doll.3mf", "--no-wait", *self.FAST)
        objects = json.loads(self.ok("info", "--json", "doll.3mf").stdout)["objects"]
        self.assertTrue(all(one["closed"] for one in objects), objects)
        sensors = [line[2] for line in frames_of(self.dir / "doll.recording")]
        self.assertLessEqual(abs(sensors.count("0") - sensors.count("1")), 1)
        self.ok("evaluate", "doll.3mf", "--reference", self.truth(), "--samples", "20000",
                "--json", "e.json")
        found = json.loads((self.dir / "e.json").read_text())
        self.assertLess(found["accuracy"]["median_m"], 0.0005)
        self.assertLess(found["mesh_area_m2"], 1.1 * found["reference_area_m2"])

    def test_two_sensors_that_know_nothing_find_each_other(self):
        # Neither table nor azimuth is known to them, and their clocks do not agree.
        device = f"virtual:{self.truth()}?sensor={SENSOR}&fps=3&speed=12deg/s&elevation="
        low, high = device + "15deg", device + "45deg&azimuth=120deg&seed=2&serial=1&clock=3s"
        self.ok("scan", "--device", low, "--device", high, "-o", "doll.ply", *self.FAST)
        self.ok("evaluate", "doll.ply", "--reference", self.truth(), "--samples", "20000",
                "--align", "icp", "--json", "e.json")
        found = json.loads((self.dir / "e.json").read_text())
        self.assertLess(found["accuracy"]["median_m"], 0.0005)
        self.assertLess(found["mesh_area_m2"], 1.1 * found["reference_area_m2"])
        # What was found of both can be kept and given to the next scan, which checks both.
        self.ok("calibrate", "doll.recording", "--from-motion", "--save", "both.json")
        self.assertEqual(len(json.loads((self.dir / "both.json").read_text())["other_sensors"]), 1)
        known = ("--turntable", "both.json", "--speed", "12deg/s")
        self.ok("scan", "--device", low, "--device", high, *known, "-o", "next.3mf", *self.FAST)
        self.ok("reconstruct", "next.recording", "-o", "again.3mf", "--calibration", "recorded",
                "--voxel-size", "3mm", "--quiet")
        self.assertEqual((self.dir / "next.3mf").read_bytes(),
                         (self.dir / "again.3mf").read_bytes())
        self.refused(FAILED, "scan", "--device", low, "--device", high + "&distance=0.95m", *known,
                     "-o", "moved.3mf", *self.FAST, says="sensor 1: the rig has moved")
        self.refused(USAGE, "scan", "--device", low, *known, "-o", "alone.3mf", *self.FAST,
                     says=("where 2 sensors stand", "there is one"))

    def test_wrong_usage(self):
        self.refused(USAGE, "scan", "--device", self.device, "-o", "doll.xyz")
        self.refused(USAGE, "scan", "--device", self.device, "--device", self.device,
                     "-o", "doll.3mf", says="given twice")
        self.refused(FAILED, "scan", "--device", "virtual:unicorn", "-o", "doll.3mf")
        self.assertEqual(self.files(), [])


class Kill(harness.TestCase):
    """SIGKILL at random moments: every recording opens, holds every frame whose line is there, can be
    repaired, and reconstructs."""

    def kill_one(self, i, generator):
        out = self.dir / f"r{i}"
        process = start("capture", "--device", f"replay:{self.dir}/played?loop=1", "-o", out,
                        "--until-stopped", *TIMED)
        # Nine in ten are killed while frames are written, the others from the very start on.
        self.wait_for_lines(out, 0 if i % 10 == 9 else 2)
        time.sleep(generator.random() * 0.4)
        process.kill()
        process.communicate()
        lines = frames_of(out)
        for line in lines:
            self.assertEqual(line[-1], "ok", line)
            self.assertTrue((out / line[-3]).exists(), line)
        seen = self.ok("info", "--json", out)
        info = json.loads(seen.stdout)
        self.assertEqual((info["frames"], info["dropped_frames"]), (len(lines), 0))
        self.assertFalse(description(out)["complete"])
        said = self.ok("info", "--repair", out).stdout
        self.assertIn(f"{len(lines)} frames are whole; the recording is marked complete", said)
        self.assertTrue(description(out)["complete"])
        self.assertEqual(len(frames_of(out)), len(lines))
        self.assertNotIn("not finished", self.ok("info", out).stdout)
        self.assertEqual(list(out.rglob("*.part")), [])
        return out, len(lines)

    def wait_for_lines(self, out, count):
        """Until the table is there, with its heading and all but one of so many lines."""
        end = time.monotonic() + harness.HANG_S
        while time.monotonic() < end:
            table = out / "frames.csv"
            if table.exists() and table.read_bytes().count(b"\n") >= count:
                return
            time.sleep(0.001)
        self.fail("no recording begins")

    def reconstruct(self, out, count):
        command = ("reconstruct", out, "-o", "m.ply", "--calibration", "recorded", "--method",
                   "volumetric", "--voxel-size", "12mm", "--quiet")
        if count == 0:
            self.refused(FAILED, *command)
        else:
            self.ok(*command)

    def test_sigkill_at_random_moments(self):
        # Played back, because that starts at once and writes as fast as it can.
        self.ok("capture", "--device", SMALL + "&angles=1&calibration=true", "-o", "played",
                "--frames", "15", *TIMED)
        generator = random.Random(7)
        counts = []
        for i in range(KILLS):
            out, count = self.kill_one(i, generator)
            counts.append(count)
            self.reconstruct(out, count)
            harness.remove(out)
        empty = counts.count(0)
        print(f"{KILLS} kills: every recording whole, {min(counts)} to {max(counts)} frames; "
              f"{KILLS - empty} reconstructed, {empty} had no frame yet", flush=True)

    def test_a_recording_that_goes_on_is_not_repaired(self):
        process = start("capture", "--device", SMALL + "&realtime=1", "-o", "r", "--until-stopped",
                        *TIMED, cwd=self.dir)
        try:
            for _ in range(12000):
                if (self.dir / "r/frames.csv").exists():
                    break
                time.sleep(0.01)
            self.refused(FAILED, "info", "--repair", "r", says="being recorded")
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate()
        self.assertTrue(description(self.dir / "r")["complete"])


class Turntable(harness.TestCase):
    FAST = ("--motor-boot", "50ms", "--motor-timeout", "400ms")
    # The simulated board may wait for the processor where other programs want it, too.
    PATIENT = ("--motor-boot", "50ms", "--motor-timeout", "10s")

    def table(self, fault=None):
        table = Table(fault)
        self.addCleanup(table.close)
        return table

    def test_rotate_status_speed_stop(self):
        table = self.table()
        port = ("--port", table.port, *self.FAST)
        self.assertIn("idle", self.ok("turntable", "status", *port).stdout)
        self.ok("turntable", "rotate", *port, "--angle", "-40deg", "--speed", "80deg/s")
        self.assertAlmostEqual(table.angle, -40.0, delta=0.1)
        self.ok("turntable", "speed", *port, "--speed", "60deg/s", "--seconds", "0.5")
        self.assertGreater(table.angle, -30.0)
        self.assertFalse(table.turning())
        self.ok("turntable", "stop", *port)

    def test_ctrl_c_stops_the_table(self):
        table = self.table()
        process = start("turntable", "rotate", "--port", table.port, *self.FAST, "--angle", "180deg",
                        "--speed", "10deg/s", "--quiet")
        while not table.told:
            time.sleep(0.01)
        self.assertTrue(table.turning())
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, CANCELLED)
        self.assertFalse(table.turning())

    def test_sigkill_and_the_table_stops_by_itself(self):
        table = self.table()
        process = start("turntable", "speed", "--port", table.port, *self.FAST, "--quiet")
        while not table.told:
            time.sleep(0.01)
        process.kill()
        process.communicate()
        time.sleep(2.3)
        self.assertFalse(table.turning())

    def test_a_board_that_falls_silent(self):
        table = self.table("silent")
        self.refused(FAILED, "turntable", "speed", "--port", table.port, *self.FAST,
                     says=(table.port, "did not answer"))
        self.assertFalse(table.turning())

    def test_a_port_that_goes_away_while_recording(self):
        table = self.table("gone")
        self.refused(FAILED, "capture", "--device", SMALL + "&realtime=1", "-o", "r", "--motor",
                     table.port, "--speed", "20deg/s", *self.FAST, says=("gone", "switch its power off"))

    def test_capture_with_a_motor(self):
        table = self.table()
        self.ok("capture", "--device", SMALL + "&realtime=1", "-o", "r", "--motor", table.port,
                "--speed", "80deg/s", "--seconds", "1", *TIMED, *self.FAST)
        self.assertTrue(table.told)
        self.assertFalse(table.turning())
        angle = float(frames_of(self.dir / "r")[-1][5])
        self.assertAlmostEqual(angle, 80.0, delta=6.0)

    def test_stop_and_go(self):
        table = self.table()
        self.ok("capture", "--device", SMALL, "-o", "r", "--motor", table.port, "--speed",
                "80deg/s", "--stops", "12", "--turns", "0.25", "--stop-frames", "2", "--settle",
                "50ms", *TIMED, *self.FAST)
        self.assertEqual([line[5] for line in frames_of(self.dir / "r")], ["0", "30", "60"])

    # Two frames a stop: the simulated table has turned by a step meanwhile.
    def stop_and_go(self, table, *more, stops=36, serial=0, more_of_device=""):
        device = (f"virtual:doll?sensor={SENSOR}&calibration=true&fps=30&speed=150deg/s"
                  f"&noise=gaussian:1mm&serial={serial}{more_of_device}")
        return ("capture", "--device", device, "--motor", table.port, "--speed", "90deg/s", *TIMED,
                "--stops", stops, "--stop-frames", "1", "--settle", "0s", *self.PATIENT, *more)

    def end_at(self, frames, signal_number, *args):
        """Ends the capture into the recording r as soon as it has so many frames."""
        process = start(*args, cwd=self.dir)
        while not (table := self.dir / "r" / "frames.csv").exists() or (
                table.read_bytes().count(b"\n") <= frames):
            ended = process.poll()
            self.assertIsNone(ended, ended is not None and process.stderr.read())
            time.sleep(0.002)
        process.send_signal(signal_number)
        process.communicate(timeout=30)

    def test_stops_that_were_cut_short_are_resumed(self):
        table = self.table()
        self.ok(*self.stop_and_go(table, "-o", "whole"))
        whole = {p.relative_to(self.dir / "whole"): p.read_bytes()
                 for p in (self.dir / "whole").rglob("*") if p.suffix in (".png", ".csv")}
        for moments in ((1,), (7,), (20, 31)):
            with self.subTest(moments=moments):
                table = self.table()
                args = self.stop_and_go(table, "-o", "r")
                for k, frames in enumerate(moments):
                    self.end_at(frames, (signal.SIGKILL, signal.SIGTERM)[k % 2], *args)
                    args = self.stop_and_go(table, "--resume", "r")
                self.ok(*args)
                self.assertAlmostEqual(table.angle, 350.0, delta=0.1)
                self.assertEqual({p.relative_to(self.dir / "r"): p.read_bytes()
                                  for p in (self.dir / "r").rglob("*")
                                  if p.suffix in (".png", ".csv")}, whole)
                self.refused(USAGE, *args, says="it is finished")
                if len(moments) > 1:
                    for name in ("whole", "r"):
                        self.ok("reconstruct", name, "-o", f"{name}.ply", *harness.COARSE)
                    self.assertEqual((self.dir / "whole.ply").read_bytes(),
                                     (self.dir / "r.ply").read_bytes())
                shutil.rmtree(self.dir / "r")

    def test_stops_that_are_killed_at_random_moments_are_resumed(self):
        def made(name):
            self.ok("reconstruct", name, "-o", f"{name}.ply", *harness.COARSE)
            return (self.dir / f"{name}.ply").read_bytes()

        self.ok(*self.stop_and_go(self.table(), "-o", "whole"))
        whole = made("whole")
        chance = random.Random(1)
        late = 0
        for kill in range(RESUMES):
            at = chance.randrange(35)
            with self.subTest(kill=kill, at=at):
                table = self.table()
                self.end_at(at, signal.SIGKILL, *self.stop_and_go(table, "-o", "r"))
                time.sleep(chance.uniform(0.0, 0.2))
                # On a busy machine the last stops may be over before the kill.
                if description(self.dir / "r")["complete"]:
                    late += 1
                else:
                    self.ok(*self.stop_and_go(table, "--resume", "r"))
                self.assertEqual(made("r"), whole)
            shutil.rmtree(self.dir / "r")
        print(f"{RESUMES} kills at stops: {RESUMES - late} resumed, {late} when all was recorded", flush=True)

    def test_one_that_was_resumed_and_killed_is_replaced(self):
        table = self.table()
        self.end_at(3, signal.SIGKILL, *self.stop_and_go(table, "-o", "r"))
        self.end_at(9, signal.SIGKILL, *self.stop_and_go(table, "--resume", "r"))
        self.ok("simulate", "builtin:cylinder", "--frames", "3", "--scanner", SENSOR, "-o", "r",
                "--overwrite-unfinished", "--quiet")
        self.assertEqual(len(frames_of(self.dir / "r")), 3)
        self.assertEqual([p.name for p in (self.dir / "r").glob("*.before-repair*")], [])

    def test_stops_of_a_live_sensor_are_resumed_with_the_next_one(self):
        table = self.table()
        args = self.stop_and_go(table, "-o", "r", stops=12, more_of_device="&realtime=1&prepared=30")
        self.end_at(4, signal.SIGKILL, *args)
        resume = self.stop_and_go(table, "--resume", "r", stops=12, more_of_device="&realtime=1&prepared=30")
        # A board that was moved meanwhile knows where it stands.
        self.ok("turntable", "rotate", "--port", table.port, *self.FAST, "--angle", "-50deg")
        self.ok(*resume)
        frames = frames_of(self.dir / "r")
        self.assertEqual([float(line[5]) for line in frames], [30.0 * i for i in range(12)])
        self.assertAlmostEqual(table.angle, 330.0, delta=0.1)
        times = [float(line[1]) for line in frames]
        self.assertEqual(times, sorted(times))
        self.assertNotIn("resumed_at", description(self.dir / "r"))

    def test_what_cannot_be_resumed(self):
        table = self.table()
        self.end_at(3, signal.SIGKILL, *self.stop_and_go(table, "-o", "r"))
        resume = self.stop_and_go(table, "--resume", "r")
        self.refused(USAGE, *resume, "-o", "s", says="either")
        self.refused(USAGE, *self.stop_and_go(table, "--resume", "r", stops=12), says="--stops 36")
        self.refused(USAGE, *self.stop_and_go(table, "--resume", "r", serial=7),
                     says="another device")
        self.refused(FAILED, *self.stop_and_go(table, "--resume", "nowhere"), says="no recording")
        with open(self.dir / "r" / "frames.csv") as frames:
            fcntl.flock(frames, fcntl.LOCK_EX)
            self.refused(FAILED, *resume, says="is being recorded just now")
        self.ok(*resume)

    def test_no_such_port_and_no_such_action(self):
        self.refused(FAILED, "turntable", "status", "--port", "/dev/ttyNONE", says="no such serial")
        self.refused(USAGE, "turntable", "jump", "--port", "/dev/ttyNONE", says="no such action")


if __name__ == "__main__":
    harness.main()
