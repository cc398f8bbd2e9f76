"""Every write, sync, rename, open, allocation and start of a thread fails in turn.

After each: the program ended by itself with one sentence (or, for want of memory in a noexcept function of
the C++ library, by std::terminate); each output is the old one whole or the
new one whole; a recording opens with every frame that its table acknowledges; nothing half-written
lies about. FAULTS_FULL=1 tries every point, otherwise up to FAULTS_POINTS of a kind of calls
(default 9; four times as many allocations), spread evenly. Prints the number of points tried. See docs/reference/reliability.md.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "e2e"))
import harness  # noqa: E402  (needs the path above)

SHIM = os.environ.get("FAULT_SHIM", "")
FULL = os.environ.get("FAULTS_FULL") == "1"
POINTS = int(os.environ.get("FAULTS_POINTS", "9"))
KINDS = ("write", "sync", "rename", "open", "thread", "memory")
FRAMES = 6  # of the recording that the scenarios share
OLD = "what was there before\n"
FEW = ("--voxel-size", "6mm", "--quiet", "--threads", "2")


def call(args, cwd, **fault):
    env = {**os.environ, **{k: str(v) for k, v in fault.items()}}
    if fault:
        env["LD_PRELOAD"] = SHIM
    return subprocess.run([harness.BIN, *map(str, args)], cwd=cwd, env=env, text=True,
                          errors="replace", stdin=subprocess.DEVNULL, capture_output=True,
                          timeout=harness.HANG_S)


def calls_of(kind, args, folder):
    """How often the calls happen in a run, and the run."""
    count = folder.parent / "count"
    done = call(args, folder, FAULT_KIND=kind, FAULT_AT=0, FAULT_COUNT=count)
    return int(count.read_text()), done


def numbers_to_try(kind, start, count):
    """start: calls before the command begins, which are all alike; a third as many points for them."""
    if FULL or count <= POINTS:
        return range(1, count + 1)
    points = 3 * POINTS if kind == "memory" else POINTS

    def spread(first, last, number):
        return {first + round(i * (last - first) / max(number - 1, 1)) for i in range(number)}

    return sorted(spread(1, start, points // 4 if start else 0) | spread(start + 1, count, points))


def content_of(folder):
    """Every path below with the bytes of the files: what `turnscan info` may tell of depends on nothing else."""
    return tuple((str(path.relative_to(folder)), None if path.is_dir() else path.read_bytes())
                 for path in sorted(folder.rglob("*")))


def frames_of(folder):
    """What a program that reads the recording gets; None when there is none. Many faults leave the same files:
    the program is asked once."""
    if not (folder / "recording.json").exists():
        return None
    content = content_of(folder)
    if content not in known_frames:
        known_frames[content] = read_frames(folder)
    return known_frames[content]


known_frames = {}


def read_frames(folder):
    shown = call(("info", folder, "--json"), folder.parent)
    if shown.returncode != 0:
        raise AssertionError(f"the recording does not open: {shown.stderr}")
    info = json.loads(shown.stdout)
    return info["frames"], info["dropped_frames"]


class Scenario:
    """A command with its inputs and what must hold after it failed."""

    def __init__(self, name, args, prepare, files=(), recording=None, least=None):
        self.name, self.args, self.prepare = name, args, prepare
        self.files, self.recording, self.least = files, recording, least
        self.new = {}
        self.aborted = 0

    def fresh(self, base):
        folder = base / "run"
        harness.remove(folder)
        folder.mkdir()
        self.prepare(folder)
        for file in self.files:
            (folder / file).write_text(OLD)
        return folder

    def learn(self, base, kind):
        """How often the calls happen, and what the whole outputs are."""
        folder = self.fresh(base)
        count, done = calls_of(kind, self.args, folder)
        if done.returncode != 0:
            raise AssertionError(f"{self.name} fails without a fault: {done.stderr}")
        self.new = {file: (folder / file).read_bytes() for file in self.files}
        return count

    def check(self, kind, folder, done):
        # std::filesystem's calls that take an error_code allocate, and are noexcept.
        if kind == "memory" and done.returncode == -signal.SIGABRT:
            self.aborted += 1
            return self.check_outputs(folder, done)
        if done.returncode not in (0, 1, 2):
            raise AssertionError(f"ended with {done.returncode}")
        lines = [line for line in done.stderr.splitlines() if line.startswith("turnscan:")]
        if done.returncode != 0 and len(lines) != 1:
            raise AssertionError("it does not say in one line what is wrong")
        if "internal error" in done.stderr:
            raise AssertionError("it calls the fault an error of its own")
        self.check_outputs(folder, done)
        left = [p for p in folder.rglob(".*.part")]
        if left:
            raise AssertionError(f"left behind: {left}")

    def check_outputs(self, folder, done):
        for file in self.files:
            content = (folder / file).read_bytes()
            if done.returncode == 0 and content == OLD.encode():
                raise AssertionError(f"{file} was not written, and nothing was said")
            # Reports hold times: whole means that they parse.
            whole = json.loads(content) if file.endswith(".json") and content != OLD.encode() else \
                content in (OLD.encode(), self.new[file])
            if not whole:
                raise AssertionError(f"{file} is neither the old one nor the new one")
        if self.recording is None:
            return
        found = frames_of(folder / self.recording)
        if found is None:
            if done.returncode == 0 or self.least:
                raise AssertionError("there is no recording")
            return
        if found[1] != 0:
            raise AssertionError(f"{found[1]} acknowledged frames are lost")
        if self.least and found[0] < self.least:
            raise AssertionError(f"{found[0]} of {self.least} frames are left")

    def run(self, base, kind):
        count = self.learn(base, kind)
        start = calls_of(kind, ["--version"], base / "run")[0]
        tried = 0
        wrong = []
        for number in numbers_to_try(kind, min(start, count - 1), count):
            for lasts in ({}, {"FAULT_LASTS": 1}) if kind in ("write", "open") else ({},):
                folder = self.fresh(base)
                done = call(self.args, folder, FAULT_KIND=kind, FAULT_AT=number, **lasts)
                tried += 1
                try:
                    self.check(kind, folder, done)
                except (AssertionError, json.JSONDecodeError) as error:
                    wrong.append(f"{self.name}: {kind} {number} of {count} {'on ' if lasts else ''}"
                                 f"fails: {error}\n    {done.stderr.strip()[-300:]}")
        return count, tried, wrong


def scenarios(base):
    source = base / "source"
    source.mkdir()
    harness.foreign_scan(source / "foreign")
    (source / "tiny.toml").write_text(
        'name = "tiny"\nkind = "matrix"\ncolumns = 96\nrows = 80\nvertical-fov = "25deg"\n'
        'near = "0.2m"\nfar = "4m"\n')
    made = call(("simulate", "builtin:cylinder", "--scanner", source / "tiny.toml", "--frames", FRAMES,
                 "-o", source / "rec", "--quiet"), base)
    if made.returncode != 0:
        raise AssertionError(made.stderr)

    def recording(folder):
        shutil.copytree(source / "rec", folder / "rec")

    def unfinished(folder):
        recording(folder)
        json_file = folder / "rec" / "recording.json"
        json_file.write_text(json_file.read_text().replace('"complete": true', '"complete": false'))
        with open(folder / "rec" / "frames.csv", "a", encoding="utf-8") as table:
            table.write(f"{FRAMES},0.4,0")

    return [
        Scenario("import", ("import", source / "foreign", "-o", "rec", "--depth-unit", "1mm",
                            "--quiet", "--threads", 2), lambda f: None,
                 recording="rec"),
        Scenario("simulate", ("simulate", "builtin:cylinder", "--scanner", source / "tiny.toml",
                              "--frames", 3, "-o", "rec", "--report", "r.json", "--quiet",
                              "--threads", 2), lambda f: None, files=("r.json",), recording="rec"),
        Scenario("capture", ("capture", "--device", f"replay:{source / 'rec'}?speed=max", "-o", "rec",
                             "--report", "r.json", "--quiet"), lambda f: None, files=("r.json",),
                 recording="rec"),
        Scenario("reconstruct", ("reconstruct", "rec", "-o", "m.ply", "--report", "r.json",
                                 "--allow-open", *FEW), recording, files=("m.ply", "r.json"),
                 recording="rec", least=FRAMES),
        Scenario("calibrate", ("calibrate", "rec", "--save", "c.json", "--quiet", "--threads", 2),
                 recording, files=("c.json",), recording="rec", least=FRAMES),
        Scenario("repair", ("info", "--repair", "rec"), unfinished, recording="rec", least=FRAMES),
    ]


def main():
    if not SHIM:
        print("the shim was not built")
        return 77
    base = pathlib.Path(tempfile.mkdtemp(prefix="turnscan-faults-"))
    chosen = set(sys.argv[1:])
    total, wrong = 0, []
    try:
        every = harness.part_of(scenarios(base))
        names = {scenario.name for scenario in every}
        for scenario in every:
            for kind in KINDS:
                if not all(not group & chosen or own in chosen for own, group in
                           ((scenario.name, names), (kind, set(KINDS)))):
                    continue
                count, tried, found = scenario.run(base, kind)
                total += tried
                wrong += found
                print(f"{scenario.name}: {tried} points of {count} calls: {kind}, {len(found)} wrong"
                      + (f", {scenario.aborted} ended by std::terminate" if kind == "memory" else ""),
                      flush=True)
    finally:
        harness.remove(base)
    print(f"{total} points tried, {len(wrong)} wrong")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
