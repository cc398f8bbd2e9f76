"""What the end-to-end tests share: running the program as a user does, and small test data.

The program is the one that TURNSCAN_BIN names (CTest sets it to the built one; set it by hand to
test an installed one), or `turnscan` on the PATH. Python's standard library only.
"""

import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import leaks

BIN = os.environ.get("TURNSCAN_BIN", "turnscan")
ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("TURNSCAN_TEST_DATA", ROOT.parent / "shared" / "data"))
HANG_S = 300  # a run that takes longer hangs
PART = os.environ.get("TURNSCAN_TEST_PART", "0/1")  # "0/3": the first of three processes that share the tests

FAILED, USAGE, CANCELLED = 1, 2, 130
FAST = ("--voxel-size", "6mm", "--poisson-depth", "5")  # where the mesh itself does not matter
COARSE = ("--voxel-size", "2.5mm")  # where the mesh matters, but not its finest detail
SENSOR = pathlib.Path(__file__).with_name("narrow.toml")  # of few pixels, for tests in which the mesh matters
NARROW = ("--scanner", SENSOR)
SMALL_PICTURE = ("--picture-size", "96")  # a large one takes longer than all else that a demo does


def default_signals():
    # A test that was started in the background must not pass on that SIGINT is ignored.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


def start(*args, cwd=None, env=None, **more):
    """The program, running."""
    return subprocess.Popen(
        [BIN, *map(str, args)], cwd=cwd, env={**os.environ, **(env or {})},
        stdin=subprocess.DEVNULL, text=True, preexec_fn=default_signals,
        **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **more})


def run(*args, says_nan=False, **more):
    """Runs the program to its end and returns a CompletedProcess.

    What it says and writes holds no figure that is none (see leaks.py), unless says_nan allows it
    to quote an input that does.
    """
    begun_ns = time.time_ns()
    process = start(*args, **more)
    try:
        out, err = process.communicate(timeout=HANG_S)
    except subprocess.TimeoutExpired:
        process.kill()
        raise AssertionError(f"turnscan {' '.join(map(str, args))} hangs")
    leaks_found = [] if says_nan else leaks.of_run(args, more.get("cwd"), begun_ns, out, err)
    if leaks_found:
        raise AssertionError(f"turnscan {' '.join(map(str, args))}\n" + "\n".join(leaks_found))
    return subprocess.CompletedProcess(args, process.returncode, out, err)


class TestCase(unittest.TestCase):
    """Each test works in an empty folder of its own, self.dir."""

    def setUp(self):
        self.dir = pathlib.Path(tempfile.mkdtemp(prefix="turnscan-e2e-"))
        self.addCleanup(remove, self.dir)

    def ok(self, *args, **more):
        result = run(*args, cwd=self.dir, **more)
        self.assertEqual(result.returncode, 0, f"{args}\n{result.stdout}\n{result.stderr}")
        return result

    def refused(self, code, *args, says=(), **more):
        """The run fails with this exit code and one line on standard error that contains `says`."""
        result = run(*args, "--quiet", cwd=self.dir, **more)
        self.assertEqual(result.returncode, code, f"{args}\n{result.stdout}\n{result.stderr}")
        self.assert_one_line_error(result.stderr, args)
        for words in (says,) if isinstance(says, str) else says:
            self.assertIn(words, result.stderr)
        return result

    def assert_one_line_error(self, err, args=()):
        self.assertTrue(err.startswith("turnscan: "), f"{args}: {err!r}")
        self.assertEqual(err.count("\n"), 1, f"{args}: {err!r}")
        self.assertTrue(err.endswith("\n"), f"{args}: {err!r}")
        self.assertIn("; ", err, f"{args}: the line does not say what to do: {err!r}")

    def files(self):
        """Every path below self.dir, hidden and temporary ones included."""
        return sorted(str(p.relative_to(self.dir)) for p in self.dir.rglob("*"))


def remove(folder):
    for path in [folder, *folder.rglob("*")]:
        if path.is_dir() and not path.is_symlink():
            path.chmod(0o700)
    shutil.rmtree(folder, ignore_errors=True)


def png16(width, height, value, behind=0):
    """A grey 16-bit PNG of one value, with so many zeros behind its rows."""
    def chunk(kind, body):
        return (struct.pack(">I", len(body)) + kind + body +
                struct.pack(">I", zlib.crc32(kind + body)))
    row = b"\0" + struct.pack(">H", value) * width
    packer = zlib.compressobj()
    rows = packer.compress(row * height)
    for at in range(0, behind, 1 << 20):
        rows += packer.compress(bytes(min(1 << 20, behind - at)))
    rows += packer.flush()
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
            chunk(b"IDAT", rows) + chunk(b"IEND", b""))


def foreign_scan(folder):
    """Three small depth images of a wall in the frame-N.depth.png layout, in a new folder."""
    folder.mkdir()
    (folder / "camera-intrinsics.txt").write_text("100 0 16\n0 100 12\n0 0 1\n")
    for i in range(3):
        (folder / f"frame-{i:06}.depth.png").write_bytes(png16(32, 24, 1000))
        (folder / f"frame-{i:06}.pose.txt").write_text(
            f"1 0 0 {i / 10}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
    return folder


def ply_cube(size, hole=False):
    """ASCII PLY of an axis-aligned cube that stands on y = 0, closed unless hole."""
    h = size / 2
    vertices = [(x, y + h, z) for x in (-h, h) for y in (-h, h) for z in (-h, h)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    if hole:
        quads.pop()
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}", "property float x",
             "property float y", "property float z", f"element face {len(quads)}",
             "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, v)) for v in vertices]
    lines += ["4 " + " ".join(map(str, q)) for q in quads]
    return "\n".join(lines) + "\n"


def _tests_of(suite):
    for one in suite:
        if isinstance(one, unittest.TestSuite):
            yield from _tests_of(one)
        else:
            yield one


def part_of(tests):
    """Every n-th: those of one of the n processes that share the tests of a file."""
    part, parts = map(int, PART.split("/"))
    return list(tests)[part::parts]


def main():
    sys.modules["__main__"].load_tests = (
        lambda loader, suite, pattern: unittest.TestSuite(part_of(_tests_of(suite))))
    unittest.main(module="__main__", verbosity=2, argv=[sys.argv[0], *sys.argv[1:]])
