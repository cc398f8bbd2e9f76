"""One percentage for a whole command: it never falls, and ends at 100."""

import os
import pty
import re

import harness
from harness import COARSE, FAST, HANG_S, NARROW, SENSOR, SMALL_PICTURE, run, start
from recordings import mesh_of, shared_recording

LINE = re.compile(r"^ *(\d+) % (.+)", re.S)


class Lines(harness.TestCase):
    def test_no_line_has_marks_of_a_terminal(self):
        err = self.ok("demo", "--object", "cylinder", "--frames", "24", *NARROW, *SMALL_PICTURE, "--out",
                      "d").stderr
        self.assertNotIn("\r", err)
        self.assertNotIn("\033", err)

    def ok(self, *args):
        # Calibrations are kept in a home of the test's own.
        return super().ok(*args, env={"XDG_STATE_HOME": str(self.dir / "state")})

    def progress(self, *args, waits=()):
        """(percentage, phase) of each line, of a run that succeeds. Phases without a percentage are
        those that wait for something outside."""
        lines = self.ok(*args).stderr.splitlines()
        without = {line.split(":")[0] for line in lines if not LINE.match(line)}
        self.assertLessEqual(without, set(waits), lines)
        parts = [(int(m[1]), m[2]) for m in map(LINE.match, lines) if m]
        percentages = [p for p, _ in parts]
        self.assertEqual(percentages, sorted(percentages), lines)
        self.assertLess(percentages[0], 20, lines)
        self.assertEqual(percentages[-1], 100, lines)
        self.assertEqual(percentages.count(100), 1, lines)
        self.assertTrue(parts[-1][1].startswith("done: "), lines)
        return parts

    def test_reconstruct(self):
        for options in (COARSE, (*FAST, "--method", "poisson")):
            self.progress("reconstruct", shared_recording(), "-o", "m.3mf", *options)

    def test_a_page_belongs_to_the_whole(self):
        parts = self.progress("reconstruct", shared_recording(), "-o", "m.ply", *COARSE,
                              "--report", "page.html")
        self.assertIn("page", [phase for _, phase in parts])

    def test_simulate(self):
        self.progress("simulate", "builtin:cylinder", "--frames", "20", *NARROW, "-o", "recording")
        self.progress("simulate", "builtin:cylinder", "--frames", "20", *NARROW, "--coverage", "seen.ply")

    def test_demo_of_one_object(self):
        self.progress("demo", "--object", "cylinder", "--frames", "24", *NARROW, *SMALL_PICTURE, *COARSE,
                      "-o", "d")

    def test_evaluate(self):
        mesh = shared_recording() / "truth/object.ply"
        self.progress("evaluate", mesh, "--reference", mesh, "--align", "icp",
                      "--error-map", "e.ply")

    def test_batch(self):
        self.progress("batch", "run", shared_recording(), "--out", "b", "--sweep",
                      "voxel-size=4mm,6mm", waits=["plan", "look for what is done"])

    def test_scan_has_no_percentage_while_it_waits_for_an_object(self):
        self.progress("scan", "--device", f"virtual:{mesh_of('doll')}?sensor={SENSOR}&fps=6&speed=12deg/s",
                      "-o", "m.ply", "--voxel-size", "3mm", "--min-free", "0", waits=["open device", "look for the turntable",
                                      "wait for an object on the platter"])


class Terminal(harness.TestCase):
    def test_the_bar_never_falls_and_is_removed_at_the_end(self):
        master, slave = pty.openpty()
        # A small picture is done before the bar is drawn again, and it ends with whatever it showed before.
        process = start("demo", "--object", "cylinder", "--frames", "60", *NARROW, "--picture-size", "320", "--out",
                        "d", cwd=self.dir, stderr=slave)
        os.close(slave)
        shown = b""
        while True:
            try:
                piece = os.read(master, 65536)
            except OSError:  # Linux reports the end of a terminal as an error
                break
            if not piece:
                break
            shown += piece
        process.communicate(timeout=HANG_S)
        os.close(master)
        self.assertEqual(process.returncode, 0)
        self.assertRegex(shown, rb"\[#+-*\]")
        self.assertTrue(shown.endswith(b"\r\033[K"), "the bar is removed at the end")
        drawn = shown.decode().split("\r")
        percentages = [int(m[1]) for m in map(LINE.match, drawn) if m]
        self.assertGreater(len(percentages), 3, drawn)
        self.assertEqual(percentages, sorted(percentages), drawn)
        self.assertGreater(percentages[-1], 80, drawn)
        self.assertLess(percentages[-1], 100, drawn)


class Quiet(harness.TestCase):
    def test_nothing_is_shown(self):
        self.assertEqual(self.ok("info", shared_recording(), "--quiet").stderr, "")

    def test_a_run_that_fails_is_never_at_100(self):
        result = run("reconstruct", shared_recording(), "-o", self.dir / "m.ply", "--voxel-size",
                     "6mm", "--crop-height", "1um")
        self.assertNotEqual(result.returncode, 0)
        self.assertNotIn("100 %", result.stderr)


if __name__ == "__main__":
    harness.main()
