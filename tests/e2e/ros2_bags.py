"""Bags of ROS 2, written from the formats' own definitions: MCAP (https://mcap.dev/spec), the database of
rosbag2_storage_sqlite3 by Python's sqlite3, and messages in CDR (OMG's DDS-XTYPES, plain CDR version 1).
Python's standard library, and the compressors by their C interface."""

import ctypes
import ctypes.util
import sqlite3
import struct
import zlib


def packed(library, bound, pack, data, *more):
    lib = ctypes.CDLL(ctypes.util.find_library(library))
    size = ctypes.c_size_t
    functions = getattr(lib, bound), getattr(lib, pack)
    for function in functions:
        function.restype = size
    room = ctypes.create_string_buffer(functions[0](size(len(data)), None))
    length = functions[1](room, size(len(room)), data, size(len(data)), *more)
    return room.raw[:length]


def zstd(data):
    return packed("zstd", "ZSTD_compressBound", "ZSTD_compress", data, 3)


def lz4(data):
    return packed("lz4", "LZ4F_compressFrameBound", "LZ4F_compressFrame", data, None)


PACKERS = {"": lambda data: data, "lz4": lz4, "zstd": zstd}


class Cdr:
    """Numbers stand at a multiple of their size behind the four bytes of the head."""

    def __init__(self, order="<"):
        self.order, self.body = order, bytearray()

    def number(self, kind, *values):
        for value in values:
            self.body += bytes(-len(self.body) % struct.calcsize(kind))
            self.body += struct.pack(self.order + kind, value)
        return self

    def text(self, value):
        return self.raw(value.encode() + b"\0")

    def raw(self, data):
        self.number("I", len(data)).body.extend(data)
        return self

    def header(self, time_ns, frame):
        return self.number("i", time_ns // 10**9).number("I", time_ns % 10**9).text(frame)

    def done(self):
        return bytes([0, self.order == "<", 0, 0]) + bytes(self.body)


class Ros1(Cdr):
    """The same messages as ROS 1 packs them: no gaps, no zero behind a text, a number in the header."""

    def number(self, kind, *values):
        for value in values:
            self.body += struct.pack("<" + kind, value)
        return self

    def text(self, value):
        return self.raw(value.encode())

    def header(self, time_ns, frame):
        self.number("I", 0)
        return super().header(time_ns, frame)

    def done(self):
        return bytes(self.body)


def image(time_ns, frame, width, height, encoding, pixels, wire=Cdr):
    return (wire().header(time_ns, frame).number("I", height, width).text(encoding).number("B", 0)
            .number("I", len(pixels) // height).raw(pixels).done())


def compressed(time_ns, frame, form, data, wire=Cdr):
    return wire().header(time_ns, frame).text(form).raw(data).done()


def camera_info(time_ns, frame, k, width, height, wire=Cdr):
    fx, fy, cx, cy = k
    out = wire().header(time_ns, frame).number("I", height, width).text("plumb_bob").number("I", 5)
    out.number("d", *[0] * 5, fx, 0, cx, 0, fy, cy, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1)
    out.number("d", fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0)
    # binning_x, binning_y, roi (x_offset, y_offset, height, width, do_rectify)
    return out.number("I", 0, 0, 0, 0, 0, 0).number("B", 0).done()


def transforms(time_ns, parent, child, translation, wire=Cdr):
    return (wire().number("I", 1).header(time_ns, parent).text(child).number("d", *translation, 0, 0, 0, 1)
            .done())


class Message:
    def __init__(self, topic, kind, time_ns, data):
        self.topic, self.kind, self.time_ns, self.data = topic, kind, time_ns, data


def record(op, content):
    return struct.pack("<BQ", op, len(content)) + content


def text(value):
    return struct.pack("<I", len(value.encode())) + value.encode()


def mcap(messages, packing="", per_chunk=4, index=True, summary=True, wire="cdr", chunked=True):
    """The bytes of a file; without an index and a summary, one that was cut off."""
    kinds = sorted({m.kind for m in messages})
    topics = sorted({(m.topic, m.kind) for m in messages})
    schemas = [record(3, struct.pack("<H", i + 1) + text(kind) + text("ros2msg") + text("# ..."))
               for i, kind in enumerate(kinds)]
    channels = [record(4, struct.pack("<HH", i, kinds.index(kind) + 1) + text(topic) + text(wire) +
                       struct.pack("<I", len(text("qos") + text(""))) + text("qos") + text(""))
                for i, (topic, kind) in enumerate(topics)]
    numbers = {topic: i for i, (topic, _) in enumerate(topics)}
    out = b"\x89MCAP0\r\n" + record(1, text("ros2") + text("test"))
    known = set()
    for at in range(0, len(messages), per_chunk):
        body, places = b"", {}
        for sequence, m in enumerate(messages[at:at + per_chunk]):
            number = numbers[m.topic]
            if number not in known:
                known.add(number)
                body += schemas[kinds.index(m.kind)] + channels[number]
            places.setdefault(number, []).append((m.time_ns, len(body)))
            body += record(5, struct.pack("<HIQQ", number, sequence, m.time_ns, m.time_ns) + m.data)
        if not chunked:
            out += body
            continue
        packed = PACKERS[packing](body)
        times = [m.time_ns for m in messages[at:at + per_chunk]]
        out += record(6, struct.pack("<QQQI", min(times), max(times), len(body), zlib.crc32(body)) + text(packing) +
                      struct.pack("<Q", len(packed)) + packed)
        for number, entries in places.items() if index else ():
            listed = b"".join(struct.pack("<QQ", *entry) for entry in entries)
            out += record(7, struct.pack("<HI", number, len(listed)) + listed)
    if not summary:
        return out
    out += record(15, struct.pack("<I", 0))
    start = len(out)
    out += b"".join(schemas + channels)
    return out + record(2, struct.pack("<QQI", start, 0, 0)) + b"\x89MCAP0\r\n"


def db3(path, messages, compress=False):
    """As rosbag2_storage_sqlite3 makes it, schema version 3."""
    with sqlite3.connect(path) as database:
        database.executescript("""
            PRAGMA journal_mode=WAL;
            CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
            CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
            CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
                                serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
            CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                                  data BLOB NOT NULL);
            CREATE INDEX timestamp_idx ON messages (timestamp ASC);
            INSERT INTO schema VALUES (3, 'humble');""")
        topics = sorted({(m.topic, m.kind) for m in messages})
        database.executemany("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')",
                             [(i + 1, *topic) for i, topic in enumerate(topics)])
        database.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
                             [(topics.index((m.topic, m.kind)) + 1, m.time_ns, zstd(m.data) if compress else m.data)
                              for m in messages])
    database.close()


def metadata(names):
    files = "".join(f"    - {name}\n" for name in names)
    told = "".join(f"    - path: {name.rsplit('/', 1)[-1]}\n      starting_time:\n"
                   "        nanoseconds_since_epoch: 1\n      message_count: 3\n" for name in names)
    return ("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
            "  topics_with_message_count:\n    - topic_metadata:\n        name: /d\n"
            f"  relative_file_paths:\n{files}  files:\n{told}")
