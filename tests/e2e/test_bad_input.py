"""Inputs that are missing, damaged or hostile, and outputs that cannot be written: one line on
standard error, exit code 1, nothing left behind."""

import os
import unittest

import harness
import recordings
from harness import FAILED, FAST, foreign_scan, ply_cube, png16
from recordings import shared_recording


class MissingOrDamaged(harness.TestCase):
    def test_missing_files_and_folders(self):
        self.refused(FAILED, "info", "none.ply", says="none.ply")
        self.refused(FAILED, "info", "none", says="none")
        self.refused(FAILED, "reconstruct", "none", "-o", "m.ply", says="none")
        self.refused(FAILED, "import", "none", "--out", "rec", says="none")
        self.refused(FAILED, "evaluate", "none.ply", "--reference", "none.ply", says="none.ply")
        self.refused(FAILED, "render", "none.ply", "-o", "p.png", says="none.ply")
        self.assertEqual(self.files(), [])

    def test_empty_mesh_files(self):
        for ending in ("ply", "obj", "stl", "off", "3mf", "glb", "pcd"):
            (self.dir / f"m.{ending}").write_bytes(b"")
            self.refused(FAILED, "info", f"m.{ending}", says=f"m.{ending}")

    def test_ply_that_claims_two_billion_vertices(self):
        (self.dir / "m.ply").write_text(
            "ply\nformat binary_little_endian 1.0\nelement vertex 2147483648\n"
            "property float x\nproperty float y\nproperty float z\n"
            "element face 2147483648\nproperty list uchar int vertex_indices\nend_header\n")
        self.refused(FAILED, "info", "m.ply", says="m.ply")

    def test_mesh_with_nan_and_with_an_index_out_of_range(self):
        cube = ply_cube(0.1)
        (self.dir / "nan.ply").write_text(cube.replace("0.05 0.1 0.05", "nan 0.1 0.05"))
        (self.dir / "index.ply").write_text(cube.replace("4 0 1 3 2", "4 0 1 3 99"))
        for name in ("nan.ply", "index.ply"):
            self.refused(FAILED, "info", name, says=name)

    def test_a_folder_that_is_no_recording(self):
        (self.dir / "rec").mkdir()
        self.refused(FAILED, "info", "rec", says="rec")
        self.refused(FAILED, "reconstruct", "rec", "-o", "m.ply", says="rec")

    def test_a_foreign_folder_that_nobody_knows(self):
        (self.dir / "photos").mkdir()
        (self.dir / "photos" / "cat.txt").write_text("meow")
        self.refused(FAILED, "import", "photos", "--out", "rec", says="photos")
        self.assertFalse((self.dir / "rec").exists())

    def test_the_layouts_are_a_table_and_an_error_points_to_it(self):
        (self.dir / "photos").mkdir()
        for what, says in (("photos", "an empty folder"), ("cat.txt", "a .txt file")):
            (self.dir / "cat.txt").write_text("meow")
            result = self.refused(FAILED, "reconstruct", what, "-o", "m.ply",
                                  says=(says, "turnscan import --list"))
            self.assertLess(len(result.stderr), 200)
        (self.dir / "images").mkdir()
        (self.dir / "images" / "depth_0.png").write_text("")
        self.refused(FAILED, "reconstruct", "images", "-o", "m.ply", says="the intrinsics of their camera")
        lines = self.ok("import", "--list").stdout.splitlines()
        self.assertIn("format", lines[0])
        self.assertEqual(len(lines), 17)

    def test_a_mesh_is_no_recording(self):
        for name in ("m.ply", "m.3mf"):
            (self.dir / name).write_text(ply_cube(0.1))
            for command in (["reconstruct", name, "-o", "out.ply"], ["import", name, "-o", "rec"]):
                self.refused(FAILED, *command, says=(name, "already", "turnscan evaluate"))

    def test_text_that_a_person_wrote_is_to_be_corrected_there(self):
        (self.dir / "table.json").write_text('{\n  "axis": [0, 1, 0]\n  "center_m": [0, 0, 1]\n}\n')
        self.refused(FAILED, "reconstruct", shared_recording(), "--turntable", "table.json",
                     "-o", "m.ply", says=("table.json", "line 3, column 3", "expected"))
        (self.dir / "table.json").write_text('{\n  "axis": [0, 1, "up"],\n  "center_m": [0, 0, 1]}')
        self.refused(FAILED, "reconstruct", shared_recording(), "--turntable", "table.json",
                     "-o", "m.ply", says=("line 2, column 18: axis[2] is not a number",))

    def test_names_with_line_breaks_still_give_one_line(self):
        self.refused(FAILED, "info", "two\nlines.ply", says=r"two\u000alines.ply")


class Import(harness.TestCase):
    def test_a_unit_that_the_data_do_not_state_is_asked_for(self):
        scans = foreign_scan(self.dir / "scans")
        before = self.files()
        self.refused(FAILED, "import", scans, "--out", "rec", says="--depth-unit")
        self.assertEqual(self.files(), before)

    def test_a_frame_without_its_pose_is_told_and_left_out(self):
        scans = foreign_scan(self.dir / "scans")
        for i, text in enumerate((None, "", "nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")):
            pose = scans / "frame-000001.pose.txt"
            pose.unlink(missing_ok=True)
            if text is not None:
                pose.write_text(text)
            result = harness.run("import", scans, "--depth-unit", "1mm", "--out", f"rec{i}",
                                 "--quiet", cwd=self.dir)
            if result.returncode != 0:
                self.assert_one_line_error(result.stderr)
                self.assertIn("frame-000001", result.stderr)
            else:
                self.assertIn("1 dropped", result.stdout)

    def test_a_pose_that_is_no_rigid_motion(self):
        scans = foreign_scan(self.dir / "scans")
        for text in ("1 2 3\n", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"):
            (scans / "frame-000001.pose.txt").write_text(text)
            self.refused(FAILED, "import", scans, "--depth-unit", "1mm", "--out", "rec",
                         says="frame-000001")
            self.assertFalse((self.dir / "rec").exists())

    def test_a_truncated_image(self):
        scans = foreign_scan(self.dir / "scans")
        image = scans / "frame-000001.depth.png"
        image.write_bytes(image.read_bytes()[:40])
        self.refused(FAILED, "import", scans, "--depth-unit", "1mm", "--out", "rec",
                     says="frame-000001")
        self.assertFalse((self.dir / "rec").exists())


class DamagedRecordings(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.rec = self.dir / "rec"
        recordings.copy(shared_recording(), self.rec)
        self.csv = self.rec / "frames.csv"

    def reconstruct_fails(self, says):
        before = self.files()
        self.refused(FAILED, "reconstruct", "rec", "-o", "m.ply", says=says)
        self.assertEqual(self.files(), before)

    def change_line(self, number, change):
        lines = self.csv.read_text().splitlines()
        lines[number] = change(lines[number])
        self.csv.write_text("\n".join(lines) + "\n")

    def test_two_frames_with_one_index(self):
        lines = self.csv.read_text().splitlines()
        self.csv.write_text("\n".join([*lines, lines[-1]]) + "\n")
        self.reconstruct_fails("frames.csv")

    def test_pose_that_is_not_a_number(self):
        header = self.csv.read_text().splitlines()[0].split(",")
        column = header.index("tx")

        def poison(line):
            cells = line.split(",")
            cells[column:column + 7] = ["nan"] * 7
            return ",".join(cells)
        self.change_line(3, poison)
        self.reconstruct_fails("frames.csv")

    def test_what_is_wrong_in_a_table_is_named_with_its_place(self):
        self.change_line(3, lambda line: "x" + line)
        self.reconstruct_fails(("line 4: column index", "correct it there"))
        self.change_line(0, lambda line: line.replace("index", "number"))
        self.reconstruct_fails(("line 1: the header has no column 'index'", "correct it there"))

    def test_what_is_wrong_in_recording_json_is_named_with_its_place(self):
        path = self.rec / "recording.json"
        path.write_text(path.read_text().replace('"fx": ', '"fx": "wide", "was": '))
        self.reconstruct_fails(("line ", "column ", "intrinsics.fx is not a number",
                                "correct it there"))

    def test_file_outside_the_recording(self):
        self.change_line(2, lambda line: line.replace("depth/", "../depth/"))
        self.reconstruct_fails("frames.csv")

    def test_recording_json_that_is_damaged(self):
        path = self.rec / "recording.json"
        path.write_text(path.read_text()[:-20])
        self.reconstruct_fails("recording.json")

    def test_a_truncated_image_never_crashes(self):
        image = sorted((self.rec / "depth").iterdir())[5]
        data = image.read_bytes()
        for size in (0, 8, 30, len(data) // 2, len(data) - 1):
            image.write_bytes(data[:size])
            result = harness.run("reconstruct", "rec", "-o", "m.ply", *FAST, "--quiet",
                                 cwd=self.dir)
            self.assertIn(result.returncode, (0, FAILED), result.stderr)
            if result.returncode == 0:
                self.assertIn("Note:", result.stdout, "a lost frame must be told")

    def test_an_image_of_another_size(self):
        sorted((self.rec / "depth").iterdir())[5].write_bytes(png16(20000, 20000, 9000))
        self.reconstruct_fails("depth")

    def test_a_recording_from_a_killed_writer_is_used_up_to_its_last_whole_frame(self):
        lines = self.csv.read_text().splitlines()
        self.csv.write_text("\n".join(lines[:20]) + "\n" + lines[20][:7])
        self.assertIn("19 frames", self.ok("info", "rec").stdout)


class Outputs(harness.TestCase):
    def setUp(self):
        super().setUp()
        (self.dir / "cube.ply").write_text(ply_cube(0.1))
        self.rec = str(shared_recording())

    def foreign(self):
        return (foreign_scan(self.dir / "scans"), "--depth-unit", "1mm")

    def test_an_existing_recording_is_never_written_into(self):
        (self.dir / "out").mkdir()
        (self.dir / "out" / "precious").write_text("x")
        foreign = self.foreign()
        before = self.files()
        self.refused(FAILED, "import", *foreign, "--out", "out", says="out")
        self.refused(FAILED, "demo", "--out", "out", says="out")
        self.assertEqual(self.files(), before)
        self.ok("import", *foreign, "--out", "rec")
        self.refused(FAILED, "import", *foreign, "--out", "rec", says="rec")

    def test_a_folder_that_does_not_exist(self):
        before = self.files()
        self.refused(FAILED, "reconstruct", self.rec, "-o", "no/m.ply", says="no")
        self.refused(FAILED, "reconstruct", self.rec, "-o", "m.ply", "--report", "no/r.json",
                     says="no")
        self.refused(FAILED, "reconstruct", self.rec, "-o", "m.ply", "--save-stage",
                     "fitted=no/c.ply", says="no")
        self.refused(FAILED, "evaluate", "cube.ply", "--reference", "cube.ply", "--json",
                     "no/e.json", says="no")
        self.refused(FAILED, "render", "cube.ply", "-o", "no/p.png", says="no")
        self.assertEqual(self.files(), before)

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_a_read_only_folder(self):
        (self.dir / "ro").mkdir(mode=0o500)
        self.refused(FAILED, "reconstruct", self.rec, "-o", "ro/m.ply", says="ro")
        self.refused(FAILED, "import", *self.foreign(), "--out", "ro/rec", says="ro")

    def test_places_that_no_one_can_write_to(self):
        self.refused(FAILED, "render", "cube.ply", "-o", "/proc/p.png", "--picture-width", "64",
                     "--picture-height", "64", says="/proc")
        self.refused(FAILED, "import", *self.foreign(), "--out", "/proc/rec", says="/proc")

    def test_a_full_device(self):
        self.refused(FAILED, "evaluate", "cube.ply", "--reference", "cube.ply", "--json",
                     "/dev/full", says="/dev/full")

    def test_a_result_is_replaced_and_nothing_else_is_left(self):
        (self.dir / "p.png").write_text("old")
        self.ok("render", "cube.ply", "-o", "p.png", "--picture-width", "64", "--picture-height", "64")
        self.assertEqual((self.dir / "p.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(self.files(), ["cube.ply", "p.png"])

    def test_a_failing_run_leaves_the_old_result(self):
        (self.dir / "m.ply").write_text("old")
        self.refused(FAILED, "reconstruct", self.rec, "-o", "m.ply", "--method", "poisson",
                     "--voxel-min-points", "1000000", says="--voxel-min-points")
        self.assertEqual((self.dir / "m.ply").read_text(), "old")


if __name__ == "__main__":
    harness.main()
