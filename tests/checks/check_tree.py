#!/usr/bin/env python3
"""Checks of the source tree that no compiler makes. Usage: check_tree.py [ROOT]

Each rule is a function that takes a Tree and yields (path, line number, what is wrong). The files
check_tree_test.py, house_test.py and manual_test.py show each of them going red on a bad sample.
"""

import os
import posixpath
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import drawing  # noqa: E402  (needs the path above)
import house  # noqa: E402
import manual  # noqa: E402
from tree import Tree  # noqa: E402

# Header pattern, folders that may include it, whether an installed header may too.
LIBRARIES = [
    ("PCL (a peer to compare with)", r"pcl/", ("bench/",), False),
    ("Qhull", r"libqhull", ("apps/turnscan-concave-hull/",), False),
    ("Embree", r"embree\d?/", ("src/turnscan/geometry/rays/", "src/turnscan/simulator/", "bench/"), False),
    ("Qt", r"Q[A-Z]\w+$|Qt\w+/|QVTK", ("apps/turnscan-studio/", "tests/studio/"), False),
    ("VTK", r"vtk\w+\.h", ("apps/turnscan-studio/",), False),
    ("nanoflann", r"nanoflann", ("src/turnscan/geometry/", "tests/", "bench/"), False),
    ("meshoptimizer", r"meshoptimizer", ("src/turnscan/geometry/", "tests/geometry/"), False),
    ("TBB (loops go through core/parallel.hpp)", r"(oneapi/)?tbb/", ("src/turnscan/core/",), True),
    ("a file library", r"png\.h|jpeglib\.h|turbojpeg|lib3mf|assimp/|tiny_gltf|Model/COM/|NMR_",
     ("src/turnscan/io/", "apps/turnscan-mesh-convert/", "tests/"), False),
    ("spdlog (libraries do not log, and programs need no more than a line)", r"spdlog/", (), False),
    ("OpenSSL", r"openssl/", ("apps/turnscan/serve/",), False),
    ("CLI11", r"CLI/", ("apps/turnscan/",), False),
    ("toml++", r"toml\+\+/|toml\.hpp",
     ("apps/", "src/turnscan/io/", "src/turnscan/sensors/", "src/turnscan/simulator/",
      "src/turnscan/workflow/"), False),
    ("nlohmann-json in a public header", r"nlohmann/", ("src/", "apps/", "tests/", "bench/"), False),
    ("a driver's library (devices are plug-ins)",
     r"OpenNI\.h|libfreenect|librealsense|k4a/",
     ("plugins/", "tests/capture/openni2/", "tests/capture/freenect/"), False),
    ("GoogleTest", r"gtest/|gmock/|rapidcheck", ("tests/",), False),
]

# Reading numbers by the locale: 1.5 would be read as 1 where a comma is the decimal sign.
LOCALE_CALLS = re.compile(r"\b(stod|stof|stold|atof|strtod|strtof|sscanf|fscanf|scanf)\s*\(")

# Hosts that files may name, as the source of a fact or as an identifier in a file format.
HOSTS = {"www.apache.org", "github.com", "www.collada.org", "graphics.stanford.edu", "doi.org", "arxiv.org",
         "schemas.microsoft.com", "schemas.openxmlformats.org", "www.w3.org", "example.com",
         "paulbourke.net", "pointclouds.org", "docs.opencv.org", "cvg.cit.tum.de", "learn.microsoft.com",
         "registry.khronos.org", "json.nlohmann.me", "toml.io", "semver.org", "keepachangelog.com",
         "wiki.ros.org", "docs.ros.org", "www.ros.org", "mcap.dev", "docs.artec-group.com", "www.shining3d.com",
         "docs.shining3d.com", "www.cloudcompare.org",
         "127.0.0.1", "rig"}  # of turnscan serve: this machine, and any beside a turntable
URL = re.compile(r"https?://([A-Za-z0-9.-]+)")
# Folders of one person's machine. The leading character keeps paths inside URLs out.
MACHINE_PATH = re.compile(r"(?:^|[\s\"'`(=:,])((?:/(?:work|home|root|mnt|farm|tmp|Users)/\w"
                          r"|[.]library/)[^\s\"'`)]*)")
LINK = re.compile(r"\]\(([^)\s]+)\)")


def libraries_out_of_place(tree):
    public = tree.installed_headers()
    for path in tree.code("src/", "apps/", "plugins/", "tests/", "bench/"):
        for number, _, name in tree.includes(path):
            for library, pattern, folders, in_public in LIBRARIES:
                if not re.match(pattern, name):
                    continue
                if not path.startswith(folders):
                    place = f"belongs to {', '.join(folders)}" if folders else "is not used"
                    yield path, number, f"<{name}>: {library} {place}"
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


def paths_of_the_top_level(tree):
    """turnscan can be a part of another project, whose folders CMAKE_SOURCE_DIR names."""
    for path in tree.cmake():
        for number, line in enumerate(tree.lines(path), 1):
            if match := re.search(r"CMAKE_(SOURCE|BINARY)_DIR", line.split("#")[0]):
                yield path, number, f"{match.group(0)}: write PROJECT_{match.group(1)}_DIR"


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
        text = tree.cmake_text(lists[folder]) if folder in lists else ""
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


def anchors(tree, path):
    """The names by which headings of a document are linked to."""
    found, code = set(), False
    for line in tree.lines(path):
        code = code != line.startswith("```")
        if not code and (heading := re.match(r"#+\s+(.*)", line)):
            found.add(re.sub(r"[^\w\- ]", "", heading.group(1).lower()).replace(" ", "-"))
    return found


def broken_links(tree):
    for path in tree.paths:
        if not path.endswith(".md"):
            continue
        for number, line in enumerate(tree.lines(path), 1):
            for link in LINK.findall(line):
                target, _, anchor = link.partition("#")
                if re.match(r"[a-z]+:", target):
                    continue
                full = posixpath.normpath(posixpath.join(posixpath.dirname(path), target)) \
                    if target else path
                if full not in tree.known and not any(p.startswith(full + "/") for p in tree.known):
                    yield path, number, f"link to {target}, which is not there"
                elif anchor and full.endswith(".md") and anchor not in anchors(tree, full):
                    yield path, number, f"link to #{anchor}, which {full} has not"


# A path of the project in a document: `src/turnscan/core/frame.hpp`, `tests/checks`, `core/frame.hpp`.
NAMED_PATH = re.compile(r"`((?:[\w.-]+/)+[\w.-]+?)/?`")
OWN_FOLDERS = ("src/", "apps/", "plugins/", "tests/", "bench/", "cmake/", "scripts/", "data/", "docs/", "web/")


def documents_name_what_is_there(tree):
    """A path that a document names in backquotes is there: from the root, or from a floor's folder."""
    folders = {folder for path in tree.paths for folder in parents(path)}
    there = tree.known | folders | {posixpath.splitext(path)[0] for path in tree.paths}
    floors = tuple(floor + "/" for floor in house.FLOORS)
    for path in tree.paths:
        if not path.endswith(".md") or path == "CHANGELOG.md":
            continue
        for number, line in enumerate(tree.lines(path), 1):
            for name in NAMED_PATH.findall(line):
                of_floor = name.startswith(floors) and name.endswith((".hpp", ".cpp", ".h"))
                full = "src/turnscan/" + name if of_floor else name
                placeholder = re.search(r"\b(FLOOR|ROOM|NAME)", full)
                if full.startswith(OWN_FOLDERS) and full not in there and not placeholder:
                    yield path, number, f"{name} is not there"


def parents(path):
    while path := posixpath.dirname(path):
        yield path


def oversized_files(tree):
    for path in tree.paths:
        size = os.path.getsize(os.path.join(tree.root, path))
        if size > 1_000_000:
            yield path, 1, f"{size} bytes; the repository holds no file of more than 1 MB"


RULES = house.RULES + manual.RULES + [drawing.stale_drawing, drawing.rooms_without_a_word] + [
    libraries_out_of_place, numbers_by_locale, globbed_sources, machine_flags,
    paths_of_the_top_level, unlisted_files, machine_paths_and_hosts, broken_links,
    documents_name_what_is_there, oversized_files]


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
