"""The power fails at any moment of a recording.

What `turnscan capture` does to files is logged (fault_shim.cpp), then played back up to each
operation. Data that were not synced by then are lost in three ways: all of them, their second half,
or replaced by zeros. Each time the recording must open, or not be there yet; where nothing unsynced is
lost, with every frame whose line was written. See docs/reference/reliability.md.
"""

import os
import pathlib
import re
import struct
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import faults  # noqa: E402  (needs the path above)
import harness  # noqa: E402  (faults has added its place)

HEAD = re.compile(rb"(.) (\d+) (\d+) (\d+)\n")


def operations(log):
    at = 0
    while at < len(log):
        head = HEAD.match(log, at)
        at = head.end()
        parts = []
        for size in map(int, head.groups()[1:]):
            parts.append(log[at:at + size])
            at += size
        yield head[1].decode(), parts[0].decode(), parts[1].decode(), parts[2]


class Disk:
    """Files as names and contents; how much of each content is surely on the disk."""

    def __init__(self):
        self.files, self.folders = {}, []

    def apply(self, operation, name, other, data):
        if operation in "cT":
            file = self.files.setdefault(name, [bytearray(), 0])
            if operation == "T":
                file[0], file[1] = bytearray(), 0
        elif operation == "w":
            self.files[name][0] += data
        elif operation == "t":
            del self.files[name][0][struct.unpack("q", data)[0]:]
        elif operation == "s" and name in self.files:
            self.files[name][1] = len(self.files[name][0])
        elif operation == "S":
            for file in self.files.values():
                file[1] = len(file[0])
        elif operation == "r":
            self.files[other] = self.files.pop(name)
        elif operation == "x":
            self.files[name], self.files[other] = self.files[other], self.files[name]
        elif operation == "u":
            self.files.pop(name, None)
        elif operation == "d":
            self.folders.append(name)

    def put(self, source, target, loss):
        for folder in self.folders:
            (target / os.path.relpath(folder, source)).mkdir(parents=True, exist_ok=True)
        for name, (content, synced) in self.files.items():
            path = target / os.path.relpath(name, source)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(loss(bytes(content), synced))


LOSSES = {
    "nothing": lambda content, synced: content,
    "all": lambda content, synced: content[:synced],
    "half": lambda content, synced: content[:synced + (len(content) - synced) // 2],
    "zeros": lambda content, synced: content[:synced] + bytes(len(content) - synced),
}


def lines_written(disk, source):
    table = disk.files.get(str(source / "rec" / "frames.csv"))
    return max(table[0].count(b"\n") - 1, 0) if table else 0


def main():
    if not faults.SHIM:
        print("the shim was not built")
        return 77
    base = pathlib.Path(os.path.realpath(tempfile.mkdtemp(prefix="turnscan-power-")))
    try:
        return replay(base)
    finally:
        harness.remove(base)


def replay(base):
    capture = next(s for s in faults.scenarios(base) if s.name == "capture")
    source = base / "run"
    source.mkdir()
    args = [source / "rec" if a == "rec" else a for a in capture.args]
    args[args.index("r.json")] = base / "r.json"
    done = faults.call(args, source, FAULT_LOG=base / "log", FAULT_FOLDER=source)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    disk, cuts, wrong = Disk(), 0, []
    every = list(operations((base / "log").read_bytes()))
    for number, operation in enumerate(every):
        disk.apply(*operation)
        for loss, lose in LOSSES.items():
            target = base / "cut"
            harness.remove(target)
            target.mkdir()
            disk.put(source, target, lose)
            cuts += 1
            try:
                found = faults.frames_of(target / "rec")
                lines = lines_written(disk, source)
                if loss == "nothing" and (found or (0, 0)) != (lines, 0):
                    raise AssertionError(f"{found} of {lines} frames")
            except AssertionError as error:
                wrong.append(f"after operation {number} of {len(every)} ({operation[:3]}), "
                             f"{loss} of the unsynced data lost: {error}")
    print(f"{len(every)} operations, {cuts} cuts, {len(wrong)} wrong")
    print("\n".join(wrong[:20]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
