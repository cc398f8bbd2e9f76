"""Every write, sync, rename, open, allocation and start of a thread fails in turn.

After each: the program ended by itself with one sentence (or, for want of memory in a noexcept function of
the C++ library, by std::terminate); each output is the old one whole or the
new one whole; a recording opens with every frame that its table acknowledges; nothing half-written
lies about. With --table the table in docs/reference/reliability.md is written anew. FAULTS_FULL=1 tries every point, otherwise up to FAULTS_POINTS of a kind of calls
(default 9; four times as many allocations), spread evenly. Prints the number of points tried. See docs/reference/reliability.md.
"""

import json
import os
import pathlib
import re
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
ONE_TASK = ("--set", "allow-open=true", "--jobs", 1, "--task-threads", 1, "--quiet")
FEW = ("--voxel-size", "6mm", "--quiet", "--threads", "2")


def replay(source):
    return f"replay:{source / 'rec'}?speed=max"


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


def numbers_to_try(kind, start, count, points):
    """start: calls before the command begins, which are all alike; a third as many points for them."""
    if FULL or count <= points:
        return range(1, count + 1)
    points = 3 * points if kind == "memory" else points

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

    def __init__(self, name, args, prepare, files=(), recording=None, least=None, also=None,
                 points=POINTS):
        """also(folder, done): raises AssertionError if something else is not as promised. points: fewer of
        a command that takes seconds."""
        self.name, self.args, self.prepare = name, args, prepare
        self.files, self.recording, self.least, self.also = files, recording, least, also
        self.points = points
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
        if self.also:
            self.also(folder, done)
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
        for number in numbers_to_try(kind, min(start, count - 1), count, self.points):
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

    (source / "cube.ply").write_text(harness.ply_cube(0.1))
    for args in (("simulate", "builtin:labelled-cylinder", "--scanner", source / "tiny.toml", "--frames", FRAMES,
                  "--scan-colour", "-o", source / "coloured", "--quiet"),
                 ("batch", "run", source / "rec", "--out", source / "batch", *ONE_TASK, "--set", "voxel-size=7mm"),
                 ("capture", "--device", replay(source), "-o", source / "cut", "--min-free", "0", "--quiet")):
        made = call(args, base)
        if made.returncode != 0:
            raise AssertionError(made.stderr)
    table = source / "cut" / "frames.csv"
    table.write_bytes(b"".join(table.read_bytes().splitlines(keepends=True)[:3]))
    description = source / "cut" / "recording.json"
    description.write_text(re.sub(r'("complete": )true|"ended": "[^"]*",?|"frame_count": [0-9]+,',
                                  lambda m: '"complete": false' if m[1] else "", description.read_text()))

    def recording(folder):
        shutil.copytree(source / "rec", folder / "rec")

    def unfinished(folder):
        recording(folder)
        json_file = folder / "rec" / "recording.json"
        json_file.write_text(json_file.read_text().replace('"complete": true', '"complete": false'))
        with open(folder / "rec" / "frames.csv", "a", encoding="utf-8") as table:
            table.write(f"{FRAMES},0.4,0")

    def batch(folder):
        recording(folder)
        shutil.copytree(source / "batch", folder / "batch")

    def batch_is_whole(folder, done):
        """The result is the old one or the new one, and summary and state can be read."""
        result = folder / "batch" / "tasks" / "rec" / "result"
        if not (result / "mesh.ply").exists():
            raise AssertionError("there is no result, neither the old one nor a new one")
        for file in (result / "report.json", folder / "batch" / "summary.json"):
            json.loads(file.read_text())

    def plan_is_whole(folder, done):
        plans = folder / "plans"
        if done.returncode == 0 or (plans / "plan.json").exists():
            json.loads((plans / "plan.json").read_text())
            if not (plans / "plan-1.toml").read_text():
                raise AssertionError("plan.json names a plan that is empty")

    return [
        Scenario("import", ("import", source / "foreign", "-o", "rec", "--depth-unit", "1mm",
                            "--quiet", "--threads", 2), lambda f: None,
                 recording="rec"),
        Scenario("simulate", ("simulate", "builtin:cylinder", "--scanner", source / "tiny.toml",
                              "--frames", 3, "-o", "rec", "--report", "r.json", "--quiet",
                              "--threads", 2), lambda f: None, files=("r.json",), recording="rec"),
        Scenario("capture", ("capture", "--device", replay(source), "-o", "rec",
                             "--report", "r.json", "--quiet"), lambda f: None, files=("r.json",),
                 recording="rec"),
        Scenario("reconstruct", ("reconstruct", "rec", "-o", "m.ply", "--report", "r.json",
                                 "--allow-open", *FEW), recording, files=("m.ply", "r.json"),
                 recording="rec", least=FRAMES),
        Scenario("calibrate", ("calibrate", "rec", "--save", "c.json", "--quiet", "--threads", 2),
                 recording, files=("c.json",), recording="rec", least=FRAMES),
        Scenario("resume", ("capture", "--device", replay(source), "--resume", "cut", "--min-free", "0",
                            "--quiet"), lambda f: shutil.copytree(source / "cut", f / "cut"),
                 recording="cut", least=2),
        Scenario("batch", ("batch", "run", "rec", "--out", "batch", *ONE_TASK, "--set", "voxel-size=6mm"),
                 batch, also=batch_is_whole, points=POINTS // 3),
        Scenario("report", ("report", source / "cube.ply", "-o", "r.html", "--quiet"), lambda f: None,
                 files=("r.html",), points=POINTS // 3),
        Scenario("plan", ("plan", "builtin:cylinder", "--scanner", source / "tiny.toml", "-o", "plans", "--plans",
                          1, "--trials", 0, "--frames", FRAMES, "--quiet", "--threads", 2),
                 lambda f: None, also=plan_is_whole, points=POINTS // 3),
        Scenario("texture", ("reconstruct", source / "coloured", "-o", "m.obj", "--texture", "--allow-open", *FEW),
                 lambda f: None, files=("m.obj", "m.mtl", "m.png")),
        Scenario("repair", ("info", "--repair", "rec"), unfinished, recording="rec", least=FRAMES),
    ]


def write_table(points, wrong):
    """points: of each command and kind, tried and calls. Rows of commands that were not tried stay."""
    page = pathlib.Path(__file__).resolve().parents[2] / "docs" / "reliability.md"
    table = re.compile(r"(\| command \| write \|.*?\n\|[-|]+\|\n)(.*?)\n\n[0-9,]+ points, \w+ wrong\.", re.DOTALL)
    found = table.search(page.read_text())
    rows = {row.split("|")[1].strip(): row for row in found[2].split("\n")}
    for name, of_kind in points.items():
        rows[name] = f"| {name} | " + " | ".join(f"{of_kind[kind][0]} ({of_kind[kind][1]:,})" for kind in KINDS) + " |"
    total = sum(int(tried) for row in rows.values() for tried in re.findall(r"\| (\d+) \(", row))
    said = found[1] + "\n".join(rows.values()) + f"\n\n{total:,} points, {wrong or 'none'} wrong."
    page.write_text(page.read_text().replace(found[0], said))


def main():
    if not SHIM:
        print("the shim was not built")
        return 77
    base = pathlib.Path(tempfile.mkdtemp(prefix="turnscan-faults-"))
    chosen = set(sys.argv[1:]) - {"--table"}
    total, wrong, points = 0, [], {}
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
                points.setdefault(scenario.name, {})[kind] = (tried, count)
                print(f"{scenario.name}: {tried} points of {count} calls: {kind}, {len(found)} wrong"
                      + (f", {scenario.aborted} ended by std::terminate" if kind == "memory" else ""),
                      flush=True)
    finally:
        harness.remove(base)
    if "--table" in sys.argv:
        write_table(points, len(wrong))
    print(f"{total} points tried, {len(wrong)} wrong")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
