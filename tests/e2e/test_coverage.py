"""What a scan covers, and every sample with the truth: numbers, files, and that the parts said to be
without samples are those where the recording leaves the reconstruction without points."""

import json
import math
import struct

import harness
from harness import NARROW, USAGE

SIZES = {"float": "f", "uchar": "B", "ushort": "H", "int": "i", "uint": "I"}
COVERED, THIN, MISSED, UNREACHABLE = range(4)


def read_ply(path):
    """Elements of a binary PLY as lists of rows; a row maps property to value, a list to a tuple."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    elements = []
    for words in (line.split() for line in data[:end].decode().splitlines()):
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    out = {}
    for name, count, properties in elements:
        # The only lists here are triangles.
        row = struct.Struct("<" + "".join(
            "B3i" if p[0] == "list" else SIZES[p[0]] for p in properties))
        names = [p[-1] for p in properties]
        rows = []
        for i in range(count):
            values = row.unpack_from(data, end + i * row.size)
            if properties[0][0] == "list":
                values = (values[1:4],) + values[4:]
            rows.append(dict(zip(names, values)))
        end += count * row.size
        out[name] = rows
    assert end == len(data)
    return out


def triangle(ply, face):
    return [tuple(ply["vertex"][i][k] for k in "xyz") for i in face["vertex_indices"]]


def area(corners):
    a, b, c = corners
    u = [y - x for x, y in zip(a, b)]
    w = [y - x for x, y in zip(a, c)]
    n = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
    return 0.5 * math.sqrt(sum(x * x for x in n))


class Near:
    """Whether any of the points is within r."""

    def __init__(self, points, r):
        self.r, self.cells = r, {}
        for p in points:
            self.cells.setdefault(tuple(math.floor(x / r) for x in p), []).append(p)

    def __call__(self, q):
        k = [math.floor(x / self.r) for x in q]
        return any(math.dist(p, q) <= self.r
                   for i in (-1, 0, 1) for j in (-1, 0, 1) for l in (-1, 0, 1)
                   for p in self.cells.get((k[0] + i, k[1] + j, k[2] + l), ()))


class Coverage(harness.TestCase):
    def test_a_cylinder_is_covered_but_for_its_underside(self):
        out = self.ok("simulate", "builtin:cylinder", "--frames", "60", *NARROW, "--noise", "none",
                      "--coverage", "c.ply").stdout
        self.assertIn("Covered: ", out)
        self.assertIn("unreachable", out)
        self.assertEqual(self.files(), ["c.json", "c.ply"])
        summary = json.loads((self.dir / "c.json").read_text())
        underside, all_of_it = math.pi * 0.04**2, math.pi * (2 * 0.04**2 + 0.08 * 0.16)
        self.assertAlmostEqual(summary["area_m2"], all_of_it, delta=1e-4)
        self.assertAlmostEqual(summary["covered"], 1 - underside / all_of_it, delta=0.01)
        self.assertGreater(summary["covered_of_reachable"], 0.999)
        hole = summary["holes"][0]
        self.assertAlmostEqual(hole["area_m2"], underside, delta=3e-4)
        self.assertEqual(hole["reason"], "receiver-blocked")
        ply = read_ply(self.dir / "c.ply")
        self.assertEqual(sum(f["samples"] for f in ply["face"]), summary["samples"])
        info = json.loads(self.ok("info", "c.ply", "--json").stdout)
        self.assertEqual(info["objects"][0]["triangles"], len(ply["face"]))

    def test_what_is_not_covered_is_where_the_reconstruction_has_no_points(self):
        for name, frames, least_without in (("doll", "36", 0.08), ("letter-a", "24", 0.02)):
            with self.subTest(name):
                self.agrees(name, frames, least_without)

    def agrees(self, name, frames, least_without):
        rec = "rec-" + name
        self.ok("simulate", "builtin:" + name, "--frames", frames, *NARROW, "--noise", "none", "--out", rec,
                "--coverage", "c.ply", "--quiet")
        self.ok("reconstruct", rec, "-o", "m.ply", "--method", "poisson", "--no-base",
                "--save-stage", "candidates=points.ply", "--quiet")
        points = read_ply(self.dir / "points.ply")["vertex"]
        near = Near([(p["x"], p["y"], p["z"]) for p in points], 0.002)
        ply = read_ply(self.dir / "c.ply")
        patches = []
        for face in ply["face"]:
            corners = triangle(ply, face)
            patches.append((face["state"], [sum(x) / 3 for x in zip(*corners)], area(corners)))
        seen = Near([c for state, c, _ in patches if state in (COVERED, THIN)], 0.004)
        covered, without = [0.0, 0.0], [0.0, 0.0]  # area, and that with points
        for state, center, a in patches:
            # Holes count without their rim.
            if state == THIN or (state != COVERED and seen(center)):
                continue
            share = covered if state == COVERED else without
            share[0] += a
            share[1] += a if near(center) else 0.0
        # The crop cuts the lowest millimetres off.
        self.assertGreater(covered[1], 0.97 * covered[0])
        self.assertGreater(without[0], least_without * sum(a for _, _, a in patches))
        self.assertLess(without[1], 0.01 * without[0])

    def test_two_passes_together_cover_what_one_cannot_reach(self):
        one, two = ["simulate", "builtin:cylinder", "--frames", "20", *NARROW, "--coverage"], [
            "--next-pass", "tip=180deg,object-x=15mm"]
        self.ok(*one, "one.ply")
        self.ok(*one, "two.ply", *two)
        one, two = (json.loads((self.dir / f"{n}.json").read_text()) for n in ("one", "two"))
        self.assertGreater(one["state_m2"]["unreachable"], 0.9 * math.pi * 0.04**2)
        self.assertEqual(two["state_m2"]["unreachable"], 0)
        self.assertGreater(two["covered"], 0.999)
        self.assertGreater(two["samples"], 1.9 * one["samples"])

    def test_coverage_is_the_same_for_every_number_of_threads(self):
        for n in ("1", "3"):
            self.ok("simulate", "builtin:letter-a", "--frames", "20", "--coverage", f"{n}.ply",
                    "--threads", n)
        self.assertEqual((self.dir / "1.ply").read_bytes(), (self.dir / "3.ply").read_bytes())
        self.assertEqual((self.dir / "1.json").read_bytes(), (self.dir / "3.json").read_bytes())

    def test_without_a_place_to_write_to_nothing_is_done(self):
        for args in ((), ("--samples", "--coverage", "c.ply"), ("--coverage", "c.stl"),
                     ("--coverage", "c.ply", "--coverage-cell", "0mm")):
            self.refused(USAGE, "simulate", "builtin:cylinder", "--frames", "3", *args)
            self.assertEqual(self.files(), [])

    def test_samples_tell_what_was_there_to_see_and_why_it_is_missing(self):
        self.ok("simulate", "builtin:cylinder", "--frames", "4", *NARROW, "--noise", "none", "--samples",
                "--out", "rec", "--quiet")
        files = sorted(p.name for p in (self.dir / "rec/truth/samples").iterdir())
        self.assertEqual(files, [f"{i:06}.ply" for i in range(4)])
        reasons = set()
        for name in files:
            for s in read_ply(self.dir / "rec/truth/samples" / name)["vertex"]:
                reasons.add(s["reason"])
                self.assertEqual(s["measured"] > 0, s["reason"] == 0)
                if s["reason"] == 0:
                    self.assertAlmostEqual(s["measured"], s["depth"], delta=1e-6)
                if s["object"] != 0 or s["y"] > 0.159 or s["y"] < 0.001:
                    continue
                self.assertAlmostEqual(math.hypot(s["x"], s["z"]), 0.04, delta=5e-6)
                self.assertAlmostEqual(s["ny"], 0.0, delta=1e-5)
                self.assertLess(s["incidence_deg"], 90.0)
        self.assertIn(0, reasons)
        self.assertIn(5, reasons)  # the emitter is blocked


if __name__ == "__main__":
    harness.main()
