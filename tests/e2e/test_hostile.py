"""Hostile inputs and surroundings: nothing is lost, and nothing crashes."""

import bz2
import json
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zipfile

import harness
import recordings
from harness import FAILED, USAGE, png16, ply_cube, run, start
from recordings import shared_recording


class OutputOverInput(harness.TestCase):
    def setUp(self):
        super().setUp()
        recordings.copy(shared_recording(), self.dir / "rec")
        (self.dir / "s.ply").write_text(ply_cube(0.1))

    def unchanged(self, name, *args):
        before = (self.dir / name).read_bytes()
        self.refused(USAGE, *args, says="choose another name")
        self.assertEqual((self.dir / name).read_bytes(), before)

    def test_reports_and_meshes_over_the_recording(self):
        self.unchanged("rec/recording.json", "reconstruct", "rec", "-o", "o.ply", "--report", "rec/recording.json")
        os.link(self.dir / "rec/recording.json", self.dir / "other.json")
        self.unchanged("rec/recording.json", "reconstruct", "rec", "-o", "o.ply", "--report", "other.json")
        self.unchanged("rec/recording.json", "calibrate", "rec", "--json", "rec/recording.json")

    def test_pictures_of_the_mesh_over_the_mesh(self):
        self.unchanged("s.ply", "simulate", "s.ply", "--unit", "m", "--coverage", "s.ply")
        self.unchanged("s.ply", "evaluate", "s.ply", "--reference", "s.ply", "--error-map", "s.ply")
        os.symlink("s.ply", self.dir / "link.ply")
        self.unchanged("s.ply", "evaluate", "s.ply", "--reference", "s.ply", "--error-map", "link.ply")

    def test_two_outputs_into_one_file(self):
        self.refused(USAGE, "reconstruct", "rec", "-o", "a.ply", "--save-stage", "fitted=a.ply",
                     says="two outputs")
        self.refused(USAGE, "reconstruct", "rec", "-o", "a.ply", "--save-stage", "fitted=a-1.ply",
                     says=("two outputs", "several objects"))
        self.assertFalse((self.dir / "a.ply").exists())

    def test_the_second_object_over_a_scan_of_the_recording(self):
        (self.dir / "rec/points").mkdir()
        (self.dir / "rec/points/view-2.ply").write_text(ply_cube(0.1))
        self.unchanged("rec/points/view-2.ply", "reconstruct", "rec", "-o", "rec/points/view.ply")


class Surroundings(harness.TestCase):
    def test_closed_standard_streams(self):
        def close_all():
            for descriptor in (0, 1, 2):
                os.close(descriptor)

        process = subprocess.Popen([harness.BIN, "simulate", "builtin:cylinder", "--frames", "3", "-o", "c"],
                                   cwd=self.dir, preexec_fn=close_all)
        self.assertEqual(process.wait(timeout=harness.HANG_S), 0)
        lines = (self.dir / "c/frames.csv").read_text().splitlines()
        self.assertTrue(lines[0].startswith("index,"))
        self.assertEqual(len(lines), 4)

    CAMERA = "virtual:cylinder?sensor=kinect-v1&fps=3&speed=36deg/s&calibration=true"
    SCAN = ("scan", "--device", CAMERA, "-o", "m.ply", "--no-wait", *harness.FAST)

    def three_frames(self, name):
        return recordings.copy(recordings.folder_of("three-frames"), self.dir / name)

    def unfinished(self, name="r"):
        path = self.three_frames(name) / "recording.json"
        described = json.loads(path.read_text())
        described["complete"] = False
        del described["frame_count"]  # which says that it was complete once
        path.write_text(json.dumps(described))

    def test_a_recording_that_was_complete_once_is_not_removed(self):
        path = self.three_frames("r") / "recording.json"
        path.write_text(path.read_text().replace('"complete": true', '"complete": false'))
        before = self.files()
        self.refused(FAILED, "simulate", "builtin:cylinder", "--frames", "3", "-o", "r",
                     "--overwrite-unfinished", says="never overwritten")
        self.assertEqual(self.files(), before)

    def test_what_an_unfinished_recording_needs_is_said(self):
        harness.foreign_scan(self.dir / "foreign")
        for args in (("simulate", "builtin:cylinder", "--frames", "3", "-o", "r"),
                     ("import", "foreign", "-o", "r", "--depth-unit", "1mm"),
                     ("capture", "--device", self.CAMERA, "--frames", "3", "-o", "r"),
                     (*self.SCAN, "--recording", "r")):
            with self.subTest(command=args[0]):
                harness.remove(self.dir / "r")
                self.unfinished()
                self.refused(FAILED, *args, says=("--repair", "--overwrite-unfinished"))
                self.ok(*args, "--overwrite-unfinished", "--quiet")
                self.refused(FAILED, *args, "--overwrite-unfinished", says="never overwritten")

    def test_a_scan_takes_the_name_of_an_unfinished_one(self):
        self.unfinished("m.recording")
        self.ok(*self.SCAN, "--overwrite-unfinished", "--quiet")
        self.assertFalse((self.dir / "m-2.recording").exists())
        self.ok(*self.SCAN, "--overwrite-unfinished", "--quiet")
        self.assertTrue((self.dir / "m-2.recording").exists())

    def test_an_unfinished_recording_stays_where_no_new_one_can_be_made(self):
        self.unfinished()
        before = self.files()
        again = ("-o", "r", "--overwrite-unfinished")
        self.refused(FAILED, "capture", "--device", "replay:none", "--frames", "3", *again)
        self.refused(FAILED, "import", "none", *again)
        self.refused(FAILED, "simulate", "none.ply", *again)
        self.refused(USAGE, "capture", "--device", "replay:r", "--frames", "3", *again, says="would be removed")
        self.refused(USAGE, "simulate", "r/truth/object.ply", *again, says="would be removed")
        self.assertEqual(self.files(), before)

    def test_control_characters_are_shown(self):
        path = self.three_frames("r") / "recording.json"
        path.write_text(path.read_text().replace('"model": "', '"model": "\\u001b[31m\\nframes: 99'))
        shown = self.ok("info", "r").stdout
        self.assertIn("\\u001b[31m\\u000aframes: 99", shown)
        self.assertNotIn("\x1b", shown)
        refused = self.refused(FAILED, "info", "\x1b[31m")
        self.assertIn("\\u001b[31m", refused.stderr)

    def test_two_dashes_end_the_options(self):
        (self.dir / "-m.ply").write_text(ply_cube(0.1))
        self.assertIn("triangles", self.ok("info", "--unit", "m", "--", "-m.ply").stdout)


class Unreadable(harness.TestCase):
    """What may not be read, or is something else, is not called missing. The superuser may read all, so
    that the tests let nobody try."""

    NOBODY = 65534

    def setUp(self):
        super().setUp()
        self.dir.chmod(0o755)
        self.more = {"user": self.NOBODY, "group": self.NOBODY} if os.geteuid() == 0 else {}
        if self.more and run("--version", cwd="/", **self.more).returncode != 0:
            self.skipTest("the program lies where only the superuser may start it")
        (self.dir / "closed").mkdir()
        (self.dir / "m.ply").write_text(ply_cube(0.1))
        recordings.copy(shared_recording(), self.dir / "rec")

    def not_missing(self, *args, says="ermission"):
        result = run(*args, "--quiet", cwd=self.dir, **self.more)
        self.assertIn(result.returncode, (FAILED, USAGE), result.stderr)
        self.assert_one_line_error(result.stderr, args)
        shown = result.stderr
        self.assertIn(says, shown)
        for word in ("no such", "missing", "does not exist", "not found", "no recording"):
            self.assertNotIn(word, shown)

    def everything_that_reads(self, folder):
        yield "info", f"{folder}/rec"
        yield "reconstruct", f"{folder}/rec", "-o", "out/m.ply"
        yield "reconstruct", "rec", "-o", "out/m.ply", "--turntable", f"{folder}/t.json"
        yield "calibrate", f"{folder}/rec", "--from-motion"
        yield "calibrate", "rec", "--points", f"{folder}/t.csv"
        yield "evaluate", f"{folder}/m.ply", "--reference", "m.ply"
        yield "render", f"{folder}/m.ply", "-o", "out/m.png"
        yield "simulate", f"{folder}/m.ply", "--unit", "m", "-o", "out/r"
        yield "simulate", "builtin:cylinder", "--scanner", f"{folder}/s.toml", "-o", "out/r"
        yield "simulate", "--scene", f"{folder}/s.toml", "-o", "out/r"
        yield "capture", "--device", f"replay:{folder}/rec", "-o", "out/r"
        yield "capture", "--device", "virtual:cylinder", "--turntable", f"{folder}/t.json", "-o", "out/r"
        yield "reconstruct", "rec", "-o", "out/m.ply", "--config", f"{folder}/s.toml"

    def try_all(self, folder, **more):
        (self.dir / "out").mkdir()
        (self.dir / "out").chmod(0o777)
        for args in self.everything_that_reads(folder):
            with self.subTest(args=args):
                self.not_missing(*args, **more)

    def test_in_a_folder_that_is_closed(self):
        (self.dir / "closed").chmod(0)
        self.not_missing("info", "closed/m.ply")
        self.not_missing("import", "closed/data", "-o", "out/r")
        self.try_all("closed")

    def test_a_file_that_is_closed(self):
        folder = self.dir / "closed"
        shutil.copytree(self.dir / "rec", folder / "rec")
        for name in ("m.ply", "s.toml", "t.json", "t.csv"):
            (folder / name).write_text("")
        for path in folder.rglob("*"):
            if path.is_file():
                path.chmod(0)
        self.try_all("closed")

    def test_a_folder_where_a_file_belongs(self):
        for name in ("m.ply", "s.toml", "t.json", "t.csv", "rec/recording.json"):
            (self.dir / "closed" / name).mkdir(parents=True)
        self.try_all("closed", says="")

    def test_an_output_in_a_folder_that_is_closed(self):
        (self.dir / "closed").chmod(0)
        for args in (("-o", "closed/m.ply"), ("-o", "closed/below/m.ply"), ("-o", "m.ply/m.ply"),
                     ("-o", "new.ply", "--report", "closed/r.json"),
                     ("-o", "new.ply", "--report", "closed/below/r.json")):
            with self.subTest(args=args):
                self.not_missing("reconstruct", "rec", *args, says="")


class FarAway(harness.TestCase):
    def far_mesh(self):
        path = self.dir / "far.ply"
        path.write_text(ply_cube(0.1).replace(" 0.1 ", " 1e20 "))
        return path

    def test_meshes_are_refused(self):
        mesh = self.far_mesh()
        for args in (("render", mesh, "-o", "r.png"), ("info", mesh),
                     ("simulate", mesh, "--unit", "m", "--coverage", "c.ply")):
            self.refused(FAILED, *args, says="from the origin")


class WaitingFiles(harness.TestCase):
    """Files that would keep a reader waiting, or working, for ever."""

    def setUp(self):
        super().setUp()
        os.mkfifo(self.dir / "pipe")

    def test_a_reference_to_a_pipe(self):
        (self.dir / "m.gltf").write_text(json.dumps({
            "asset": {"version": "2.0"}, "buffers": [{"uri": "pipe", "byteLength": 36}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}],
            "scenes": [{"nodes": [0]}]}))
        self.refused(FAILED, "info", "m.gltf", says="pipe")
        (self.dir / "m.obj").write_text("mtllib pipe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.ok("info", "m.obj", "--unit", "m")

    def test_a_pipe(self):
        for args in (("info", "pipe"), ("import", "pipe", "-o", "r"), ("reconstruct", "pipe", "-o", "m.ply"),
                     ("capture", "--device", "openni2:pipe", "-o", "r", "--frames", "2"),
                     ("reconstruct", shared_recording(), "-o", "m.ply", "--turntable", "pipe")):
            self.refused(FAILED, *args, says="pipe")

    def test_more_behind_the_rows_of_an_image(self):
        scan = harness.foreign_scan(self.dir / "scan")
        (scan / "frame-000001.depth.png").write_bytes(png16(32, 24, 1000, behind=1 << 28))
        self.refused(FAILED, "import", "scan", "-o", "r", "--depth-unit", "1mm", says="behind its rows")


class Hostile3mf(harness.TestCase):
    """Small 3MF files that mean a lot. One of them took 60 s and another 4.9 GB."""

    MESH = ('<object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="9" y="0" z="0"/>'
            '<vertex x="0" y="9" z="0"/><vertex x="0" y="0" z="9"/>%s</vertices><triangles>'
            '<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="0" v2="3" v3="2"/>'
            '<triangle v1="1" v2="2" v3="3"/></triangles></mesh></object>')
    MAIN = "http://schemas.openxmlformats.org/package/2006/"

    def put(self, objects, items):
        with zipfile.ZipFile(self.dir / "m.3mf", "w", zipfile.ZIP_DEFLATED) as file:
            file.writestr("[Content_Types].xml", f'<Types xmlns="{self.MAIN}content-types"><Default '
                          'Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
                          '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-'
                          '3dmodel+xml"/></Types>')
            file.writestr("_rels/.rels", f'<Relationships xmlns="{self.MAIN}relationships"><Relationship '
                          'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" '
                          'Target="/3D/3dmodel.model" Id="rel0"/></Relationships>')
            file.writestr("3D/3dmodel.model", '<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" '
                          'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
                          f'{objects}</resources><build>{items}</build></model>')

    def tree(self, levels):
        return "".join(f'<object id="{i}" type="model"><components><component objectid="{i - 1}"/>'
                       f'<component objectid="{i - 1}"/></components></object>' for i in range(2, levels + 2))

    def refused_soon(self, says):
        before = os.times()
        self.refused(FAILED, "info", "m.3mf", says=says)
        after = os.times()
        used = sum(after[2:4]) - sum(before[2:4])
        self.assertLess(used, 20.0)

    def test_a_sound_one_is_read(self):
        self.put(self.MESH % "" + self.tree(4), '<item objectid="5"/>')
        self.assertIn("64", self.ok("info", "m.3mf").stdout)

    def test_objects_of_objects(self):
        self.put(self.MESH % "" + self.tree(24), '<item objectid="25"/>')
        self.refused_soon("places more than")

    def test_a_mesh_that_is_placed_often(self):
        self.put(self.MESH % ('<vertex x="0" y="0" z="0"/>' * 100000), '<item objectid="1"/>' * 400)
        self.refused_soon("out of proportion")

    def test_more_objects_than_its_library_can_count(self):
        self.put(self.MESH % "", '<item objectid="1"/>' * 300000)
        self.refused_soon("more time than a sound file")


class OutOfProportion(harness.TestCase):
    """A few kilobytes that ask for gigabytes or minutes: refused, or read, at a low price."""

    MOST_S = 2.0
    MOST_MB = 300

    def record(self, data, **fields):
        """A record of a ROS bag."""
        header = b"".join(struct.pack("<I", len(name) + 1 + len(value)) + name.encode() + b"=" + value
                          for name, value in fields.items())
        return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data

    def number(self, value):
        return struct.pack("<I", value)

    def connection(self, number, topic, kind="sensor_msgs/Image"):
        return self.record(
            self.record(b"", type=kind.encode())[4:-4], op=b"\x07", conn=self.number(number), topic=topic.encode())

    def chunk(self, content, packing="bz2"):
        packed = bz2.compress(content) if packing == "bz2" else content
        return self.record(packed, op=b"\x05", compression=packing.encode(), size=self.number(len(content)))

    def put(self, name, *parts):
        (self.dir / name).write_bytes(b"".join(parts))

    def put_bag(self, *records):
        self.put("a.bag", b"#ROSBAG V2.0\n", *records)

    def cheap(self, *args, says=None, seconds=MOST_S):
        """Neither much time nor memory, helpers included."""
        process = start("info", *args, "--quiet", cwd=self.dir, stdout=subprocess.DEVNULL)
        err = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        process.stderr.close()
        if says is None:
            self.assertEqual((process.returncode, err), (0, ""))
        else:
            self.assertEqual(process.returncode, FAILED, err)
            self.assert_one_line_error(err)
            self.assertIn(says, err)
        self.assertLess(used.ru_utime + used.ru_stime, seconds)
        self.assertLess(used.ru_maxrss / 1000, self.MOST_MB)

    def test_chunks_of_a_bag_that_unpack_to_gigabytes(self):
        self.put_bag(self.connection(0, "/depth"), self.chunk(bytes(60 << 20)) * 40)
        self.cheap("a.bag", says="out of all proportion")

    def image(self, seq, stamp_s):
        """A message with a depth image of 2 x 2 pixels."""
        data = (self.number(seq) + self.number(stamp_s) + self.number(0) + self.number(1) + b"d" + self.number(2) +
                self.number(2) + self.number(5) + b"16UC1" + b"\0" + self.number(4) + self.number(8) + bytes(8))
        return self.record(data, op=b"\x02", conn=self.number(0), time=self.number(stamp_s) + bytes(4))

    def test_a_chunk_of_a_bag_that_every_message_is_in(self):
        content = self.image(1, 1) + self.record(bytes(40 << 20), op=b"\x02", conn=self.number(0), time=bytes(8))
        index = self.record(struct.pack("<III", 1, 0, 0) * 2000, op=b"\x04", ver=self.number(1),
                            conn=self.number(0), count=self.number(2000))
        self.put_bag(self.connection(0, "/depth/image_raw"), self.chunk(content), index)
        self.cheap("a.bag", "--import", "intrinsics=2,2,1,1")

    def test_more_messages_than_a_bag_of_its_length_has(self):
        message = self.record(b"", op=b"\x02", conn=self.number(0), time=bytes(8))
        self.put_bag(self.connection(0, "/depth"), self.chunk(message * 700000))
        self.cheap("a.bag", says="out of all proportion")

    def test_topics_without_number(self):
        content = b"".join(self.record(b"", op=b"\x02", conn=self.number(k), time=bytes(8)) for k in range(50000))
        self.put_bag(*(self.connection(k, f"/camera{k}/depth") for k in range(50000)), self.chunk(content, "none"))
        self.cheap("a.bag", says="no topic is recognised as depth")

    def test_frames_that_a_bag_only_counts(self):
        # Every second number is 1000 further on.
        numbers = [k // 2 * 1001 + k % 2 for k in range(4000)]
        self.put_bag(self.connection(0, "/depth/image_raw"),
                     self.chunk(b"".join(self.image(k, k // 1000 + 1) for k in numbers)))
        self.cheap("a.bag", "--import", "intrinsics=2,2,1,1", says="out of all proportion")

    def put_r3d(self, side, entries=(), description=()):
        with zipfile.ZipFile(self.dir / "a.r3d", "w", zipfile.ZIP_DEFLATED) as file:
            file.writestr("metadata", json.dumps({"w": side, "h": side, "dw": side, "dh": side, "fps": 60,
                                                  "K": [500, 0, 0, 0, 500, 0, side / 2, side / 2, 1],
                                                  **dict(description)}))
            file.writestr("rgbd/0.depth", "x")
            for name in entries:
                file.writestr(name, "x")

    def test_depth_and_colours_with_pixels_without_number(self):
        (self.dir / "depth").mkdir()
        options = ("--import", "intrinsics=500,500,8,6", "--import", "depth-unit=1mm", "--import", "fps=10")
        for width, cheap in ((4096, {}), (8192, {"says": "at most 12582912"})):
            image = png16(width, 3072, 1000)
            for i in range(8):
                (self.dir / f"depth/{i}.png").write_bytes(image)
            self.cheap("depth", *options, seconds=20.0, **cheap)

    def test_attributes_of_an_image_without_number(self):
        (self.dir / "depth").mkdir()
        head = b"".join(b"k%d\0string\0" % k + self.number(1) + b"x" for k in range(100000))
        self.put("depth/0.exr", b"\x76\x2f\x31\x01", self.number(2), head, b"\0")
        self.cheap("depth", "--import", "intrinsics=500,500,8,6", says="far too long")

    def test_a_phone_with_pixels_without_number(self):
        self.put_r3d(8192)
        self.cheap("a.r3d", says="a phone's have at most")

    def test_an_archive_of_frames_that_are_none(self):
        self.put_r3d(192, (f"rgbd/{k}.depth" for k in range(1, 9000)))
        self.cheap("a.r3d", says="out of all proportion")

    def test_a_description_of_a_phone_that_unpacks_to_gigabytes(self):
        # 30 KB, 16 MB of text, half a gigabyte of values.
        self.put_r3d(192, description={"poses": [[]] * 4000000})
        self.cheap("a.r3d", says="out of all proportion")

    def test_a_description_of_frames_that_are_empty(self):
        (self.dir / "transforms.json").write_text(json.dumps({"frames": [{}] * 3000000}))
        self.cheap(".", says="out of all proportion")

    def test_a_list_of_frames_without_number(self):
        (self.dir / "depth.txt").write_text("".join(f"{k} d.png\n" for k in range(900000)))
        (self.dir / "d.png").write_bytes(png16(4, 3, 1000))
        self.cheap(".", "--import", "intrinsics=500,500,2,1", says="more than 100000 frames")

    def put_glb(self, nodes, primitives, vertices):
        data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) * (vertices // 3)
        model = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(nodes))}],
                 "nodes": [{"mesh": 0}] * nodes,
                 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}] * primitives}],
                 "accessors": [{"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3",
                                "min": [0, 0, 0], "max": [1, 1, 0]}],
                 "bufferViews": [{"buffer": 0, "byteLength": len(data)}], "buffers": [{"byteLength": len(data)}]}
        text = json.dumps(model).encode()
        text += b" " * (-len(text) % 4)
        self.put("m.glb", struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)),
                 struct.pack("<I4s", len(text), b"JSON"), text, struct.pack("<I4s", len(data), b"BIN\0"), data)

    def test_a_mesh_that_a_scene_places_often(self):
        self.put_glb(nodes=3, primitives=1, vertices=3000)
        self.cheap("m.glb")
        self.put_glb(nodes=3000, primitives=1, vertices=9000)
        self.cheap("m.glb", says="out of proportion")

    def test_a_mesh_that_has_its_parts_often(self):
        self.put_glb(nodes=1, primitives=3000, vertices=9000)
        self.cheap("m.glb", says="out of proportion")

    def test_a_material_library_that_is_named_often(self):
        (self.dir / "a.mtl").write_text("newmtl m\nmap_Kd p.png\n" * 30000)
        (self.dir / "a.obj").write_text("mtllib a.mtl\nmtllib ./a.mtl\n" * 20000 +
                                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.cheap("a.obj")

    def test_materials_without_number(self):
        (self.dir / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n" +
                                          "".join(f"usemtl m{k}\n" for k in range(200000)) + "f 1 2 3\n")
        self.cheap("a.obj")


    def put_slivers(self, name, corners):
        """One face, which becomes as many slivers at one vertex."""
        (self.dir / name).write_text(
            "".join(f"v {k % 640} {k // 640} 0\n" for k in range(corners)) + "f "
            + " ".join(str(k + 1) for k in range(corners)) + "\n")

    def test_a_face_of_corners_without_number(self):
        # All slivers lie near each other; with all their pairs it would take half a minute.
        self.put_slivers("m.obj", 400000)
        self.cheap("m.obj", "--unit", "mm", seconds=8.0)

    def test_objects_of_a_mesh_without_number(self):
        self.put("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", b"o a\nf 1 2 3\n" * 300000)
        self.cheap("m.obj", says="out of all proportion")

    def test_a_field_of_a_table_that_does_not_end(self):
        recordings.copy(recordings.folder_of("three-frames"), self.dir / "r")
        (self.dir / "r" / "frames.csv").write_bytes(b"index,time_s,file\n0,0,\"" + b"a" * 120000000 + b"\"\n")
        self.cheap("r", says="more than 4096 bytes")

    def test_cameras_of_a_scene_without_number(self):
        (self.dir / "scene" / "depth").mkdir(parents=True)
        cameras = {str(k): {"cam_K": [500, 0, 8, 0, 500, 6, 0, 0, 1], "depth_scale": 1} for k in range(250000)}
        (self.dir / "scene" / "scene_camera.json").write_text(json.dumps(cameras, separators=(",", ":")))
        (self.dir / "scene" / "scene_gt.json").write_text("{}")
        self.cheap("scene", says="no pose", seconds=4.0)


class HangUp(harness.TestCase):
    def test_ends_a_capture_in_order(self):
        process = start("capture", "--device", "virtual:letter-a?sensor=kinect-v2&realtime=1&frames=6000",
                        "-o", "r", "--seconds", "300", cwd=self.dir)
        index = self.dir / "r/frames.csv"
        end = time.monotonic() + harness.HANG_S
        while not index.exists() or index.read_text().count("\n") < 5:
            self.assertIsNone(process.poll())
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        os.kill(process.pid, signal.SIGHUP)
        _, err = process.communicate(timeout=harness.HANG_S)
        self.assertEqual(process.returncode, harness.CANCELLED, err)
        self.assertIn("is complete", err)
        self.assertGreaterEqual(json.loads(self.ok("info", "r", "--json").stdout)["frames"], 4)

    def test_leaves_nothing_of_a_reconstruction(self):
        process = start("reconstruct", shared_recording(), "-o", "m.ply", "--voxel-size", "0.6mm",
                        cwd=self.dir)
        process.stderr.readline()
        os.kill(process.pid, signal.SIGHUP)
        _, err = process.communicate(timeout=harness.HANG_S)
        self.assertEqual(process.returncode, harness.CANCELLED, err)
        self.assertEqual(self.files(), [])


class Term(harness.TestCase):
    """SIGTERM at random moments: how much the program still works for it. FAULTS_FULL=1: 50 moments
    of each command. Processor time, so that other programs do not count."""

    MOMENTS = 50 if os.environ.get("FAULTS_FULL") == "1" else 3
    MOST_S = 1.0

    def processor_seconds(self, pid):
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def lag(self, args, delay):
        process = start(*args, "--quiet", cwd=self.dir)
        time.sleep(delay)
        try:
            before = self.processor_seconds(process.pid)
        except (OSError, IndexError):
            before = None
        # Not send_signal(), which reaps a process that has already ended.
        os.kill(process.pid, signal.SIGTERM)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        process.communicate()
        if before is None or process.returncode not in (130, -signal.SIGTERM):
            return 0.0
        return used.ru_utime + used.ru_stime - before

    def every_moment(self, *args):
        begin = time.monotonic()
        self.ok(*args, "--quiet")
        whole = time.monotonic() - begin
        generator = random.Random(str(args[0]))
        lags = []
        for _ in range(self.MOMENTS):
            for name in self.files():
                if (self.dir / name).is_dir():
                    harness.remove(self.dir / name)
                else:
                    (self.dir / name).unlink(missing_ok=True)
            lags.append(self.lag(args, generator.uniform(0.02, 1.0) * whole))
        print(f"{args[0]}: {self.MOMENTS} moments, longest lag {max(lags):.2f} s of processor", flush=True)
        self.assertLess(max(lags), self.MOST_S * os.cpu_count())

    def input_folder(self):
        """Beside self.dir, which every run finds empty."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix="turnscan-e2e-inputs-"))
        self.addCleanup(harness.remove, folder)
        return folder

    def test_reconstruct_finely(self):
        self.every_moment("reconstruct", shared_recording(), "-o", "m.ply", "--voxel-size", "0.8mm")

    def test_simulate(self):
        self.every_moment("simulate", "builtin:doll", "--frames", "8", "-o", "r")

    def test_calibrate(self):
        # Many pixels in few frames: what looks at all pixels of one image at once has to stop, too.
        inputs = self.input_folder()
        (inputs / "fine.toml").write_text(
            'name = "fine"\nkind = "matrix"\nsensing = "ideal"\nnear = "10mm"\nfar = "6.5m"\ncolumns = 1536\n'
            'rows = 1152\nfy = 1800\ndepth-unit = "0.1mm"\n')
        recording = inputs / "fine"
        self.ok("simulate", "builtin:letter-a", "--scanner", inputs / "fine.toml", "--distance", "0.6m",
                "--frames", "6", "--noise", "gaussian:0.3mm", "-o", recording, "--quiet")
        self.every_moment("calibrate", recording, "--detect", "--json", "c.json")

    def test_find_the_motion(self):
        self.every_moment("calibrate", shared_recording(), "--from-motion", "--json", "c.json")

    def test_evaluate(self):
        mesh = self.input_folder() / "m.ply"
        self.ok("reconstruct", shared_recording(), "-o", mesh, "--quiet")
        self.every_moment("evaluate", mesh, "--reference", mesh, "--error-map", "e.ply")

    def test_evaluate_slivers(self):
        # A nearest point looks at all of them, and there are hundreds of thousands of points.
        OutOfProportion.put_slivers(self, "m.obj", 400000)
        for delay in (1.5, 4.0, 8.0):
            lag = self.lag(["evaluate", "m.obj", "--reference", "m.obj", "--unit", "mm"], delay)
            self.assertLess(lag, self.MOST_S * os.cpu_count(), delay)

    def test_open_a_recording_of_many_frames(self):
        recording = self.input_folder() / "r"
        recordings.copy(recordings.folder_of("three-frames"), recording)
        (recording / "frames.csv").write_text(
            "index,time_s,file\n" + "".join(f"{k},{k},depth/000000.png\n" for k in range(300000)))
        self.every_moment("info", recording)

    def test_look_at_a_mesh_of_a_million_triangles(self):
        mesh = self.input_folder() / "m.ply"
        n = 800
        rows = [struct.pack("<3f", x, y, (x * 7 + y * 11) % 5) for y in range(n) for x in range(n)]
        faces = [struct.pack("<B3iB3i", 3, k, k + 1, k + n, 3, k + 1, k + n + 1, k + n)
                 for k in range(n * (n - 1)) if k % n != n - 1]
        head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {n * n}\nproperty float x\n"
                f"property float y\nproperty float z\nelement face {2 * len(faces)}\n"
                "property list uchar int vertex_indices\nend_header\n")
        mesh.write_bytes(head.encode() + b"".join(rows) + b"".join(faces))
        self.every_moment("info", mesh, "--unit", "mm")

    def test_render(self):
        self.every_moment("demo", "--object", "cylinder", "--frames", "12", "--picture-size", "256", "--out", "d")


if __name__ == "__main__":
    harness.main()
