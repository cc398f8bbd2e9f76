"""A few of the recordings that scripts/random-recordings makes; that runs 200 of them."""

import os
import subprocess
import sys

import harness

COUNT = 6


class Random(harness.TestCase):
    def test_every_mesh_of_a_random_recording_is_closed_manifold_and_outward(self):
        script = harness.ROOT / "scripts" / "random-recordings"
        done = subprocess.run([sys.executable, str(script), "--count", str(COUNT)],
                              env={**os.environ, "TURNSCAN_BIN": harness.BIN}, text=True,
                              capture_output=True, timeout=harness.HANG_S)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout.splitlines()[-1], rf"{COUNT} recordings: [1-9].* 0 wrong")

    def test_the_checker_sees_what_is_wrong(self):
        source = (harness.ROOT / "scripts" / "random-recordings").read_text()
        checker = {"__name__": "checker"}
        exec(compile(source, "random-recordings", "exec"), checker)
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        solid = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
        faults = checker["faults"]
        self.assertEqual(faults(points, solid), [])
        self.assertTrue(faults(points, solid[1:]))
        self.assertTrue(faults(points, [(a, c, b) for a, b, c in solid]))
        self.assertTrue(faults(points, [(0, 1, 2), *solid[1:]]))
        self.assertTrue(faults(points, [*solid, (0, 1, 1)]))
        # Two solids that share a vertex.
        more = points + [(-1, 0, 0), (0, -1, 0), (0, 0, -1)]
        other = [(0, 5, 4), (0, 4, 6), (4, 5, 6), (5, 0, 6)]
        other = [(a, c, b) for a, b, c in other]
        self.assertTrue(faults(more, solid + other))


if __name__ == "__main__":
    harness.main()
