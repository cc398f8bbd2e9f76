"""Ctrl-C at every phase: exit code 130, one line, and nothing half-written."""

import os
import pathlib
import re
import signal
import subprocess
import time

import harness
from harness import CANCELLED, COARSE, FAST, HANG_S, NARROW, ROOT, SENSOR, SMALL_PICTURE, ply_cube, start
from recordings import shared_recording

PERCENTAGE = re.compile(r"^ *\d+ % ")
STOP_S = 5.0  # a second is promised; the rest is for machines that are busy with other things


def phases_of(err):
    """Phases in the order in which the progress lines announced them."""
    return [PERCENTAGE.sub("", line) for line in err.splitlines() if line and ":" not in line]


class Cancel(harness.TestCase):
    def stop_at(self, phase, number, args, delay=0.0, stop_signal=signal.SIGINT):
        """Starts the program and stops it when the given phase begins for the n-th time. Returns
        (exit code, seconds from the signal to the end), or None if it had ended before."""
        process = start(*args, cwd=self.dir)
        seen = []
        for line in process.stderr:
            seen.append(line)
            if phase is None or phases_of("".join(seen)).count(phase) == number:
                break
        time.sleep(delay)
        process.send_signal(stop_signal)
        begin = time.monotonic()
        _, err = process.communicate(timeout=HANG_S)
        if process.returncode == 0:
            return None
        self.assertEqual(process.returncode, CANCELLED, f"{phase}: {''.join(seen)}{err}")
        self.assertIn("cancelled", err.splitlines()[-1])
        return time.monotonic() - begin

    def every_phase(self, args, made=(), kept=()):
        """kept: files that may be there already; then they are whole."""
        done = self.ok(*args)
        whole = {name: (self.dir / name).read_bytes() for name in kept}
        for name in made:
            target = self.dir / name
            harness.remove(target) if target.is_dir() else target.unlink()
        before = self.files()
        phases = phases_of(done.stderr)
        self.assertGreater(len(phases), 0, done.stderr)
        slowest = 0.0
        for i, phase in enumerate(phases):
            seconds = self.stop_at(phase, phases[:i + 1].count(phase), args)
            if seconds is None:  # the run was faster than the signal
                for name in made:
                    target = self.dir / name
                    harness.remove(target) if target.is_dir() else target.unlink(missing_ok=True)
                continue
            slowest = max(slowest, seconds)
            self.assertLess(seconds, STOP_S, phase)
            for name in kept:
                target = self.dir / name
                if target.exists():
                    self.assertEqual(target.read_bytes(), whole[name], f"stopped in '{phase}'")
                    target.unlink()
            self.assertEqual(self.files(), before, f"left behind when stopped in '{phase}'")
        print(f"{args[0]}: stopped in {len(phases)} phases, slowest {slowest:.2f} s", flush=True)

    def test_reconstruct(self):
        self.every_phase(("reconstruct", shared_recording(), "-o", "m.3mf", "--report", "r.json",
                          *COARSE, "--save-stage", "fitted"), made=["m.3mf", "r.json", "m-fitted.ply"],
                         kept=["m.3mf"])

    def test_reconstruct_from_points(self):
        self.every_phase(("reconstruct", shared_recording(), "-o", "m.3mf", "--method", "poisson",
                          *FAST, "--save-stage", "merged"), made=["m.3mf", "m-merged.ply"],
                         kept=["m.3mf"])

    def test_demo(self):
        self.every_phase(("demo", "--object", "cylinder", "--frames", "24", *NARROW, *SMALL_PICTURE, "--out", "d"),
                         made=["d"])

    def test_render(self):
        (self.dir / "a.ply").write_text(ply_cube(0.1))
        self.every_phase(("render", "a.ply", "-o", "p.png", "--picture-width", "1200", "--picture-height", "1200"),
                         made=["p.png"])

    def test_evaluate(self):
        (self.dir / "a.ply").write_text(ply_cube(0.1))
        self.every_phase(("evaluate", "a.ply", "--reference", "a.ply", "--json", "e.json"),
                         made=["e.json"])

    def test_sigterm_is_the_same(self):
        args = ("demo", "--object", "cylinder", "--frames", "900", "--out", "d")
        seconds = self.stop_at(None, 0, args, delay=0.5, stop_signal=signal.SIGTERM)
        self.assertLess(seconds, STOP_S)
        self.assertEqual(self.files(), [])

    def test_a_scan_stops_while_it_looks_for_the_speed(self):
        """Its thread does; the frames of a source that waits stand still meanwhile: after 4 s of
        them, and after half a turn."""
        for frames in (0, 118, 455):
            with self.subTest(frames=frames):
                process = start("scan", "--device", f"virtual:doll?sensor={SENSOR}", "-o", "m.ply",
                                "--no-wait", "--min-free", "0", "--quiet", cwd=self.dir)
                table = self.dir / "m.recording" / "frames.csv"
                while frames and not (table.exists() and table.read_bytes().count(b"\n") > frames):
                    self.assertIsNone(process.poll())
                    time.sleep(0.005)
                time.sleep(0.5)
                before = sum(map(int, pathlib.Path(f"/proc/{process.pid}/stat").read_text()
                                 .rpartition(")")[2].split()[11:13])) / os.sysconf("SC_CLK_TCK")
                process.send_signal(signal.SIGTERM)
                _, status, used = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                process.communicate()
                self.assertEqual(process.returncode, CANCELLED)
                # Of the processor, whose other work is not counted.
                self.assertLess(used.ru_utime + used.ru_stime - before, 0.5)
                harness.remove(self.dir / "m.recording")

    def test_the_second_ctrl_c_ends_at_once(self):
        process = start("demo", "--object", "cylinder", "--frames", "900", "--out", "d",
                        cwd=self.dir)
        process.stderr.readline()
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=HANG_S), CANCELLED)
        process.communicate()

    def test_a_ctrl_c_of_the_terminal_reaches_children_through_their_parent_only(self):
        """A terminal signals the whole group: the child must not die first and be taken for a
        failed library."""
        args = ("reconstruct", str(shared_recording()), "-o", "m.ply", "--method", "poisson",
                "--poisson-depth", "12", "--voxel-size", "0.7mm")
        process = start(*args, cwd=self.dir, start_new_session=True)
        lines = []
        for line in process.stderr:
            lines.append(line)
            if phases_of(line) == ["surface"]:
                break
        time.sleep(0.2)
        os.killpg(process.pid, signal.SIGINT)
        _, err = process.communicate(timeout=HANG_S)
        self.assertEqual(process.returncode, CANCELLED, "".join(lines) + err)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    harness.main()
