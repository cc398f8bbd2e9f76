"""The files of the project as the checks see them, and what CMake says about each header."""

import functools
import os
import posixpath
import re
import subprocess

CODE = (".cpp", ".hpp", ".inl", ".h", ".c")
HEADERS = (".hpp", ".inl", ".h")
TEXT = CODE + (".py", ".md", ".txt", ".cmake", ".in", ".json", ".toml", ".yml", ".yaml", ".csv",
               ".sh", ".js", ".mjs", "")
FLOORS_FOLDER = "src/turnscan/"
HEADER_KINDS = ("PUBLIC_HEADERS", "PROJECT_HEADERS", "PRIVATE_HEADERS")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


class Tree:
    """The files that belong to the project, as paths from its root with forward slashes."""

    def __init__(self, root, paths=None):
        self.root = root
        self.paths = sorted(paths if paths is not None else listed_by_git(root) or walked(root))
        self.known = set(self.paths)
        self._lines = {}

    def lines(self, path):
        if path not in self._lines:
            with open(os.path.join(self.root, path), encoding="utf-8", errors="replace") as file:
                self._lines[path] = file.read().splitlines()
        return self._lines[path]

    def code(self, *folders):
        return [p for p in self.paths if p.endswith(CODE) and p.startswith(folders)]

    def headers(self, *folders):
        return [p for p in self.code(*folders) if p.endswith(HEADERS)]

    def text(self):
        return [p for p in self.paths if os.path.splitext(p)[1] in TEXT]

    def cmake(self):
        return [p for p in self.paths if p.endswith(("CMakeLists.txt", ".cmake", ".cmake.in"))]

    def cmake_text(self, path):
        """A CMake file without its comments."""
        return "\n".join(line.split("#")[0] for line in self.lines(path))

    def includes(self, path):
        for number, line in enumerate(self.lines(path), 1):
            if match := INCLUDE.match(line):
                yield number, match.group(1), match.group(2)

    def own_includes(self, path):
        """(line number, path in the tree) of the included files that are the project's own."""
        program = "/".join(path.split("/")[:2])
        for number, quote, name in self.includes(path):
            places = ["src/" + name] if quote == "<" else \
                [posixpath.join(posixpath.dirname(path), name), program + "/" + name, name]
            for place in map(posixpath.normpath, places):
                if place in self.known:
                    yield number, place
                    break

    @functools.cached_property
    def header_lists(self):
        """Header -> where the floors' CMakeLists.txt list it: [(list, line number, kind), ...]."""
        found = {}
        for path in self.paths:
            if path.startswith(FLOORS_FOLDER) and path.endswith("CMakeLists.txt"):
                kind = None
                for number, line in enumerate(self.lines(path), 1):
                    for word in re.findall(r"[^\s()]+|[()]", line.split("#")[0]):
                        if re.fullmatch(r"[A-Z][A-Z_]+|[()]", word):
                            kind = word
                        elif kind in HEADER_KINDS:
                            header = posixpath.normpath(posixpath.join(posixpath.dirname(path), word))
                            found.setdefault(header, []).append((path, number, kind))
        return found

    def kind(self, header):
        """PUBLIC_HEADERS, PROJECT_HEADERS, PRIVATE_HEADERS, or None for what no list names."""
        return self.header_lists[header][0][2] if header in self.header_lists else None

    def installed_headers(self):
        return {header for header in self.header_lists if self.kind(header) == "PUBLIC_HEADERS"}


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


def floor_of(path):
    """The floor on which a file of src/turnscan stands; None for other files."""
    parts = path.split("/")
    return parts[2] if path.startswith(FLOORS_FOLDER) and len(parts) > 3 else None


def room_of(path):
    """The folder that a file is in: FLOOR/ROOM. A file directly on its floor is in room FLOOR."""
    return posixpath.dirname(path)[len(FLOORS_FOLDER):]
