"""Recordings of other programs, written here from a virtual scan after their published descriptions
with Python's zipfile, zlib and struct: the import has the same depths, cameras and times, and
reconstruct gives the mesh of the native recording."""

import json
import re
import struct
import zipfile
import zlib

import harness
from harness import FAILED, FAST

FRAMES = 24
SCANNER = """kind = "matrix"
sensing = "time-of-flight"
near = "0.3m"
far = "3m"
columns = 160
rows = 120
fy = 160
baseline = "30mm"
depth-unit = "0.1mm"
"""


def depth_png(path):
    """Width, height and values of a grey 16-bit PNG without interlacing."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", body)
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    raw, pitch, above, rows = zlib.decompress(packed), 2 * width, bytes(2 * width), []
    for y in range(height):
        kind, line = raw[y * (pitch + 1)], bytearray(raw[y * (pitch + 1) + 1:(y + 1) * (pitch + 1)])
        if kind:
            for i in range(pitch):
                left = line[i - 2] if i >= 2 else 0
                corner = above[i - 2] if i >= 2 else 0
                guess = left + above[i] - corner
                paeth = min((abs(guess - v), n, v) for n, v in enumerate((left, above[i], corner)))
                line[i] = (line[i] + (0, left, above[i], (left + above[i]) // 2, paeth[2])[kind]) & 255
        rows.append(bytes(line))
        above = line
    return width, height, struct.unpack(f">{width * height}H", b"".join(rows))


class Captures(harness.TestCase):
    def setUp(self):
        super().setUp()
        (self.dir / "small.toml").write_text(SCANNER)
        self.ok("simulate", "builtin:cylinder", "--scanner", "small.toml", "--frames", FRAMES,
                "--noise", "gaussian:0.5mm", "--out", "virtual", "--quiet")
        rec = self.dir / "virtual"
        head = json.loads((rec / "recording.json").read_text())
        self.sensor, self.table = head["sensors"][0], head["turntable"]
        self.camera = self.sensor["intrinsics"]
        lines = (rec / "frames.csv").read_text().splitlines()
        columns = lines[0].split(",")
        rows = [dict(zip(columns, line.split(","))) for line in lines[1:]]
        self.times = [float(row["time_s"]) for row in rows]
        self.assertEqual(self.sensor["depth_unit_m"], 1e-4)
        self.images = [depth_png(rec / row["file"])[2] for row in rows]
        # The native recording as a foreign one: the same depths, times and turntable.
        self.options = ["--turntable-axis", ",".join(map(str, self.table["axis"])),
                        "--turntable-center", ",".join(f"{v}m" for v in self.table["center_m"]),
                        "--speed", f"{self.table['speed_rad_s']}rad/s"]

    def test_calibrate_and_report_take_it_straight(self):
        self.put_native()
        imports = [f"--import={name[2:]}={value}"
                   for name, value in zip(self.options[::2], self.options[1::2])]
        self.ok("calibrate", "virtual", "--detect", "--json", "virtual.json", "--quiet")
        self.ok("calibrate", "native", "--detect", "--json", "native.json", "--quiet", *imports)
        axes = [re.search(r'"axis": *\[[^]]*\]', (self.dir / name).read_text()).group()
                for name in ("virtual.json", "native.json")]
        self.assertEqual(axes[0], axes[1])
        self.refused(2, "calibrate", "virtual", *imports, says=["is a recording already"])
        self.ok("report", "native", "-o", "page.html", *imports)
        self.assertIn("<html", (self.dir / "page.html").read_text())

    def put_native(self):
        """As json-png, which takes the images as they are."""
        folder = self.dir / "native"
        folder.mkdir()
        for i, png in enumerate(sorted((self.dir / "virtual" / "depth").iterdir())):
            (folder / f"depth_{i}.png").write_bytes(png.read_bytes())
        views = {"intrinsics": {**self.camera, "depth_unit_m": 1e-4}, "times_s": self.times}
        (folder / "views.json").write_text(json.dumps(views))

    def put_r3d(self, path):
        camera = self.camera
        metadata = {"w": camera["width"], "h": camera["height"], "dw": camera["width"],
                    "dh": camera["height"], "fps": 30,
                    # Column by column, from the corner of the image.
                    "K": [camera["fx"], 0, 0, 0, camera["fy"], 0, camera["cx"] + 0.5,
                          camera["cy"] + 0.5, 1],
                    "poses": [[0, 0, 0, 1, 1e-4 * (i % 3), 0, 0] for i in range(FRAMES)],
                    "frameTimestamps": [1000 + t for t in self.times]}
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for i, values in enumerate(self.images):
                raw = struct.pack(f"<{len(values)}f",
                                  *(0 if v == 65535 else v * 1e-4 for v in values))
                # LZFSE's blocks of stored bytes.
                archive.writestr(f"rgbd/{i}.depth",
                                 b"bvx-" + struct.pack("<I", len(raw)) + raw + b"bvx$")
            archive.writestr("metadata", json.dumps(metadata))

    def put_sens(self, path):
        camera = self.camera
        eye = struct.pack("<16f", *(1 if i % 5 == 0 else 0 for i in range(16)))
        intrinsics = struct.pack("<16f", camera["fx"], 0, camera["cx"], 0, 0, camera["fy"],
                                 camera["cy"], 0, 0, 0, 1, 0, 0, 0, 0, 1)
        with open(path, "wb") as file:
            file.write(struct.pack("<IQ", 4, 7) + b"virtual" + intrinsics + eye + intrinsics + eye)
            file.write(struct.pack("<iiIIIIfQ", -1, 1, 0, 0, camera["width"], camera["height"],
                                   1e4, FRAMES))
            for time, values in zip(self.times, self.images):
                packed = zlib.compress(struct.pack(f"<{len(values)}H", *values), 1)
                file.write(eye + struct.pack("<4Q", 0, round(time * 1e6) + 5000000, 0,
                                             len(packed)) + packed)

    def imported(self, source, *options):
        self.ok("import", source, *self.options, *options, "--out", f"{source}-rec", "--quiet")
        return self.dir / f"{source}-rec"

    def mesh(self, rec):
        self.ok("reconstruct", rec, *FAST, "-o", "m.ply", "--quiet")
        return (self.dir / "m.ply").read_bytes()

    def test_depths_cameras_times_and_the_mesh_are_those_of_the_native_recording(self):
        self.put_native()
        self.put_r3d(self.dir / "scan.r3d")
        self.put_sens(self.dir / "scan.sens")
        native = self.imported("native")
        mesh = self.mesh(native)
        for source in ("scan.r3d", "scan.sens"):
            rec = self.imported(source)
            head = json.loads((rec / "recording.json").read_text())
            sensor = head["sensors"][0]
            self.assertAlmostEqual(sensor["depth_unit_m"], 1e-4, delta=1e-12)
            for field, value in self.camera.items():
                if field != "distortion":
                    self.assertAlmostEqual(sensor["intrinsics"][field], value, delta=1e-4)
            self.assertTrue(any("the device stood still" in note for note in head["notes"]))
            names = sorted(p.name for p in (native / "depth").iterdir())
            self.assertEqual(sorted(p.name for p in (rec / "depth").iterdir()), names)
            for name in names[::5]:
                self.assertEqual(depth_png(rec / "depth" / name),
                                 depth_png(native / "depth" / name), (source, name))
            lines = (rec / "frames.csv").read_text().splitlines()
            column = lines[0].split(",").index("time_s")
            for line, time in zip(lines[1:], self.times):
                self.assertAlmostEqual(float(line.split(",")[column]), time - self.times[0],
                                       delta=1e-6)
            if source == "scan.r3d":  # .sens rounds cameras to floats and times to microseconds
                self.assertEqual(self.mesh(rec), mesh)

    def test_a_truncated_recording_keeps_its_whole_frames_and_a_broken_one_is_refused(self):
        self.put_sens(self.dir / "scan.sens")
        data = (self.dir / "scan.sens").read_bytes()
        (self.dir / "half.sens").write_bytes(data[:len(data) // 2])
        out = self.ok("import", "half.sens", "--out", "half").stdout
        self.assertIn("the file is cut off: its first", out)
        (self.dir / "none.sens").write_bytes(data[:40])
        self.refused(FAILED, "import", "none.sens", "--out", "none", says=("none.sens", "cut off"))
        (self.dir / "text.r3d").write_text("no archive")
        self.refused(FAILED, "import", "text.r3d", "--format", "record3d", "--out", "none",
                     says=("text.r3d", "no zip archive"))



class Klg(harness.TestCase):
    """Logger2's recordings, written as its header defines them."""

    def put(self, frames, stated=None, packed=True, colour=True):
        out = struct.pack("<i", len(frames) if stated is None else stated)
        for i, depth in enumerate(frames):
            rows = struct.pack("<307200H", *depth)
            rows = zlib.compress(rows, 1) if packed else rows
            pixels = bytes((200, 100, i)) * 307200 if colour else b""
            out += struct.pack("<qii", 1_700_000_000_000_000 + 33_333 * i, len(rows), len(pixels)) + rows + pixels
        (self.dir / "a.klg").write_bytes(out)
        return out

    def frames(self):
        return [[700 + (x + 3 * i) % 200 if x % 7 else 0 for x in range(307200)] for i in range(3)]

    def test_a_recording_is_read(self):
        frames = self.frames()
        for packed, colour, stated in ((True, True, 3), (False, False, 0)):
            self.put(frames, stated, packed, colour)
            self.refused(FAILED, "import", "a.klg", "--out", "x", says="--intrinsics")
            harness.remove(self.dir / "got")
            self.ok("import", "a.klg", "--intrinsics", "528,528,320,240", "--out", "got", "--quiet")
            sensor = json.loads((self.dir / "got/recording.json").read_text())["sensors"][0]
            self.assertEqual(sensor["depth_unit_m"], 0.001)
            self.assertEqual(list(depth_png(self.dir / "got/depth/000001.png")[2]), frames[1])
            lines = (self.dir / "got/frames.csv").read_text().splitlines()
            self.assertAlmostEqual(float(lines[3].split(",")[1]), 0.066666, delta=1e-6)
            self.assertEqual((self.dir / "got/color").exists(), colour)

    def test_what_is_cut_off_or_none_says_so(self):
        whole = self.put(self.frames())
        (self.dir / "a.klg").write_bytes(whole[:-100])
        self.ok("import", "a.klg", "--intrinsics", "528,528,320,240", "--out", "got", "--quiet")
        self.assertIn("its first 2 frames of 3", (self.dir / "got/recording.json").read_text())
        for bad, says in ((whole[:3], "ends"), (b"\x01\0\0\0" + bytes(16), "unpack"), (whole[:1000], "no whole frame"),
                          (whole[:8] + b"\xff" * 12 + whole[20:], "no whole frame")):
            (self.dir / "a.klg").write_bytes(bad)
            self.refused(FAILED, "info", "a.klg", says=says)


if __name__ == "__main__":
    harness.main()
