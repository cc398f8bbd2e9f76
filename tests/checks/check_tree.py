#!/usr/bin/env python3
"""Checks of the source tree that no compiler makes. Usage: check_tree.py ROOT

Each rule is a function that takes a Tree and yields (path, line number, what is wrong). The file
check_tree_test.py shows each of them going red on a bad sample.
"""

import os
import posixpath
import re
import subprocess
import sys

# Which floors a floor may include (docs/architecture.md).
FLOORS = {
    "core": set(),
    "geometry": {"core"},
    "io": {"core"},
    "recording": {"core", "io"},
    "turntable": {"core", "geometry"},
    "reconstruction": {"core", "geometry", "turntable"},
    "simulator": {"core"},
    "capture": {"core", "io", "recording", "turntable", "simulator"},
    "evaluation": {"core", "geometry"},
}

# Header pattern, folders that may include it, whether an installed header may too.
LIBRARIES = [
    ("PCL", r"pcl/", ("src/geometry/", "src/reconstruction/", "tests/", "bench/"), False),
    ("Embree", r"embree\d?/", ("src/simulator/", "bench/"), False),
    ("Qt", r"Q[A-Z]\w+$|Qt\w+/|QVTK", ("apps/turnscan-studio/", "tests/studio/"), False),
    ("VTK", r"vtk\w+\.h", ("apps/turnscan-studio/",), False),
    ("nanoflann", r"nanoflann", ("src/geometry/", "tests/", "bench/"), False),
    ("meshoptimizer", r"meshoptimizer", ("src/geometry/",), False),
    ("TBB (loops go through core/parallel.hpp)", r"(oneapi/)?tbb/", ("src/core/",), True),
    ("a file library", r"png\.h|jpeglib\.h|lib3mf|assimp/|tiny_gltf|Model/COM/|NMR_",
     ("src/io/", "apps/turnscan-mesh-convert/", "tests/"), False),
    ("spdlog (libraries do not log)", r"spdlog/", ("apps/",), False),
    ("CLI11", r"CLI/", ("apps/",), False),
    ("toml++", r"toml\+\+/|toml\.hpp", ("apps/", "src/simulator/"), False),
    ("nlohmann-json in a public header", r"nlohmann/", ("src/", "apps/", "tests/", "bench/"), False),
    ("a driver's library (devices are plug-ins)",
     r"OpenNI\.h|libfreenect|librealsense|k4a/", ("plugins/", "tests/capture/openni2/", "tests/capture/freenect/"), False),
    ("GoogleTest", r"gtest/|gmock/|rapidcheck", ("tests/",), False),
]

# Reading numbers by the locale: 1.5 would be read as 1 where a comma is the decimal sign.
LOCALE_CALLS = re.compile(r"\b(stod|stof|stold|atof|strtod|strtof|sscanf|fscanf|scanf)\s*\(")

# Hosts that files may name, as the source of a fact or as an identifier in a file format.
HOSTS = {"www.apache.org", "github.com", "www.collada.org", "graphics.stanford.edu", "doi.org", "arxiv.org",
         "schemas.microsoft.com", "schemas.openxmlformats.org", "www.w3.org", "example.com",
         "paulbourke.net", "pointclouds.org", "docs.opencv.org", "cvg.cit.tum.de",
         "registry.khronos.org", "json.nlohmann.me", "toml.io", "semver.org"}
URL = re.compile(r"https?://([A-Za-z0-9.-]+)")
# Folders of one person's machine. The leading character keeps paths inside URLs out.
MACHINE_PATH = re.compile(r"(?:^|[\s\"'`(=:,])((?:/(?:work|home|root|mnt|farm|tmp|Users)/\w"
                          r"|[.]library/)[^\s\"'`)]*)")

CODE = (".cpp", ".hpp", ".h", ".c")
TEXT = CODE + (".py", ".md", ".txt", ".cmake", ".in", ".json", ".toml", ".yml", ".csv", ".sh", "")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
LINK = re.compile(r"\]\(([^)\s]+)\)")


class Tree:
    """The files that belong to the project, as paths from its root with forward slashes."""

    def __init__(self, root, paths=None):
        self.root = root
        self.paths = sorted(paths if paths is not None else listed_by_git(root) or walked(root))
        self._lines = {}

    def lines(self, path):
        if path not in self._lines:
            with open(os.path.join(self.root, path), encoding="utf-8", errors="replace") as file:
                self._lines[path] = file.read().splitlines()
        return self._lines[path]

    def code(self, *folders):
        return [p for p in self.paths if p.endswith(CODE) and p.startswith(folders)]

    def text(self):
        return [p for p in self.paths if os.path.splitext(p)[1] in TEXT]

    def cmake(self):
        return [p for p in self.paths if p.endswith(("CMakeLists.txt", ".cmake"))]

    def includes(self, path):
        for number, line in enumerate(self.lines(path), 1):
            if match := INCLUDE.match(line):
                yield number, match.group(1), match.group(2)

    def installed_headers(self):
        """Headers that a CMakeLists.txt of src/ lists after HEADERS."""
        found = set()
        for path in self.cmake():
            if path.startswith("src/"):
                text = "\n".join(self.lines(path))
                for block in re.findall(r"\bHEADERS\s+([^A-Z)]*)", text):
                    found |= {posixpath.join(posixpath.dirname(path), h) for h in block.split()}
        return found


def listed_by_git(root):
    command = ["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard"]
    try:
        out = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None
    return [p for p in out.splitlines() if os.path.isfile(os.path.join(root, p))]


def walked(root):
    for folder, folders, files in os.walk(root):
        folders[:] = [f for f in folders if f not in (".git", "build")]
        for name in files:
            yield os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/")


def upward_includes(tree):
    for path in tree.code("src/"):
        floor = path.split("/")[1]
        if floor not in FLOORS:
            yield path, 1, f"src/{floor} is not a floor"
            continue
        for number, quote, name in tree.includes(path):
            if quote == '"':
                yield path, number, f'"{name}": write <turnscan/{floor}/...>'
            elif name.startswith("turnscan/"):
                target = name.split("/")[1]
                if target != floor and target not in FLOORS[floor]:
                    yield path, number, f"{floor} may not include {name}"


def libraries_out_of_place(tree):
    public = tree.installed_headers()
    for path in tree.code("src/", "apps/", "plugins/", "tests/", "bench/"):
        for number, _, name in tree.includes(path):
            for library, pattern, folders, in_public in LIBRARIES:
                if not re.match(pattern, name):
                    continue
                if not path.startswith(folders):
                    yield path, number, f"<{name}>: {library} belongs to {', '.join(folders)}"
                elif path in public and not in_public:
                    yield path, number, f"<{name}>: {library} in an installed header"


def numbers_by_locale(tree):
    for path in tree.code("src/", "apps/", "plugins/"):
        for number, line in enumerate(tree.lines(path), 1):
            if match := LOCALE_CALLS.search(line.split("//")[0]):
                yield path, number, f"{match.group(1)} reads by the locale; use parse_number"


def globbed_sources(tree):
    for path in tree.cmake():
        for number, line in enumerate(tree.lines(path), 1):
            if re.search(r"file\s*\(\s*GLOB", line.split("#")[0], re.IGNORECASE):
                yield path, number, "sources are listed by name, not globbed"


def machine_flags(tree):
    for path in tree.cmake() + [p for p in tree.paths if p == "CMakePresets.json"]:
        for number, line in enumerate(tree.lines(path), 1):
            if re.search(r"-m(arch|tune|cpu)=native|-Ofast|-f(fast|unsafe)-math",
                         line.split("#")[0]):
                yield path, number, "flags that change with the machine, or change results"


def unlisted_files(tree):
    """Every source is named in the nearest CMakeLists.txt above it."""
    lists = {posixpath.dirname(p): p for p in tree.paths if p.endswith("CMakeLists.txt")}
    for path in tree.code("src/", "apps/", "plugins/", "tests/", "bench/"):
        if not path.endswith(".cpp"):
            continue
        folder = posixpath.dirname(path)
        while folder and folder not in lists:
            folder = posixpath.dirname(folder)
        name = path[len(folder) + 1:] if folder else path
        text = "\n".join(line.split("#")[0] for line in tree.lines(lists[folder])) \
            if folder in lists else ""
        if not re.search(r"(?<![\w/.-])" + re.escape(name) + r"(?![\w/.-])", text):
            yield path, 1, f"not listed in {lists.get(folder, 'any CMakeLists.txt')}"


def machine_paths_and_hosts(tree):
    for path in tree.text():
        for number, line in enumerate(tree.lines(path), 1):
            if match := MACHINE_PATH.search(line):
                yield path, number, f"path of one machine: {match.group(1)}"
            for host in URL.findall(line):
                if host not in HOSTS:
                    yield path, number, f"host {host} is not among those that files may name"


def broken_links(tree):
    known = set(tree.paths)
    for path in tree.paths:
        if not path.endswith(".md"):
            continue
        for number, line in enumerate(tree.lines(path), 1):
            for link in LINK.findall(line):
                target = link.split("#")[0]
                if not target or re.match(r"[a-z]+:", target):
                    continue
                full = posixpath.normpath(posixpath.join(posixpath.dirname(path), target))
                if full not in known and not any(p.startswith(full + "/") for p in known):
                    yield path, number, f"link to {target}, which is not there"


def oversized_files(tree):
    for path in tree.paths:
        size = os.path.getsize(os.path.join(tree.root, path))
        if size > 1_000_000:
            yield path, 1, f"{size} bytes; the repository holds no file of more than 1 MB"


RULES = [upward_includes, libraries_out_of_place, numbers_by_locale, globbed_sources,
         machine_flags, unlisted_files, machine_paths_and_hosts, broken_links, oversized_files]


def main():
    tree = Tree(sys.argv[1] if len(sys.argv) > 1 else ".")
    bad = 0
    for rule in RULES:
        for path, number, message in rule(tree):
            print(f"{path}:{number}: {message} [{rule.__name__}]")
            bad += 1
    print(f"{len(tree.paths)} files, {len(RULES)} rules, {bad} violations")
    return 1 if bad or not tree.paths else 0


if __name__ == "__main__":
    sys.exit(main())
