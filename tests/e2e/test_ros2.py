"""Bags of ROS 2 (.mcap, .db3, the folder of rosbag2), written by ros2_bags.py: what is imported is what was
recorded, and what is damaged is refused or read as far as it is whole."""

import json
import shutil
import sqlite3
import struct
import time
import zlib

import harness
import recordings
import ros2_bags
from harness import FAILED, USAGE
from ros2_bags import Cdr, Message, Ros1
from test_export import read_png

DEPTH, INFO = "/camera/camera/depth/image_rect_raw", "/camera/camera/depth/camera_info"
BEGIN_NS = 1_700_000_000_123_456_789


def png(rows):
    """A grey PNG of 16 bits."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    packed = zlib.compress(b"".join(b"\0" + struct.pack(f">{len(row)}H", *row) for row in rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 16, 0, 0, 0, 0)) +
            chunk(b"IDAT", packed) + chunk(b"IEND", b""))


class Ros2(harness.TestCase):
    def setUp(self):
        super().setUp()
        recording = recordings.folder_of("three-frames")
        sensor = json.loads((recording / "recording.json").read_text())["sensors"][0]
        k = sensor["intrinsics"]
        self.k = [k["fx"], k["fy"], k["cx"], k["cy"]]
        self.unit = ("--depth-unit", f"{sensor['depth_unit_m']:.12f}m")
        self.unit_m = sensor["depth_unit_m"]
        self.images = [read_png(path) for path in sorted((recording / "depth").iterdir())]
        self.height, self.width = len(self.images[0]), len(self.images[0][0])

    def depth(self, rows, i, kind, wire):
        time_ns = BEGIN_NS + i * 33_333_333
        if kind == "compressed":
            return Message(f"{DEPTH}/compressedDepth", "sensor_msgs/msg/CompressedImage", time_ns,
                           ros2_bags.compressed(time_ns, "c", "16UC1; compressedDepth png", bytes(12) + png(rows), wire))
        values = [v for row in rows for v in row]
        if kind == "float":
            pixels = struct.pack(f"<{len(values)}f", *[v * self.unit_m if v else float("nan") for v in values])
        else:
            pixels = struct.pack(f"<{len(values)}H", *values)
        encoding = "32FC1" if kind == "float" else "16UC1"
        return Message(DEPTH, "sensor_msgs/msg/Image", time_ns,
                       ros2_bags.image(time_ns, "c", self.width, self.height, encoding, pixels, wire))

    def messages(self, kind="integer", wire=Cdr):
        out = []
        for i, rows in enumerate(self.images):
            out.append(self.depth(rows, i, kind, wire))
            time_ns = out[-1].time_ns
            out.append(Message(INFO, "sensor_msgs/msg/CameraInfo", time_ns,
                               ros2_bags.camera_info(time_ns, "c", self.k, self.width, self.height, wire)))
        out.append(Message("/tf_static", "tf2_msgs/msg/TFMessage", BEGIN_NS,
                           ros2_bags.transforms(BEGIN_NS, "base", "c", (0, 0, 1), wire)))
        return out

    def check(self, bag, *options, frames=3, says=""):
        """What is imported is what was recorded."""
        out = self.dir / "got"
        shutil.rmtree(out, ignore_errors=True)
        self.ok("import", bag, *options, "--out", out, "--quiet")
        facts = json.loads((out / "recording.json").read_text())
        self.assertIn(says, json.dumps(facts))
        k = facts["sensors"][0]["intrinsics"]
        self.assertEqual([k["fx"], k["fy"], k["cx"], k["cy"]], self.k)
        files = sorted((out / "depth").iterdir())
        self.assertEqual(len(files), frames)
        for path, rows in zip(files, self.images):
            self.assertEqual([list(row) for row in read_png(path)],
                             [[0 if v == 65535 else v for v in row] for row in rows])
        lines = (out / "frames.csv").read_text().splitlines()
        times = [float(line.split(",")[lines[0].split(",").index("time_s")]) for line in lines[1:]]
        for i, time_s in enumerate(times):
            self.assertAlmostEqual(time_s, i * 0.033333333, delta=2e-9)

    def test_mcap_is_read_however_it_is_packed(self):
        messages = self.messages()
        for packing in ros2_bags.PACKERS:
            for index in (True, False):
                (self.dir / "a.mcap").write_bytes(ros2_bags.mcap(messages, packing, index=index))
                self.check("a.mcap", *self.unit)
        (self.dir / "a.mcap").write_bytes(ros2_bags.mcap(messages, chunked=False))
        self.check("a.mcap", *self.unit)
        (self.dir / "a.mcap").write_bytes(ros2_bags.mcap(self.messages(wire=Ros1), "zstd", wire="ros1"))
        self.check("a.mcap", *self.unit)

    def test_every_kind_of_depth_is_read(self):
        for kind in ("float", "compressed"):
            (self.dir / "a.mcap").write_bytes(ros2_bags.mcap(self.messages(kind), "zstd"))
            self.check("a.mcap", *(self.unit if kind == "compressed" else ()))
        big = [Message(m.topic, m.kind, m.time_ns, m.data) for m in self.messages(wire=lambda: Cdr(">"))]
        (self.dir / "a.mcap").write_bytes(ros2_bags.mcap(big))
        self.check("a.mcap", *self.unit)

    def test_databases_and_folders_are_read(self):
        messages = self.messages()
        ros2_bags.db3(self.dir / "a.db3", messages)
        self.check("a.db3", *self.unit)
        ros2_bags.db3(self.dir / "b.db3", messages, compress=True)
        (self.dir / "b.db3").chmod(0o444)
        self.check("b.db3", *self.unit)
        packed = [Message(m.topic, m.kind, m.time_ns, ros2_bags.zstd(m.data)) for m in messages]
        for packing in ("", "lz4"):
            (self.dir / "b.mcap").write_bytes(ros2_bags.mcap(packed, packing))
            self.check("b.mcap", *self.unit)
        take = self.dir / "take"
        take.mkdir()
        ros2_bags.db3(take / "take_0.db3", messages[:3])
        self.check("take", *self.unit, frames=2)  # a recorder that was killed leaves no metadata.yaml
        ros2_bags.db3(take / "take_1.db3", messages[3:])
        self.refused(FAILED, "import", "take", "--out", "x", says=["2 bags", "ros2 bag reindex"])
        (take / "metadata.yaml").write_text(ros2_bags.metadata(["take/take_0.db3", "take/take_1.db3"]))
        self.check("take", *self.unit)
        said = self.ok("info", "take", "--import", "depth-unit=" + self.unit[1], "--json").stdout
        self.assertEqual(json.loads(said)["frames"], 3)

    def test_a_file_that_was_cut_off_is_read_as_far_as_it_is_whole(self):
        messages = self.messages()
        for packing in ros2_bags.PACKERS:
            for index in (True, False):
                whole, some = (ros2_bags.mcap(messages[:count], packing, per_chunk=2, index=index, summary=False)
                               for count in (6, 4))
                for size in (len(some), len(some) + 40, (len(some) + len(whole)) // 2):
                    (self.dir / "cut.mcap").write_bytes(whole[:size])
                    self.check("cut.mcap", *self.unit, frames=2, says="was not closed or is damaged")
        # The last whole message of an unpacked chunk that was not written to its end.
        whole = ros2_bags.mcap(messages, per_chunk=7, summary=False, index=False)
        (self.dir / "cut.mcap").write_bytes(whole[:len(whole) * 9 // 10])
        self.check("cut.mcap", *self.unit, frames=2, says="was not closed or is damaged")

    def test_damage_harms_nothing(self):
        mcap = ros2_bags.mcap(self.messages(), "lz4")
        ros2_bags.db3(self.dir / "a.db3", self.messages())
        for name, data in (("bad.mcap", mcap), ("bad.db3", (self.dir / "a.db3").read_bytes())):
            for i in range(24):
                bad = bytearray(data[:len(data) * (i + 1) // 24] if i % 3 == 0 else data)
                for at in range(i * 37 % 1000, len(bad), 4001 if i % 3 else len(bad)):
                    bad[at] ^= 0xff if i % 2 else 1 << i % 8
                (self.dir / name).write_bytes(bad)
                result = harness.run("info", name, "--quiet", cwd=self.dir, says_nan=True)
                self.assertIn(result.returncode, (0, FAILED), result.stderr)
                if result.returncode:
                    self.assert_one_line_error(result.stderr)

    def test_what_claims_too_much_is_refused_at_once(self):
        begin = time.monotonic()
        # Zeros without end: 64 chunks of 100 MB each, of some kilobytes.
        packed = ros2_bags.zstd(bytes(100 << 20))
        chunk = ros2_bags.record(6, struct.pack("<QQQI", 0, 0, 100 << 20, 0) + ros2_bags.text("zstd") +
                                 struct.pack("<Q", len(packed)) + packed)
        (self.dir / "bomb.mcap").write_bytes(b"\x89MCAP0\r\n" + chunk * 64)
        self.refused(FAILED, "info", "bomb.mcap", says="out of all proportion")
        for size, what in ((1 << 33, "larger than can be read"), ((1 << 64) - 1, "larger than can be read"),
                           (200 << 20, "larger than can be read")):
            chunk = ros2_bags.record(6, struct.pack("<QQQI", 0, 0, size, 0) + ros2_bags.text("zstd") +
                                     struct.pack("<Q", len(packed)) + packed)
            (self.dir / "bomb.mcap").write_bytes(b"\x89MCAP0\r\n" + chunk)
            self.refused(FAILED, "info", "bomb.mcap", says=what)
        (self.dir / "long.mcap").write_bytes(b"\x89MCAP0\r\n" + struct.pack("<BQ", 5, (1 << 64) - 1) + bytes(100))
        self.refused(FAILED, "info", "long.mcap", says="longer than what holds it")
        self.assertLess(time.monotonic() - begin, 20)

    def test_what_is_no_bag_of_images_says_so(self):
        (self.dir / "a.mcap").write_bytes(ros2_bags.mcap(self.messages(), wire="protobuf"))
        self.refused(FAILED, "info", "a.mcap", says=["protobuf", "cdr"])
        (self.dir / "b.mcap").write_bytes(ros2_bags.mcap(self.messages()).replace(b"MCAP0", b"MCAP9"))
        self.refused(FAILED, "info", "b.mcap", says="version")
        (self.dir / "c.db3").write_bytes(ros2_bags.zstd(bytes(1000)))
        self.refused(FAILED, "import", "c.db3", "--format", "rosbag", "--out", "x", says="unzstd")
        with sqlite3.connect(self.dir / "rtabmap.db") as database:
            database.execute("CREATE TABLE Node(id INTEGER)")
        database.close()
        self.refused(FAILED, "info", "rtabmap.db", says=["no ROS 2 bag", "rtabmap-export"])
        with sqlite3.connect(self.dir / "view.db3") as database:
            database.executescript("""
                CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);
                CREATE VIEW messages AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n)
                    SELECT id, 1 AS topic_id, 1 AS timestamp, x'00' AS data FROM n;""")
        database.close()
        self.refused(FAILED, "info", "view.db3", says="no ROS 2 bag")
        with sqlite3.connect(self.dir / "slow.db3") as database:
            database.executescript("""
                CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);
                CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, data BLOB,
                    timestamp INTEGER GENERATED ALWAYS AS (length(hex(zeroblob(60000000)))));
                INSERT INTO messages(topic_id, data) SELECT 1, x'00' FROM
                    (WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 50000) SELECT i FROM n);""")
        database.close()
        begin = time.monotonic()
        self.refused(FAILED, "info", "slow.db3", says="computed")
        self.assertLess(time.monotonic() - begin, 20)

    def test_which_topic_is_meant_is_asked(self):
        other = [Message(m.topic.replace("camera/depth", "rear/depth"), m.kind, m.time_ns, m.data)
                 for m in self.messages()[:-1]]
        (self.dir / "a.mcap").write_bytes(ros2_bags.mcap(self.messages() + other, "zstd"))
        self.refused(USAGE, "info", "a.mcap", says=["--topic", "/camera/rear/depth/image_rect_raw"])
        self.check("a.mcap", *self.unit, "--topic", DEPTH)
        self.refused(USAGE, "import", "a.mcap", "--topic", INFO, "--out", "x", says="holds no depth images")


if __name__ == "__main__":
    harness.main()
