#!/usr/bin/env python3
"""scripts/thesis on few frames: the doll of table 6.1 and the coverage of the scanners are those of
thesis.json within 5 %.

    TURNSCAN_BIN=... python3 tests/e2e/test_thesis.py keep     writes thesis.json anew
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import harness

STORED = pathlib.Path(__file__).with_name("thesis.json")
FRAMES = 46
WITHIN = 0.05
LEFT_OUT = {"seconds", "total_s"}  # of the machine


def figures(out):
    done = subprocess.run([sys.executable, "-B", harness.ROOT / "scripts" / "thesis", "--frames", str(FRAMES),
                           "--objects", "doll",
                           "--out", out, "--steps", "record", "table61", "coverage"], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads((out / "figures.json").read_text())


def leaves(value, path=""):
    """The numbers in it, by their path."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in LEFT_OUT:
                yield from leaves(inner, f"{path}/{key}")
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from leaves(inner, f"{path}/{index}")
    else:
        yield path, value


class Thesis(harness.TestCase):
    def test_figures_by_few_frames_are_those_that_are_stored(self):
        stored, made = dict(leaves(json.loads(STORED.read_text()))), dict(leaves(figures(self.dir)))
        self.assertEqual(stored.keys(), made.keys())
        for path, value in stored.items():
            # Shares of less than a percent have few digits.
            self.assertAlmostEqual(made[path], value, delta=max(WITHIN * abs(value), 0.01), msg=path)


def kept(value):
    """Without what is left out, to four digits."""
    if isinstance(value, dict):
        return {key: kept(inner) for key, inner in value.items() if key not in LEFT_OUT}
    return float(f"{value:.4g}") if isinstance(value, float) else value


if __name__ == "__main__":
    if sys.argv[1:] == ["keep"]:
        with tempfile.TemporaryDirectory() as folder:
            STORED.write_text(json.dumps(kept(figures(pathlib.Path(folder))), indent=1) + "\n")
    else:
        harness.main()
