"""Several passes of one object become one mesh."""

import csv
import json
import math
import os
import pty
import re
import signal

import harness
import recordings
from harness import CANCELLED, COARSE, FAILED, NARROW, SENSOR, USAGE


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inverse(m):
    back = [[m[j][i] for j in range(3)] for i in range(3)]
    shift = [-sum(back[i][k] * m[k][3] for k in range(3)) for i in range(3)]
    return [back[i] + [shift[i]] for i in range(3)] + [[0, 0, 0, 1]]


class Passes(harness.TestCase):
    def skull(self, name):
        """A recording of the skull as the folder rec, and each pass's true pose in poseN.txt."""
        recordings.link(name, self.dir / "rec")
        self.write_poses()

    def write_poses(self):
        truth = json.loads((self.dir / "rec/truth/truth.json").read_text())
        for k, pose in enumerate(truth.get("next_passes", []), 1):
            matrix = product(truth["object"]["T_table_object"], inverse(pose["T_table_object"]))
            rows = [" ".join(f"{x:.12g}" for x in row) for row in matrix]
            (self.dir / f"pose{k}.txt").write_text("\n".join(rows) + "\n")

    def f_score(self, mesh):
        """Of the whole surface, at 1 mm."""
        self.ok("evaluate", mesh, "--reference", "rec/truth/object.ply", "--samples", "50000",
                "--json", "e.json")
        judged = json.loads((self.dir / "e.json").read_text())
        return next(s["f"] for s in judged["scores"] if s["threshold_m"] == 0.001)

    def test_passes_of_known_poses_become_one_mesh_of_the_whole_object(self):
        self.skull("skull-twice")
        self.ok("reconstruct", "rec", "--pass", "0", "-o", "one.ply", "--report", "one.json")
        out = self.ok("reconstruct", "rec", "--pass-pose", "1=pose1.txt", "-o", "two.ply",
                      "--report", "two.json").stdout
        self.assertIn("2 passes in one mesh: pass 0 (24 frames), pass 1 (24 frames)", out)
        self.assertNotIn("taken as given", out)
        one, two = (json.loads((self.dir / f).read_text()) for f in ("one.json", "two.json"))
        self.assertTrue(two["objects"][0]["mesh"]["watertight"])
        self.assertLess(two["objects"][0]["invented_area_cm2"],
                        0.3 * one["objects"][0]["invented_area_cm2"])
        self.assertEqual([p["frames"] for p in two["passes"]], [24, 24])
        self.assertEqual(one["passes"], [])
        self.assertGreater(self.f_score("two.ply"), max(0.99, self.f_score("one.ply") + 0.01))

    def test_a_pose_that_the_surfaces_contradict_is_doubted(self):
        self.skull("skull-twice")
        rows = [row.split() for row in (self.dir / "pose1.txt").read_text().splitlines()]
        rows[0][3] = str(float(rows[0][3]) + 0.003)
        (self.dir / "beside.txt").write_text("\n".join(" ".join(row) for row in rows))
        wrong = self.ok("reconstruct", "rec", "--pass-pose", "1=beside.txt", "-o", "m.ply",
                        *COARSE).stdout
        self.assertIn("pass 1 lies 3.0 mm from where its surface fits", wrong)

    def test_a_pose_that_is_about_right_is_refined_by_the_surfaces(self):
        self.skull("skull-twice")
        rows = [[float(x) for x in row.split()]
                for row in (self.dir / "pose1.txt").read_text().splitlines()]
        turn = math.radians(3)
        about = [[math.cos(turn), -math.sin(turn), 0, 0.004], [math.sin(turn), math.cos(turn), 0, 0],
                 [0, 0, 1, -0.003], [0, 0, 0, 1]]
        for name, move in (("about", about), ("away", [[-1, 0, 0, 0.1], [0, -1, 0, 0.1],
                                                       [0, 0, 1, 0], [0, 0, 0, 1]])):
            (self.dir / f"{name}.txt").write_text(
                "\n".join(" ".join(f"{x:.9g}" for x in row) for row in product(move, rows)))
        out = self.ok("reconstruct", "rec", "--pass-pose", "1=about.txt", "--refine-pass-poses",
                      "-o", "m.ply", "--report", "m.json", *COARSE).stdout
        self.assertIn("2 passes in one mesh", out)
        found = json.loads((self.dir / "m.json").read_text())["passes"][1]["T_object_table"]
        for i in range(3):
            self.assertAlmostEqual(found[i][3], rows[i][3], delta=0.0007)
        self.refused(FAILED, "reconstruct", "rec", "--pass-pose", "1=away.txt",
                     "--refine-pass-poses", "-o", "n.ply", *COARSE, says="as it was placed")
        self.refused(USAGE, "reconstruct", "rec", "--refine-pass-poses", "-o", "n.ply",
                     says="--pass-pose")

    def test_the_points_methods_fuse_passes_too(self):
        self.skull("skull-twice")
        self.ok("reconstruct", "rec", "--pass", "0", "--method", "poisson", "--keep", "largest",
                "-o", "one.ply")
        self.ok("reconstruct", "rec", "--method", "poisson", "--keep", "largest", "--pass-pose",
                "1=pose1.txt", "-o", "two.ply")
        self.assertGreater(self.f_score("two.ply"), self.f_score("one.ply"))

    def test_passes_are_joined_by_their_surfaces(self):
        self.skull("skull-twice")
        out = self.ok("reconstruct", "rec", "-o", "found.ply", "--report", "found.json").stdout
        self.assertIn("2 passes in one mesh", out)
        self.assertIn("pass 1 was joined by its surface", out)
        report = json.loads((self.dir / "found.json").read_text())
        self.assertTrue(report["objects"][0]["mesh"]["watertight"])
        found, true = report["passes"][1], [[float(x) for x in row.split()] for row in
                                            (self.dir / "pose1.txt").read_text().splitlines()]
        self.assertNotIn("sigma_mm", report["passes"][0])
        self.assertLess(found["sigma_mm"], 0.2)
        for i in range(3):
            for j in range(4):
                self.assertAlmostEqual(found["T_object_table"][i][j], true[i][j],
                                       delta=0.004 if j < 3 else 0.0005)
        self.assertGreater(self.f_score("found.ply"), 0.98)

    def test_recordings_of_one_object_are_joined(self):
        self.skull("skull")
        self.ok("simulate", recordings.mesh_of("skull"), "--frames", 20, *NARROW, "--seed", 3, "--noise", "gaussian:1mm",
                "--tip", "90deg", "--out", "second", "--quiet")
        out = self.ok("reconstruct", "rec", "second", "-o", "both.ply", *COARSE).stdout
        self.assertIn("pass 0 (rec) (24 frames), pass 1 (second) (20 frames)", out)
        self.ok("reconstruct", "rec", "-o", "one.ply", *COARSE)
        self.assertGreater(self.f_score("both.ply"), self.f_score("one.ply") + 0.05)
        self.refused(USAGE, "reconstruct", "rec", "second", "--pass", "0", "-o", "m.ply",
                     says="--pass")

    def test_a_pass_whose_motion_its_shape_does_not_show_is_kept_beside(self):
        self.ok("simulate", "builtin:cylinder", "--frames", 24, *NARROW, "--noise", "gaussian:1mm",
                "--next-pass", "tip=180deg", "--out", "rec", "--quiet")
        self.refused(FAILED, "reconstruct", "rec", "-o", "whole.ply", *COARSE,
                     says="pass 1 was not joined")
        self.assertFalse((self.dir / "whole.ply").exists())
        for name in ("whole-pass0.ply", "whole-pass1.ply"):
            self.assertIn("watertight", self.ok("info", name).stdout)

    def vase(self, name, color):
        """A vase of 120 mm, and what its paint is at an angle and a height."""
        steps, rows = 120, 100
        places = [(0.0, 0.0)]
        places += [(30 + 12 * math.sin(y / 20), y) for y in (120 * r / rows for r in range(rows + 1))]
        places += [(0.0, 120.0)]
        vertices, faces = [], []
        for r, y in places:
            for k in range(steps):
                a = 2 * math.pi * k / steps
                vertices.append("%.4f %.4f %.4f %d %d %d" % (
                    r * math.cos(a), y, -r * math.sin(a), *color(a, y)))
        for i in range(len(places) - 1):
            for k in range(steps):
                a, b = i * steps + k, i * steps + (k + 1) % steps
                faces += [f"3 {a} {b} {b + steps}", f"3 {a} {b + steps} {a + steps}"]
        (self.dir / name).write_text("\n".join(
            ["ply", "format ascii 1.0", f"element vertex {len(vertices)}",
             *(f"property float {c}" for c in "xyz"),
             *(f"property uchar {c}" for c in ("red", "green", "blue")),
             f"element face {len(faces)}", "property list uchar int vertex_indices",
             "end_header", *vertices, *faces]) + "\n")

    def test_where_the_shape_does_not_tell_how_it_lay_the_paint_does(self):
        def painted(a, y):
            spot = math.sin(2 * a + y / 15) + math.sin(a - y / 22) > 0.2
            return (200, 60, 40) if spot else (220, 210, 190) if math.sin(3 * a) > 0.4 else (60, 90, 150)

        for name, color in (("painted", painted), ("plain", lambda a, y: (200, 190, 180))):
            self.vase(f"{name}.ply", color)
            self.ok("simulate", f"{name}.ply", "--unit", "mm", "--frames", 24, *NARROW, "--seed", 5,
                    "--noise", "gaussian:1mm", "--scan-colour", "--colour-width", 480,
                    "--colour-lamp", 0.6, "--colour-noise", 2, "--next-pass", "tip=90deg,yaw=40deg",
                    "--out", name, "--quiet")
        out = self.ok("reconstruct", "painted", "-o", "m.ply", "--report", "m.json",
                      *COARSE).stdout
        self.assertIn("pass 1 was joined by its colours", out)
        truth = json.loads((self.dir / "painted/truth/truth.json").read_text())
        true = product(truth["object"]["T_table_object"],
                       inverse(truth["next_passes"][0]["T_table_object"]))
        found = json.loads((self.dir / "m.json").read_text())["passes"][1]["T_object_table"]
        for i in range(3):
            for j in range(4):
                self.assertAlmostEqual(found[i][j], true[i][j], delta=0.02 if j < 3 else 0.0015)
        self.refused(FAILED, "reconstruct", "plain", "-o", "n.ply", *COARSE,
                     says="its shape does not determine")

    def test_poses_are_of_passes_of_this_recording(self):
        self.ok("simulate", recordings.mesh_of("skull"), "--frames", 4, *NARROW, "--next-pass", "tip=90deg",
                "--next-pass", "tip=180deg", "--out", "rec", "--quiet")
        self.write_poses()
        for poses, says in ((["1=pose1.txt", "2=pose2.txt", "3=pose1.txt"], "no such pass"),
                            (["1=pose1.txt", "1=pose1.txt"], "twice"),
                            (["pose1.txt"], "PASS=FILE"),
                            (["1=90,0,0,0,0,0"], "unit")):
            options = [x for p in poses for x in ("--pass-pose", p)]
            self.refused(USAGE, "reconstruct", "rec", *options, "-o", "m.ply", says=says)
        self.refused(USAGE, "reconstruct", "rec", "--pass", "0", "--pass-pose", "1=pose1.txt",
                     "--pass-pose", "2=pose2.txt", "-o", "m.ply", says="--pass")

    def test_reconstruct_says_what_is_missing_and_how_to_lay_the_object(self):
        self.skull("skull")
        out = self.ok("reconstruct", "rec", "-o", "one.ply", "--report", "one.json",
                      "--advice-picture", "lay.png").stdout
        line = next(l for l in out.splitlines() if l.startswith("Next pass: "))
        self.assertRegex(line, r"No view saw \d+ cm2 of its surface of \d+ cm2: base \d+ cm2, .*"
                               r"To see about \d+ cm2 of that, .* tip it by \d+ degrees")
        self.assertGreater((self.dir / "lay.png").stat().st_size, 5000)
        report = json.loads((self.dir / "one.json").read_text())
        colour = report["objects"][0]["verdict"]["colour"]
        self.assertIn(f"Verdict: {colour.upper()}\n", out)
        advice = report["next_pass"]
        self.assertIn(advice["advice"], line)
        parts = sum(advice[f"{part}_cm2"] for part in ("base", "underside", "sides", "top"))
        self.assertAlmostEqual(parts, advice["unseen_cm2"], places=3)
        best = advice["poses"][0]
        self.assertTrue(best["stands"])
        self.assertGreater(best["shows_cm2"], 0.3 * advice["unseen_cm2"])
        self.refused(USAGE, "reconstruct", "rec", "-o", "one.ply", "--advice-picture", "lay.jpg",
                     says="png")


class ScanPasses(harness.TestCase):
    """turnscan scan goes on with another side; small images and few frames."""
    DEVICE = "virtual:{}?sensor=" + str(SENSOR) + "&fps=2&speed=12deg/s&noise=gaussian:1mm&calibration=true"
    FAST = ("--min-free", "0", "--speed", "12deg/s", *COARSE)

    def device(self, name="skull"):
        return self.DEVICE.format(recordings.mesh_of(name) if name == "skull" else name)

    def args(self, name, *more):
        return ("scan", "--device", self.device(name), "-o", "whole.ply", *self.FAST, *more)

    def environment(self):
        return {"XDG_STATE_HOME": str(self.dir / "state")}

    def scan(self, name, *more):
        return self.ok(*self.args(name, *more), env=self.environment())

    def frames_of_passes(self):
        with open(self.dir / "whole.recording/frames.csv") as file:
            passes = [row["pass"] for row in csv.DictReader(file)]
        return {p: passes.count(p) for p in passes}

    def f_score(self, mesh):
        self.ok("evaluate", mesh, "--reference", recordings.mesh_of("skull"), "--align", "icp", "--samples",
                "50000", "--json", "e.json")
        judged = json.loads((self.dir / "e.json").read_text())
        return next(s["f"] for s in judged["scores"] if s["threshold_m"] == 0.001)

    def test_a_virtual_object_is_laid_as_is_advised_and_joined(self):
        # The table's frame is the truth's, for the comparison.
        out = self.scan("skull", "--passes", "2", "--report", "r.json", "--quiet",
                        "--no-wait").stdout
        self.assertRegex(out, "before pass 1: No view saw .* To see about")
        self.assertIn("pass 1 was joined by its surface", out)
        report = json.loads((self.dir / "r.json").read_text())
        self.assertEqual(len(report["further_passes"]), 1)
        self.assertEqual(report["passes_apart"], [])
        whole = report["reconstruction"]
        self.assertEqual([p["name"] for p in whole["passes"]], ["pass 0", "pass 1"])
        self.assertTrue(whole["objects"][0]["mesh"]["watertight"])
        frames = self.frames_of_passes()
        self.assertEqual(set(frames), {"0", "1"})
        self.assertAlmostEqual(frames["0"], frames["1"], delta=3)
        # It is what the recording gives, and more than its first pass.
        self.ok("reconstruct", "whole.recording", "-o", "again.ply", "--speed", "12deg/s",
                *COARSE)
        self.assertEqual((self.dir / "whole.ply").read_bytes(),
                         (self.dir / "again.ply").read_bytes())
        self.ok("reconstruct", "whole.recording", "--pass", "0", "-o", "first.ply", "--report",
                "first.json", "--speed", "12deg/s", *COARSE)
        first = json.loads((self.dir / "first.json").read_text())
        self.assertLess(whole["objects"][0]["invented_area_cm2"],
                        0.5 * first["objects"][0]["invented_area_cm2"])
        self.assertGreater(self.f_score("whole.ply"), self.f_score("first.ply") + 0.03)

    def test_nothing_is_known_of_the_table(self):
        device = self.device().replace("&calibration=true", "")
        out = self.ok("scan", "--device", device, "-o", "whole.ply", "--min-free", "0", "--passes",
                      "2", *COARSE, "--quiet", env=self.environment()).stdout
        self.assertIn("pass 1 was joined by its surface", out)
        self.assertEqual(set(self.frames_of_passes()), {"0", "1"})

    def test_a_pass_that_does_not_fit_is_kept_beside(self):
        result = harness.run(*self.args("cylinder", "--passes", "2", "--quiet"), cwd=self.dir,
                             env=self.environment())
        self.assertEqual(result.returncode, FAILED, result.stdout + result.stderr)
        self.assert_one_line_error(result.stderr)
        self.assertIn("pass 1 was not joined", result.stderr)
        for mesh in ("whole.ply", "whole-pass1.ply"):
            self.assertIn("watertight", self.ok("info", mesh).stdout)
        self.assertEqual(set(self.frames_of_passes()), {"0", "1"})

    def answer(self, *answers):
        """Runs a scan at a terminal and answers its questions; what it says, and its exit code."""
        pid, terminal = pty.fork()
        if pid == 0:
            try:
                os.chdir(self.dir)
                os.environ.update(self.environment())
                harness.default_signals()
                os.execvp(harness.BIN, [harness.BIN, *self.args("skull")])
            finally:
                os._exit(127)  # it could not be started
        said, answers = "", list(answers)
        asked = 0
        while True:
            try:
                said += os.read(terminal, 65536).decode(errors="replace")
            except OSError:
                break
            if said.count("q to end: ") > asked:
                asked += 1
                answer = answers.pop(0)
                if answer == "interrupt":
                    os.kill(pid, signal.SIGINT)
                else:
                    os.write(terminal, (answer + "\n").encode())
        os.close(terminal)
        return re.sub(r"\s+", " ", said), os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])

    def test_at_a_terminal_it_asks_after_each_pass(self):
        said, code = self.answer("", "q")
        self.assertEqual(code, 0, said)
        self.assertIn("No view saw", said)
        self.assertIn("Another side? Lay the object like this and press Enter to record pass 1", said)
        self.assertIn("2 passes in one mesh", said)
        self.assertEqual(set(self.frames_of_passes()), {"0", "1"})

    def test_an_interrupt_between_passes_loses_nothing(self):
        said, code = self.answer("interrupt")
        self.assertEqual(code, CANCELLED, said)
        self.assertIn("the recording is in whole.recording", said)
        self.assertIn("watertight", self.ok("info", "whole.ply").stdout)
        description = json.loads((self.dir / "whole.recording/recording.json").read_text())
        self.assertTrue(description["complete"])

    def test_a_sensor_that_is_lost_in_the_second_pass_costs_only_that_pass(self):
        device = self.device() + "&fault=lost@50s"
        self.refused(FAILED, "scan", "--device", device, "-o", "whole.ply", *self.FAST, "--passes",
                     "2", env=self.environment(), says=("whole.recording holds", "is complete"))
        self.assertIn("watertight", self.ok("info", "whole.ply").stdout)
        frames = self.frames_of_passes()
        self.assertGreater(frames["0"], 55)
        self.assertIn("1", frames)
        self.ok("reconstruct", "whole.recording", "--pass", "0", "-o", "first.ply", *COARSE,
                "--quiet")

    def test_what_cannot_be_laid_another_way_has_one_pass(self):
        recordings.link("three-frames", self.dir / "rec")
        self.refused(USAGE, "scan", "--device", "replay:rec", "-o", "whole.ply", "--passes", "2",
                     says="cannot be laid another way")
        two = [x for i in (1, 2)
               for x in ("--device", f"{self.device()}&serial={i}&seed={i}")]
        self.refused(USAGE, "scan", *two, "-o", "whole.ply", "--passes", "2", *self.FAST,
                     says="cannot be laid another way")
        self.refused(USAGE, *self.args("skull", "--passes", "2", "--pass", "0"), says="--passes")
        self.refused(USAGE, *self.args("skull", "--passes", "0"), says="passes")


def lump(seed, radius_mm):
    """Vertices (mm) and triangles of a lumpy closed thing about the origin."""
    rows, columns = 40, 80
    vertices, triangles = [], []
    for r in range(rows + 1):
        polar = math.pi * r / rows
        for c in range(columns):
            around = 2 * math.pi * c / columns
            x, y, z = (math.sin(polar) * math.cos(around), math.cos(polar),
                       -math.sin(polar) * math.sin(around))
            size = radius_mm * (1 + 0.2 * math.sin(3.1 * x + seed) +
                                0.17 * math.cos(4.3 * y - (1 + seed) * z) +
                                0.1 * math.sin(7 * z + 3 * x))
            vertices.append((size * x, size * y, size * z))
    for r in range(rows):
        for c in range(columns):
            a, b = r * columns + c, r * columns + (c + 1) % columns
            below = [a + columns, b + columns]
            triangles += [(a, below[0], below[1])] if r == 0 else (
                [(a, below[0], b)] if r == rows - 1 else
                [(a, below[0], below[1]), (a, below[1], b)])
    # Of each pole one vertex is used.
    pole = {k: 0 for k in range(columns)}
    pole.update({rows * columns + k: rows * columns for k in range(columns)})
    triangles = [tuple(pole.get(v, v) for v in t) for t in triangles]
    used = sorted({v for t in triangles for v in t})
    number = {v: k for k, v in enumerate(used)}
    return [vertices[v] for v in used], [tuple(number[v] for v in t) for t in triangles]


def placed(mesh, tip_deg, yaw_deg, x, z):
    """Tipped about x, turned about y, set down on y = 0."""
    tip, yaw = math.radians(tip_deg), math.radians(yaw_deg)
    out = []
    for p in mesh[0]:
        y1, z1 = (math.cos(tip) * p[1] - math.sin(tip) * p[2],
                  math.sin(tip) * p[1] + math.cos(tip) * p[2])
        out.append((math.cos(yaw) * p[0] + math.sin(yaw) * z1, y1,
                    math.cos(yaw) * z1 - math.sin(yaw) * p[0]))
    low = min(p[1] for p in out)
    return [(p[0] + x, p[1] - low, p[2] + z) for p in out], mesh[1]


class SeveralObjects(harness.TestCase):
    def record(self, name, *meshes):
        """A recording of the things as they stand."""
        vertices, triangles = [], []
        for points, faces in meshes:
            triangles += [tuple(len(vertices) + v for v in face) for face in faces]
            vertices += points
        (self.dir / f"{name}.off").write_text(
            f"OFF\n{len(vertices)} {len(triangles)} 0\n" +
            "".join(f"{x:.5f} {y:.5f} {z:.5f}\n" for x, y, z in vertices) +
            "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles))
        self.ok("simulate", f"{name}.off", "--unit", "mm", "--frames", 24, *NARROW, "--seed", 5,
                "--noise", "gaussian:1mm", "--out", name, "--quiet")

    def test_each_finds_its_partner_in_the_other_pass(self):
        one, two, third = lump(1, 45), lump(4, 38), lump(2.2, 34)
        self.record("first", placed(one, 0, 0, -70, 0), placed(two, 0, 0, 60, 20))
        self.record("second", placed(two, 90, 100, -60, 30), placed(one, 180, 30, 60, -10),
                    placed(third, 0, 0, 10, 110))
        failed = self.refused(FAILED, "reconstruct", "first", "second", "-o", "whole.ply",
                              "--report", "r.json", says="object 3: ")
        self.assertIn("pass 1 (second) was not joined", failed.stderr)
        report = json.loads((self.dir / "r.json").read_text())
        self.assertEqual(len(report["objects"]), 2)
        self.assertTrue(all(o["mesh"]["watertight"] for o in report["objects"]))
        self.assertEqual([p["object"] for p in report["passes"]], [1, 1, 2, 2])
        self.assertLess(max(p["sigma_mm"] for p in report["passes"] if "sigma_mm" in p), 0.2)
        recall = 0.0
        for k in (1, 2):
            self.ok("evaluate", f"whole-{k}.ply", "--reference", "first/truth/object.ply", "--json",
                    "e.json")
            scores = json.loads((self.dir / "e.json").read_text())["scores"]
            at_1mm = next(s for s in scores if s["threshold_m"] == 0.001)
            self.assertGreater(at_1mm["precision"], 0.98)
            recall += at_1mm["recall"]
        self.assertGreater(recall, 0.97)
        # The third is alone in its mesh.
        alone = json.loads(self.ok("info", "whole-pass1.ply", "--json").stdout)["objects"]
        self.assertEqual([o["pieces"] for o in alone], [1])


class ImportedPasses(harness.TestCase):
    def foreign(self, name, tip):
        """A pass in the layout json-png."""
        self.ok("simulate", recordings.mesh_of("skull"), "--frames", 24, *NARROW, "--noise", "gaussian:1mm",
                "--tip", tip, "--aim-height", "90mm", "--out", "rec-" + name, "--quiet")
        recording = self.dir / ("rec-" + name)
        described = json.loads((recording / "recording.json").read_text())
        sensor, table = described["sensors"][0], described["turntable"]
        with open(recording / "frames.csv") as file:
            frames = list(csv.DictReader(file))
        (self.dir / name).mkdir()
        (recording / "depth").rename(self.dir / name / "depth")
        (self.dir / name / "views.json").write_text(json.dumps({
            "intrinsics": {**sensor["intrinsics"], "depth_unit_m": sensor["depth_unit_m"]},
            "depth_files": [f["file"] for f in frames],
            "angle_deg": [float(f["angle_deg"]) for f in frames],
            "axis_dir": table["axis"], "axis_point": table["center_m"], "platter_height_m": 0.0,
            "radius_m": table["radius_m"]}))

    def test_data_sets_that_are_imported_together_are_passes_that_are_joined(self):
        self.foreign("first", "0deg")
        self.foreign("second", "90deg")
        self.assertIn("2 passes", self.ok("import", "first/views.json", "second/views.json",
                                            "--out", "both").stdout)
        out = self.ok("reconstruct", "both", "-o", "whole.ply", *COARSE).stdout
        self.assertIn("2 passes in one mesh", out)
        self.assertIn("pass 1 was joined by its surface", out)


if __name__ == "__main__":
    harness.main()
