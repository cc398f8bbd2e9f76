"""What the commands give: meshes in every format and unit, reports, saved stages, the same bytes
for every number of threads, and files that say the same as flags."""

import json
import struct
import zipfile
from xml.etree import ElementTree

import harness
from harness import COARSE, FAILED, FAST, NARROW, SMALL_PICTURE, USAGE, ply_cube
from recordings import shared_demo, shared_recording


def stl_box_mm(path):
    """Lowest and highest coordinates, as a slicer reads them."""
    data = path.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    assert len(data) == 84 + 50 * count
    corners = [struct.unpack_from("<3f", data, 84 + 50 * t + 12 * (1 + v))
               for t in range(count) for v in range(3)]
    return box_of(corners)


def box_of(points):
    return [(min(p[i] for p in points), max(p[i] for p in points)) for i in range(3)]


def threemf_box_mm(path):
    """The same of all items of a 3MF's build, each where its transform puts it."""
    space = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    with zipfile.ZipFile(path) as package:
        name = next(n for n in package.namelist() if n.endswith(".model"))
        model = ElementTree.fromstring(package.read(name))
    assert model.get("unit") == "millimeter"
    objects = {o.get("id"): [[float(v.get(a)) for a in "xyz"] for v in o.iter(f"{space}vertex")]
               for o in model.iter(f"{space}object")}
    points = []
    for item in model.iter(f"{space}item"):
        m = [float(n) for n in item.get("transform", "1 0 0 0 1 0 0 0 1 0 0 0").split()]
        points += [[sum(p[k] * m[3 * k + i] for k in range(3)) + m[9 + i] for i in range(3)]
                   for p in objects[item.get("objectid")]]
    return box_of(points)


def coloured_blocks(*blocks):
    """PLY of upright blocks: (x, z, half a side, lowest and highest y in mm, grey)."""
    vertices, faces = [], []
    for at_x, at_z, half, low, high, grey in blocks:
        first = len(vertices)
        vertices += [((at_x + x * half) / 1e3, y / 1e3, (at_z + z * half) / 1e3, grey)
                     for x in (-1, 1) for y in (low, high) for z in (-1, 1)]
        faces += [[first + i for i in quad] for quad in
                  ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                   (1, 5, 7, 3))]
    header = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}",
              *(f"property float {a}" for a in "xyz"),
              *(f"property uchar {c}" for c in ("red", "green", "blue")),
              f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    rows = [f"{x} {y} {z} {g} {g} {g}" for x, y, z, g in vertices]
    return "\n".join(header + rows + [f"4 {' '.join(map(str, f))}" for f in faces]) + "\n"


class Reconstruct(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.rec = str(shared_recording())

    def test_every_method_gives_a_watertight_mesh_of_the_right_size_and_the_default_is_volumetric(self):
        out = self.ok("reconstruct", self.rec, "-o", "m.ply").stdout
        self.assertIn("Wrote m.ply", out)
        self.assertIn("voxel-size", out)
        self.assertEqual(self.files(), ["m.ply"])
        self.assertIn("watertight", self.ok("info", "m.ply").stdout)
        for method in ("volumetric", "poisson", "concave-hull"):
            self.ok("reconstruct", self.rec, "-o", f"{method}.ply", "--method", method, "--report",
                    f"{method}.json")
            mesh, = json.loads(self.ok("info", f"{method}.ply", "--json").stdout)["objects"]
            self.assertTrue(mesh["watertight"], method)
            for size, truth in zip(mesh["size_m"], (0.08, 0.16, 0.08)):
                self.assertAlmostEqual(size, truth, delta=0.003 if method == "volumetric" else 0.008)
        self.assertEqual((self.dir / "m.ply").read_bytes(),
                         (self.dir / "volumetric.ply").read_bytes())
        # Counts, reasons, times and checks.
        for method, words in (("volumetric", ()), ("poisson", ("candidates",))):
            report = (self.dir / f"{method}.json").read_text()
            json.loads(report)
            for word in ("frames", "points", "vertices", "triangles", "reason", "seconds", "memory",
                         "watertight", "version", *words):
                self.assertIn(word, report)

    def test_a_black_band_before_a_wall_is_joined_and_named(self):
        # A black post between two blocks, one above the other.
        (self.dir / "figure.ply").write_text(coloured_blocks(
            (0, 0, 30, 0, 60, 200), (0, 0, 15, 60, 90, 2), (0, 0, 25, 90, 130, 200)))
        self.ok("simulate", "figure.ply", "--noise", "physics", "--room", "wall", "--frames", "36",
                "--distance", "0.7m", "--elevation", "20deg", "--seed", "3", "--out", "rec")
        out = self.ok("reconstruct", "rec", "-o", "m.ply", "--report", "r.json").stdout
        self.assertIn("too dark, too shiny or transparent", out)
        self.assertIn("Wrote m.ply", out)  # one object
        (figure,) = json.loads((self.dir / "r.json").read_text())["objects"]
        self.assertEqual(figure["mesh"]["components"], 1)
        self.assertTrue(figure["mesh"]["watertight"])
        self.assertTrue(any("too dark" in note for note in figure["notes"]))
        # 60 x 60 x 60, 30 x 30 x 30 and 50 x 50 x 40 mm; the hull of the post is wider than the post
        self.assertAlmostEqual(figure["mesh"]["volume_cm3"], 343, delta=24)
        self.assertGreater(figure["invented_area_cm2"], 20)

    def test_things_that_touch_are_one_with_a_note_and_apart_they_are_two(self):
        for name, z, apart in (("touch", 50, 0), ("apart", 50, 12)):
            (self.dir / f"{name}.ply").write_text(coloured_blocks(
                (-30 - apart / 2, -z / 2, 30, 0, 70, 200), (30 + apart / 2, z / 2, 30, 0, 90, 200)))
            self.ok("simulate", f"{name}.ply", *NARROW, "--frames", "36", "--distance", "0.8m",
                    "--elevation", "20deg", "--noise", "gaussian:0.5mm", "--seed", "3", "--out", f"rec-{name}")
            out = self.ok("reconstruct", f"rec-{name}", "-o", f"m-{name}.ply", "--report",
                          f"{name}.json").stdout
            objects = json.loads((self.dir / f"{name}.json").read_text())["objects"]
            notes = [note for o in objects for note in o["notes"] if "that touch" in note]
            self.assertEqual(len(objects), 2 if apart else 1)
            self.assertEqual(len(notes), 0 if apart else 1, notes)
            self.assertEqual("two objects that touch" in out, not apart)

    def test_every_format_and_orientation_holds_the_same_mesh_at_the_same_distance_from_the_truth(self):
        truth = shared_recording() / "truth/object.ply"
        meshes, figures = set(), {}
        for ending, *up in (("ply",), ("ply", "--up", "z"), ("obj",), ("obj", "--up", "z"),
                            ("stl",), ("stl", "--up", "y"), ("3mf",), ("3mf", "--up", "y"),
                            ("glb",)):
            name = f"{''.join(up[1:])}m.{ending}"
            self.ok("reconstruct", self.rec, *COARSE, "-o", name, *up)
            info, = json.loads(self.ok("info", name, "--json").stdout)["objects"]
            self.assertTrue(info["watertight"], name)
            meshes.add((info["triangles"], *(round(s, 5) for s in info["size_m"])))
            self.ok("evaluate", name, "--reference", truth, "--samples", "20000", "--json", "e.json")
            found = json.loads((self.dir / "e.json").read_text())
            figures[name] = [found[f][s] for f in ("accuracy", "completeness")
                             for s in ("mean_m", "p95_m", "max_m")]
        self.assertEqual(len(meshes), 1, meshes)
        for name, values in figures.items():
            for value, plain in zip(values, figures["m.ply"]):
                self.assertAlmostEqual(value, plain, delta=2e-6, msg=name)
        # For printers: in millimetres, z up, and on zero.
        for name, box in (("m.stl", stl_box_mm), ("m.3mf", threemf_box_mm)):
            sides = box(self.dir / name)
            for (low, high), size in zip(sides, (80, 80, 160)):
                self.assertAlmostEqual(high - low, size, delta=3)
            self.assertEqual(sides[2][0], 0, name)
        _, (low, high), _ = stl_box_mm(self.dir / "ym.stl")
        self.assertAlmostEqual(high - low, 160, delta=3)
        # The orientation is a key, too.
        (self.dir / "o.toml").write_text("[mesh-file]\nup = 'y'\n")
        self.ok("reconstruct", self.rec, *COARSE, "-o", "key.stl", "--config", "o.toml")
        self.assertEqual((self.dir / "key.stl").read_bytes(), (self.dir / "ym.stl").read_bytes())
        # A mesh for printers may be the reference or the object.
        self.ok("evaluate", "m.stl", "--reference", "m.stl", "--json", "e.json")
        self.assertLess(json.loads((self.dir / "e.json").read_text())["accuracy"]["max_m"], 1e-7)
        self.ok("simulate", "m.stl", *NARROW, "--frames", "2", "--out", "rec")
        info = json.loads(self.ok("info", "rec/truth/object.ply", "--json").stdout)["objects"][0]
        self.assertAlmostEqual(info["size_m"][1], 0.16, delta=0.003)

    def test_glb_is_y_up_by_its_standard(self):
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.glb", "--up", "z",
                     says="y up by its standard")
        self.refused(USAGE, "scan", "--device", "virtual:doll", "-o", "m.glb", "--up", "z",
                     says="y up by its standard")
        self.assertEqual(self.files(), [])

    def test_the_number_of_threads_does_not_change_a_byte(self):
        for threads in (1, 2):
            self.ok("reconstruct", self.rec, *COARSE, "-o", f"v{threads}.ply", "--threads", threads)
            self.ok("reconstruct", self.rec, *COARSE, "-o", f"m{threads}.ply", "--threads", threads,
                    "--method", "poisson", "--save-stage", f"candidates=c{threads}.ply")
        for name in ("v", "m", "c"):
            self.assertEqual((self.dir / f"{name}1.ply").read_bytes(),
                             (self.dir / f"{name}2.ply").read_bytes(), name)

    def test_a_toml_file_says_the_same_as_flags_and_flags_go_before_it(self):
        (self.dir / "o.toml").write_text(
            "threads = 1\n[voxels]\nvoxel-size = '2.5mm'\n[outliers]\noutlier-lambda = 2\n")
        flags = ("--voxel-size", "2.5mm", "--outlier-lambda", "2")
        self.ok("reconstruct", self.rec, "-o", "a.ply", "--config", "o.toml")
        self.ok("reconstruct", self.rec, "-o", "b.ply", *flags)
        self.ok("reconstruct", self.rec, "-o", "c.ply", "--config", "o.toml", "--voxel-size", "3mm")
        a, b, c = ((self.dir / n).read_bytes() for n in ("a.ply", "b.ply", "c.ply"))
        self.assertEqual(a, b)
        self.assertNotEqual(a, c)

    def test_stages_are_saved_beside_the_mesh_or_where_one_says(self):
        self.ok("reconstruct", self.rec, "-o", "m.stl", *COARSE, "--method", "poisson",
                "--save-stage", "merged", "--save-stage", "candidates=points.ply")
        self.assertEqual(self.files(), ["m-merged.ply", "m.stl", "points.ply"])
        clouds = {}
        for name in ("m-merged.ply", "points.ply"):
            info = json.loads(self.ok("info", name, "--json").stdout)
            self.assertEqual(info["kind"], "cloud")
            clouds[name] = info["points"]
        self.assertGreater(clouds["m-merged.ply"], clouds["points.ply"])

    def test_a_stage_of_another_method_is_refused(self):
        for stage, method in (("candidates", "volumetric"), ("fitted", "poisson")):
            self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--method", method,
                         "--save-stage", stage, says=[stage, "--method"])
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--method", "poisson", "--save-stage",
                     "sub-voxels", says=["sub-voxels", "--candidates"])
        self.assertEqual(self.files(), [])

    def test_triangles_that_the_surface_is_not_worth_are_left_out_unless_all_are_asked_for(self):
        self.rec = str(shared_demo() / "recording")
        truth = shared_demo() / "cylinder-reference.ply"
        found = {}
        for triangles in ("all", "auto"):
            self.ok("reconstruct", self.rec, "-o", "m.ply", "--triangles", triangles, "--report",
                    "r.json")
            self.ok("evaluate", "m.ply", "--reference", truth, "--json", "e.json")
            report = json.loads((self.dir / "r.json").read_text())
            scores = json.loads((self.dir / "e.json").read_text())["scores"]
            found[triangles] = report["objects"][0], scores, report["parameters"]
        (full, best, _), (fewer, scores, parameters) = found["all"], found["auto"]
        self.assertLess(fewer["triangles"], 0.8 * full["triangles"])
        self.assertTrue(fewer["mesh"]["watertight"])
        for score, of_all in zip(scores, best):
            self.assertAlmostEqual(score["f"], of_all["f"], delta=0.001)
        reason, = (p["reason"] for p in parameters if p["option"] == "triangles")
        self.assertIn("of %d: to an eighth of the expected error" % full["triangles"], reason)
        self.assertEqual([p for p in found["all"][2] if p["option"] == "triangles"], [])
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--triangles", "many",
                     says="auto, all")
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--triangles", "all",
                     "--max-error", "1mm", says="give one")

    def test_a_ply_mesh_has_a_confidence_and_marks_what_was_invented(self):
        self.ok("reconstruct", self.rec, "-o", "m.ply", "--max-error", "0.3mm", "--mark-invented")
        header = (self.dir / "m.ply").read_bytes().split(b"end_header")[0].decode()
        self.assertIn("property float confidence", header)
        self.assertIn("property uchar red", header)
        self.ok("reconstruct", self.rec, "-o", "full.ply", "--triangles", "all")
        few, full = (json.loads(self.ok("info", n, "--json").stdout)["objects"][0]
                     for n in ("m.ply", "full.ply"))
        self.assertTrue(few["watertight"])
        self.assertLess(few["triangles"], full["triangles"] / 2)
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--max-error", "0mm",
                     says="max-error")

    def test_holes_are_left_open_or_closed_flat_as_asked(self):
        for method in ("volumetric", "poisson"):
            self.ok("reconstruct", self.rec, *COARSE, "-o", "whole.ply", "--method", method)
            done = self.ok("reconstruct", self.rec, *COARSE, "-o", "open.ply", "--holes", "open",
                           "--method", method)
            self.assertIn("left open", done.stdout)
            self.ok("reconstruct", self.rec, *COARSE, "-o", "flat.ply", "--holes", "flat",
                    "--hole-size", "1mm", "--method", method)
            opened, flat, whole = (json.loads(self.ok("info", n, "--json").stdout)["objects"][0]
                                   for n in ("open.ply", "flat.ply", "whole.ply"))
            self.assertFalse(opened["watertight"])
            self.assertTrue(flat["watertight"] and whole["watertight"])
            self.assertLess(opened["triangles"], whole["triangles"])
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--method", "poisson",
                     "--no-repair", "--holes", "open", says="holes")

    def test_a_mesh_is_smoothed_and_cut_down_to_what_is_wanted(self):
        self.ok("reconstruct", self.rec, "-o", "rough.ply", *COARSE)
        self.ok("reconstruct", self.rec, "-o", "smooth.ply", "--smooth", "8mm", *COARSE)
        rough, smooth = (json.loads(self.ok("info", n, "--json").stdout)["objects"][0]
                         for n in ("rough.ply", "smooth.ply"))
        self.assertTrue(smooth["watertight"])
        self.assertLess(smooth["area_m2"], rough["area_m2"])
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--only-object", "2", *COARSE,
                     says="only-object 2: there is only 1")
        self.refused(FAILED, "reconstruct", self.rec, "-o", "m.ply", "--smallest-part", "5m", *COARSE,
                     says="nothing is left")
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--smooth", "-1mm",
                     says="smooth")

    def test_an_open_mesh_is_refused_unless_allowed(self):
        args = ("reconstruct", self.rec, "-o", "m.ply", "--method", "concave-hull", "--no-repair", *COARSE)
        self.refused(FAILED, *args, says="--allow-open")
        self.assertEqual(self.files(), [])
        self.ok(*args, "--allow-open")
        self.assertEqual(self.files(), ["m.ply"])

    def test_both_candidate_methods_run(self):
        self.ok("reconstruct", self.rec, "-o", "a.ply", *FAST, "--method", "poisson",
                "--candidates", "sub-voxel")
        self.ok("reconstruct", self.rec, "-o", "b.ply", *FAST, "--method", "poisson",
                "--candidates", "centroid")

    def test_a_wrong_turntable_file_is_named(self):
        (self.dir / "t.json").write_text('{"axis": [0, 0, 0], "center_m": [0, 0, 1]}')
        self.refused(FAILED, "reconstruct", self.rec, "-o", "m.ply", "--turntable", "t.json",
                     says="t.json")

    def test_the_recordings_own_turntable_given_by_hand_changes_nothing(self):
        header = json.loads((shared_recording() / "recording.json").read_text())
        (self.dir / "t.json").write_text(json.dumps(header["turntable"]))
        self.ok("reconstruct", self.rec, *COARSE, "-o", "a.ply")
        self.ok("reconstruct", self.rec, *COARSE, "-o", "b.ply", "--turntable", "t.json")
        a, b = (json.loads(self.ok("info", n, "--json").stdout)["objects"][0]["volume_m3"]
                for n in ("a.ply", "b.ply"))
        self.assertAlmostEqual(a, b, delta=1e-6)


class SeveralObjects(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.rec = str(shared_demo("pair") / "recording")

    def test_several_objects_become_numbered_files(self):
        out = self.ok("reconstruct", self.rec, *COARSE, "-o", "m.stl").stdout
        self.assertEqual(self.files(), ["m-1.stl", "m-2.stl"])
        self.assertIn("Wrote m-2.stl", out)

    def test_several_objects_go_into_one_3mf_and_one_glb(self):
        for name in ("m.3mf", "m.glb"):
            self.ok("reconstruct", self.rec, *COARSE, "-o", name)
            self.assertEqual(len(json.loads(self.ok("info", name, "--json").stdout)["objects"]), 2)

    def test_keep_largest_keeps_one(self):
        self.ok("reconstruct", self.rec, *COARSE, "-o", "m.ply", "--keep", "largest")
        self.assertEqual(self.files(), ["m.ply"])
        self.refused(USAGE, "reconstruct", self.rec, "-o", "m.ply", "--keep", "best", says="keep")


class Demo(harness.TestCase):
    def test_the_folder_holds_what_was_promised(self):
        folder = shared_demo()
        names = {p.name for p in folder.iterdir()}
        for name in ("recording", "cylinder.ply", "cylinder.stl", "cylinder-reference.ply",
                     "cylinder-errors.ply", "cylinder.png", "report.json"):
            self.assertIn(name, names)
        figures = json.loads((folder.parent / "figures.json").read_text())["objects"]
        self.assertEqual([f["object"] for f in figures], ["cylinder"])
        self.assertTrue(figures[0]["watertight"])
        self.assertGreater(figures[0]["f_at_1mm"], 0.9)
        size = struct.unpack(">II", (folder / "cylinder.png").read_bytes()[16:24])
        self.assertEqual(size, (3 * int(SMALL_PICTURE[1]), int(SMALL_PICTURE[1])))

    def test_a_second_demo_takes_the_next_free_folder(self):
        (self.dir / "turnscan-demo").mkdir()
        out = self.ok("demo", "--object", "cylinder", "--frames", "24", *NARROW, *SMALL_PICTURE).stdout
        self.assertIn("turnscan-demo-2", out)
        self.assertEqual(list((self.dir / "turnscan-demo").iterdir()), [])


class Evaluate(harness.TestCase):
    def setUp(self):
        super().setUp()
        (self.dir / "a.ply").write_text(ply_cube(0.1))
        (self.dir / "b.ply").write_text(ply_cube(0.102))

    def test_a_mesh_against_itself_has_no_error(self):
        self.ok("evaluate", "a.ply", "--reference", "a.ply", "--json", "e.json")
        figures = json.loads((self.dir / "e.json").read_text())
        self.assertLess(figures["accuracy"]["p95_m"], 1e-6)

    def test_thresholds_and_error_map(self):
        out = self.ok("evaluate", "b.ply", "--reference", "a.ply", "--thresholds", "0.5mm,5mm",
                      "--error-map", "map.ply").stdout
        self.assertIn("0.5mm", out)
        self.assertIn("5mm", out)
        info = json.loads(self.ok("info", "map.ply", "--json").stdout)
        self.assertTrue(info["objects"][0]["colored"])

    def test_units_that_the_file_does_not_say(self):
        (self.dir / "mm.ply").write_text(ply_cube(100))
        self.ok("evaluate", "mm.ply", "--unit", "mm", "--reference", "a.ply", "--json", "e.json")
        figures = json.loads((self.dir / "e.json").read_text())
        self.assertLess(figures["accuracy"]["p95_m"], 1e-6)
        self.refused(USAGE, "evaluate", "mm.ply", "--unit", "ell", "--reference", "a.ply",
                     says="ell")

    def test_wrong_thresholds(self):
        self.refused(USAGE, "evaluate", "a.ply", "--reference", "a.ply", "--thresholds", "1,2",
                     says="unit")

    def test_seen_from_a_recording(self):
        demo = shared_demo()
        args = ("evaluate", demo / "cylinder.ply", "--reference", demo / "cylinder-reference.ply")
        self.ok(*args, "--json", "all.json")
        self.ok(*args, "--seen-from", demo / "recording", "--json", "seen.json")
        every, seen = (json.loads((self.dir / n).read_text()) for n in ("all.json", "seen.json"))
        self.assertLess(seen["seen_area_m2"], every["seen_area_m2"])


class Info(harness.TestCase):
    def test_an_open_mesh_is_described_in_sentences(self):
        (self.dir / "m.ply").write_text(ply_cube(0.1, hole=True))
        out = self.ok("info", "m.ply").stdout
        self.assertIn("It is not closed: 4 edges", out)
        self.assertIn("It is not watertight", out)
        self.assertIn("100.0 x 100.0 x 100.0 mm", out)

    def test_a_closed_mesh_is_described_in_sentences(self):
        (self.dir / "m.ply").write_text(ply_cube(0.1))
        out = self.ok("info", "m.ply").stdout
        self.assertIn("It is closed.", out)
        self.assertIn("volume 1000.00 cm3", out)

    def test_a_recording_is_summarised(self):
        out = self.ok("info", shared_recording()).stdout
        self.assertIn("24 frames", out)
        json.loads(self.ok("info", shared_recording(), "--json").stdout)

    def test_a_folder_with_the_name_of_a_command(self):
        (self.dir / "demo").mkdir()
        self.refused(FAILED, "info", "demo", says="demo")


class Render(harness.TestCase):
    def test_pictures_have_the_size_that_was_asked_for(self):
        (self.dir / "a.ply").write_text(ply_cube(0.1))
        for args, width in (((), 64), (("--side-by-side",), 128)):
            self.ok("render", "a.ply", "a.ply", "-o", "p.png", "--picture-width", "64", "--picture-height", "48",
                    *args)
            size = struct.unpack(">II", (self.dir / "p.png").read_bytes()[16:24])
            self.assertEqual(size, (width, 48))


if __name__ == "__main__":
    harness.main()
