"""Several passes of one object become one mesh."""

import json

import harness
from harness import FAILED, USAGE


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inverse(m):
    back = [[m[j][i] for j in range(3)] for i in range(3)]
    shift = [-sum(back[i][k] * m[k][3] for k in range(3)) for i in range(3)]
    return [back[i] + [shift[i]] for i in range(3)] + [[0, 0, 0, 1]]


class Passes(harness.TestCase):
    def simulate(self, *passes, frames=36):
        """Records the skull in the folder rec, and writes each pass's true pose to poseN.txt."""
        self.ok("simulate", "builtin:skull", "--frames", frames, "--seed", 3, "--noise",
                "gaussian:1mm", *(x for p in passes for x in ("--next-pass", p)),
                "--out", "rec", "--quiet")
        truth = json.loads((self.dir / "rec/truth/truth.json").read_text())
        for k, pose in enumerate(truth["next_passes"], 1):
            matrix = product(truth["object"]["T_table_object"], inverse(pose["T_table_object"]))
            rows = [" ".join(f"{x:.12g}" for x in row) for row in matrix]
            (self.dir / f"pose{k}.txt").write_text("\n".join(rows) + "\n")

    def f_score(self, mesh):
        """Of the whole surface, at 1 mm."""
        self.ok("evaluate", mesh, "--reference", "rec/truth/object.ply", "--json", "e.json")
        judged = json.loads((self.dir / "e.json").read_text())
        return next(s["f"] for s in judged["scores"] if s["threshold_m"] == 0.001)

    def test_passes_of_known_poses_become_one_mesh_of_the_whole_object(self):
        self.simulate("tip=90deg,yaw=40deg")
        self.ok("reconstruct", "rec", "--pass", "0", "-o", "one.ply", "--report", "one.json")
        out = self.ok("reconstruct", "rec", "--pass-pose", "1=pose1.txt", "-o", "two.ply",
                      "--report", "two.json").stdout
        self.assertIn("2 passes in one mesh: pass 0 (36 frames), pass 1 (36 frames)", out)
        one, two = (json.loads((self.dir / f).read_text()) for f in ("one.json", "two.json"))
        self.assertTrue(two["objects"][0]["mesh"]["watertight"])
        self.assertLess(two["objects"][0]["invented_area_cm2"],
                        0.3 * one["objects"][0]["invented_area_cm2"])
        self.assertEqual([p["frames"] for p in two["passes"]], [36, 36])
        self.assertEqual(one["passes"], [])
        self.assertGreater(self.f_score("two.ply"), max(0.99, self.f_score("one.ply") + 0.01))

    def test_a_pose_that_the_surfaces_contradict_is_doubted(self):
        self.simulate("tip=90deg,yaw=40deg")
        right = self.ok("reconstruct", "rec", "--pass-pose", "1=pose1.txt", "-o", "m.ply").stdout
        self.assertNotIn("taken as given", right)
        rows = [row.split() for row in (self.dir / "pose1.txt").read_text().splitlines()]
        rows[0][3] = str(float(rows[0][3]) + 0.003)
        (self.dir / "beside.txt").write_text("\n".join(" ".join(row) for row in rows))
        wrong = self.ok("reconstruct", "rec", "--pass-pose", "1=beside.txt", "-o", "m.ply").stdout
        self.assertIn("pass 1 lies 3.0 mm from where its surface fits", wrong)

    def test_the_points_methods_fuse_passes_too(self):
        self.simulate("tip=90deg,yaw=40deg", frames=24)
        self.ok("reconstruct", "rec", "--pass", "0", "--method", "poisson", "--keep", "largest",
                "-o", "one.ply")
        self.ok("reconstruct", "rec", "--method", "poisson", "--keep", "largest", "--pass-pose",
                "1=pose1.txt", "-o", "two.ply")
        self.assertGreater(self.f_score("two.ply"), self.f_score("one.ply"))

    def test_passes_are_joined_by_their_surfaces(self):
        self.simulate("tip=90deg,yaw=40deg")
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
        for name, tip, frames in (("rec", "0deg", 36), ("second", "90deg", 30)):
            self.ok("simulate", "builtin:skull", "--frames", frames, "--seed", 3, "--noise",
                    "gaussian:1mm", "--tip", tip, "--out", name, "--quiet")
        out = self.ok("reconstruct", "rec", "second", "-o", "both.ply").stdout
        self.assertIn("pass 0 (rec) (36 frames), pass 1 (second) (30 frames)", out)
        self.ok("reconstruct", "rec", "-o", "one.ply")
        self.assertGreater(self.f_score("both.ply"), self.f_score("one.ply") + 0.05)
        self.refused(USAGE, "reconstruct", "rec", "second", "--pass", "0", "-o", "m.ply",
                     says="--pass")

    def test_a_pass_whose_motion_its_shape_does_not_show_is_kept_beside(self):
        self.ok("simulate", "builtin:cylinder", "--frames", 24, "--noise", "gaussian:1mm",
                "--next-pass", "tip=180deg", "--out", "rec", "--quiet")
        self.refused(FAILED, "reconstruct", "rec", "-o", "whole.ply", says="pass 1 was not joined")
        self.assertFalse((self.dir / "whole.ply").exists())
        for name in ("whole-pass0.ply", "whole-pass1.ply"):
            self.assertIn("watertight", self.ok("info", name).stdout)

    def test_poses_are_of_passes_of_this_recording(self):
        self.simulate("tip=90deg", "tip=180deg", frames=4)
        for poses, says in ((["1=pose1.txt", "2=pose2.txt", "3=pose1.txt"], "no such pass"),
                            (["1=pose1.txt", "1=pose1.txt"], "twice"),
                            (["pose1.txt"], "PASS=FILE"),
                            (["1=90,0,0,0,0,0"], "unit")):
            options = [x for p in poses for x in ("--pass-pose", p)]
            self.refused(USAGE, "reconstruct", "rec", *options, "-o", "m.ply", says=says)
        self.refused(USAGE, "reconstruct", "rec", "--pass", "0", "--pass-pose", "1=pose1.txt",
                     "--pass-pose", "2=pose2.txt", "-o", "m.ply", says="--pass")


if __name__ == "__main__":
    harness.main()
