"""Rules of the house: floors, rooms, and who may include which header. docs/reference/architecture.md
explains them."""

import posixpath
import re

from tree import FLOORS_FOLDER, floor_of, room_of

# Which floors a floor may include.
FLOORS = {
    "core": set(),
    "geometry": {"core"},
    "io": {"core"},
    "recording": {"core", "io", "sensors"},
    "turntable": {"core", "geometry"},
    "reconstruction": {"core", "geometry", "turntable"},
    "sensors": {"core", "io"},
    "simulator": {"core", "geometry", "io", "sensors"},
    "capture": {"core", "io", "recording", "turntable", "sensors", "simulator"},
    "evaluation": {"core", "geometry"},
    "planning": {"core", "geometry", "simulator", "evaluation"},
}
FLOORS["workflow"] = set(FLOORS)
FLOORS["api"] = set(FLOORS)

# The one header beside the floors: it includes all that a user may want.
UMBRELLA = FLOORS_FOLDER + "turnscan.hpp"

# What is written as a user of the library would write it.
USERS = ("plugins/", "python/", "examples/", "tests/consumer/")

# What a folder holds at most. More sources are two ideas.
MAX_SOURCES = 20


def upward_includes(tree):
    """A floor includes itself and the floors that FLOORS names."""
    for path in tree.code("src/"):
        floor = "api" if path == UMBRELLA else floor_of(path)
        if floor not in FLOORS:
            yield path, 1, f"src/turnscan/{floor} is not a floor" if floor else "not on a floor"
            continue
        for number, _, name in tree.includes(path):
            if name.startswith("turnscan/"):
                target = name.split("/")[1]
                if target != floor and target not in FLOORS[floor]:
                    yield path, number, f"{floor} may not include {name}"


def links_upward(tree):
    """CMake links what the includes may use, and no more."""
    for floor, below in FLOORS.items():
        path = f"{FLOORS_FOLDER}{floor}/CMakeLists.txt"
        for number, line in enumerate(tree.lines(path) if path in tree.known else [], 1):
            for target in re.findall(r"\bturnscan::(\w+)", line.split("#")[0]):
                if target in FLOORS and target != floor and target not in below:
                    yield path, number, f"{floor} may not link turnscan::{target}"


def quoted_includes(tree):
    """Headers of the library are included as <turnscan/FLOOR/ROOM/NAME.hpp>, from everywhere."""
    for path in tree.code("src/", "apps/", "plugins/", "tests/", "bench/"):
        for number, quote, name in tree.includes(path):
            own = path.startswith("src/") or name.startswith(("turnscan/", "src/"))
            if quote == '"' and (own or "turnscan/src/" in name):
                yield path, number, f'"{name}": write <turnscan/FLOOR/ROOM/NAME.hpp>'


def circles(edges):
    """Groups of nodes that reach each other (strongly connected; Tarjan 1972), without recursion.

    edges: node -> set of nodes."""
    index, low, groups = {}, {}, []
    open_nodes, stack = [], []
    for root in sorted(edges):
        if root not in index:
            stack.append((root, iter(sorted(edges[root]))))
            index[root] = low[root] = len(index)
            open_nodes.append(root)
        while stack:
            node, targets = stack[-1]
            target = next(targets, None)
            if target is None:
                stack.pop()
                if stack:
                    low[stack[-1][0]] = min(low[stack[-1][0]], low[node])
                if low[node] == index[node]:
                    start = open_nodes.index(node)
                    if len(open_nodes) - start > 1 or node in edges.get(node, ()):
                        groups.append(sorted(open_nodes[start:]))
                    del open_nodes[start:]
            elif target not in index:
                index[target] = low[target] = len(index)
                open_nodes.append(target)
                stack.append((target, iter(sorted(edges.get(target, ())))))
            elif target in open_nodes:
                low[node] = min(low[node], index[target])
    return groups


def file_circles(tree):
    """No header includes itself by way of others."""
    paths = tree.code("src/", "apps/", "plugins/", "tests/", "bench/")
    edges = {path: {target for _, target in tree.own_includes(path)} for path in paths}
    for group in circles(edges):
        yield group[0], 1, "a circle of includes: " + ", ".join(group)


def room_edges(tree):
    """{room: {room it includes: (path, line number)}} below src/turnscan.

    What lies directly on a floor (its options, its results, the pipeline that strings the rooms
    together) stands below some rooms and above others: each file there counts as a room."""

    def node(path):
        room = room_of(path)
        return room if "/" in room else path[len(FLOORS_FOLDER):]

    edges = {}
    for path in tree.code(FLOORS_FOLDER):
        rooms = edges.setdefault(node(path), {})
        for number, target in tree.own_includes(path):
            if node(target) != node(path):
                rooms.setdefault(node(target), (path, number))
    return edges


def room_circles(tree):
    """Rooms of the library include each other in one direction."""
    edges = room_edges(tree)
    for group in circles({room: set(targets) for room, targets in edges.items()}):
        arrows = [(edges[a][b], f"{a} -> {b}") for a in group for b in edges[a] if b in group]
        (path, number), _ = arrows[0]
        yield path, number, "a circle of rooms: " + "; ".join(
            f"{arrow} ({where}:{line})" for (where, line), arrow in arrows)


def private_headers_used_elsewhere(tree):
    """A private header serves its own folder; tests and benchmarks may look inside."""
    for path in tree.code("src/", "apps/", "plugins/"):
        for number, target in tree.own_includes(path):
            if tree.kind(target) == "PRIVATE_HEADERS" and \
                    posixpath.dirname(target) != posixpath.dirname(path):
                yield path, number, f"{target} is private to its room"


def users_include_installed_headers(tree):
    """Drivers, the Python module and the examples get by with what is installed."""
    for path in tree.code(*USERS):
        for number, target in tree.own_includes(path):
            if target.startswith("src/") and tree.kind(target) != "PUBLIC_HEADERS":
                yield path, number, f"{target} is not installed"


def programs_in_each_other(tree):
    """Programs share the library, not each other's files."""
    for path in tree.code("apps/", "plugins/"):
        program = "/".join(path.split("/")[:2])
        for number, target in tree.own_includes(path):
            shared = target.startswith("plugins/") and target.count("/") == 1
            if not target.startswith(("src/", program + "/")) and not shared:
                yield path, number, f"{target} belongs to another program"


def needless_project_headers(tree):
    """A header that no other room includes is private."""
    used = set()
    for path in tree.code("src/", "apps/", "plugins/"):
        used |= {target for _, target in tree.own_includes(path)
                 if posixpath.dirname(target) != posixpath.dirname(path)}
    for header, places in tree.header_lists.items():
        path, number, kind = places[0]
        if kind == "PROJECT_HEADERS" and header not in used:
            yield path, number, f"{header} is used by its own room only: list it as private"


def internal_installed_headers(tree):
    """An installed header is for users, and includes installed headers only."""
    for header in sorted(tree.installed_headers() & tree.known):
        for number, line in enumerate(tree.lines(header), 1):
            comment = re.search(r"//.*|^\s*\*.*|/\*.*", line)
            if comment and re.search(r"\binternal\b|\bnot installed\b", comment.group(0), re.I):
                yield header, number, "an installed header that calls itself internal"
        for number, target in tree.own_includes(header):
            if target.startswith("src/") and tree.kind(target) != "PUBLIC_HEADERS":
                yield header, number, f"an installed header includes {target}, which is not"


def unlisted_headers(tree):
    """Every header of the library is listed once, as public, project or private."""
    for header in tree.headers(FLOORS_FOLDER):
        places = tree.header_lists.get(header, [])
        if len(places) != 1:
            yield header, 1, "listed " + (
                "in no PUBLIC_HEADERS, PROJECT_HEADERS or PRIVATE_HEADERS" if not places else
                "twice: " + ", ".join(f"{path}:{number}" for path, number, _ in places))
    for header, places in tree.header_lists.items():
        if header not in tree.known and "$" not in header:
            yield places[0][0], places[0][1], f"{header} is listed and not there"


def shared_detail(tree):
    """The inside of a room is named after the room."""
    for path in tree.code("src/", "apps/", "plugins/", "tests/", "bench/"):
        for number, line in enumerate(tree.lines(path), 1):
            code = line.split("//")[0]
            if re.search(r"\bnamespace\s+(\w+::)*detail\b|(?<!\w)(turnscan|t)?::detail::", code):
                yield path, number, "namespace detail: name it after the room"


def crowded_rooms(tree):
    """A room that needs more sources holds more than one idea."""
    sources = {}
    for path in tree.code("src/", "apps/", "plugins/", "tests/"):
        if path.endswith((".cpp", ".c")):
            sources.setdefault(posixpath.dirname(path), []).append(path)
    for folder, paths in sources.items():
        if folder != "tests/fuzz" and len(paths) > MAX_SOURCES:  # one small source a parser
            yield paths[0], 1, f"{folder} has {len(paths)} sources; {MAX_SOURCES} at most"


def tests_elsewhere(tree):
    """The tests of a floor stand in folders that are named like its rooms, or like a driver's."""
    folders = {posixpath.dirname(path) for path in tree.paths}
    for path in tree.code("tests/"):
        parts = path.split("/")
        if len(parts) > 3 and parts[1] in FLOORS and parts[2] != "plugins" and not folders & {
                FLOORS_FOLDER + "/".join(parts[1:-1]), "plugins/" + "/".join(parts[2:-1])}:
            yield path, 1, f"there is no room {'/'.join(parts[1:-1])}"


def headers_without_guard(tree):
    """A header can be included twice. What is meant to be included several times is an .inl."""
    for path in tree.headers("src/", "apps/", "plugins/", "tests/", "bench/"):
        guarded = any(re.match(r"\s*#\s*(pragma\s+once|ifndef)\b", line)
                      for line in tree.lines(path))
        if path.endswith((".hpp", ".h")) and not guarded:
            yield path, 1, "no #pragma once; a body that is included several times is an .inl"


RULES = [upward_includes, links_upward, quoted_includes, file_circles, room_circles,
         private_headers_used_elsewhere, users_include_installed_headers, programs_in_each_other,
         needless_project_headers, internal_installed_headers, unlisted_headers, shared_detail,
         crowded_rooms, tests_elsewhere, headers_without_guard]
