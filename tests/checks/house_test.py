#!/usr/bin/env python3
"""Shows that each rule of house.py is silent on a good sample and speaks on a bad one."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import drawing  # noqa: E402  (needs the path above)
import house  # noqa: E402
from sample import RuleTest, found  # noqa: E402
from tree import Tree  # noqa: E402

GEOMETRY = "src/turnscan/geometry/"
LIST = GEOMETRY + "CMakeLists.txt"
LISTS = """turnscan_floor(geometry
  SOURCES search/knn.cpp ${EXTRA}  # PUBLIC_HEADERS nothing.hpp
  PUBLIC_HEADERS search/knn.hpp
  PROJECT_HEADERS
    search/cells.hpp
  PRIVATE_HEADERS search/tree.hpp
  USES turnscan::core)
"""
HOUSE = {LIST: LISTS, GEOMETRY + "search/knn.hpp": "", GEOMETRY + "search/cells.hpp": "",
         GEOMETRY + "search/tree.hpp": ""}


def include(name):
    return f"#include <turnscan/{name}>\n"


class Floors(RuleTest):
    def test_a_floor_includes_only_downwards(self):
        rule = house.upward_includes
        good = "#include <vector>\n" + include("core/pose.hpp")
        self.quiet(rule, GEOMETRY + "search/knn.cpp", good)
        self.speaks(rule, GEOMETRY + "search/knn.cpp", good + include("io/mesh/mesh_io.hpp"), 3)
        for path, name in [("core/pose.cpp", "geometry/search/knn.hpp"),
                           ("reconstruction/a.cpp", "simulator/scene/scene.hpp"),
                           ("simulator/a.cpp", "reconstruction/pipeline.hpp"),
                           ("capture/a.cpp", "reconstruction/pipeline.hpp"),
                           ("evaluation/a.cpp", "io/mesh/mesh_io.hpp"),
                           ("planning/a.cpp", "workflow/a.hpp")]:
            self.speaks(rule, "src/turnscan/" + path, include(name))
        for path, name in [("workflow/a.cpp", "capture/motor/motor.hpp"),
                           ("planning/a.cpp", "simulator/scene/rig.hpp"),
                           ("evaluation/a.cpp", "geometry/search/knn.hpp")]:
            self.quiet(rule, "src/turnscan/" + path, include(name))

    def test_every_file_of_src_is_on_a_floor(self):
        self.speaks(house.upward_includes, "src/turnscan/helpers/a.cpp", "\n")
        self.speaks(house.upward_includes, "src/core/a.cpp", "\n")
        self.speaks(house.upward_includes, "src/turnscan/a.cpp", "\n")

    def test_a_floor_links_only_downwards(self):
        rule = house.links_upward
        self.quiet(rule, LIST, LISTS + "# turnscan::io\n")
        self.speaks(rule, LIST, "turnscan_floor(geometry\n  USES turnscan::io)\n", 2)

    def test_own_headers_are_included_by_their_full_name(self):
        rule = house.quoted_includes
        self.quiet(rule, "tests/core/pose_test.cpp", '#include "tests/support/rig.hpp"\n')
        self.speaks(rule, GEOMETRY + "search/knn.cpp", '#include "tree.hpp"\n')
        self.speaks(rule, "apps/turnscan/main.cpp", '#include "turnscan/core/pose.hpp"\n')
        self.speaks(rule, "tests/core/a.cpp", '#include "../../turnscan/src/turnscan/core/a.hpp"\n')
        self.speaks(rule, "tests/core/a.cpp", '#include "src/turnscan/core/a.hpp"\n')


class Circles(RuleTest):
    def test_circles_are_the_nodes_that_reach_each_other(self):
        self.assertEqual(house.circles({"a": {"b"}, "b": {"c"}, "c": set()}), [])
        self.assertEqual(house.circles({"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set()}),
                         [["b", "c"]])
        self.assertEqual(house.circles({"a": {"a"}}), [["a"]])
        chain = {str(i): {str(i + 1)} for i in range(5000)}
        self.assertEqual(house.circles({**chain, "5000": set()}), [])

    def test_headers_do_not_include_each_other(self):
        rule = house.file_circles
        a, b = GEOMETRY + "search/a.hpp", GEOMETRY + "search/b.hpp"
        self.quiet(rule, a, include("geometry/search/b.hpp"), {b: ""})
        self.speaks(rule, a, include("geometry/search/b.hpp"), 1,
                    {b: include("geometry/search/a.hpp")})
        self.speaks(rule, "apps/p/view/a.hpp", '#include "view/b.hpp"\n', 1,
                    {"apps/p/view/b.hpp": '#include "a.hpp"\n'})

    def test_rooms_include_each_other_in_one_direction(self):
        rule = house.room_circles
        knn = {GEOMETRY + "search/knn.hpp": "", GEOMETRY + "mesh/clean.hpp": ""}
        source = GEOMETRY + "mesh/clean.cpp"
        self.quiet(rule, source, include("geometry/search/knn.hpp"), knn)
        knn[GEOMETRY + "search/knn.cpp"] = include("geometry/mesh/clean.hpp")
        self.speaks(rule, source, include("geometry/search/knn.hpp"), 1, knn)

    def test_a_file_directly_on_a_floor_stands_between_its_rooms(self):
        rule = house.room_circles
        files = {GEOMETRY + "options.hpp": "", GEOMETRY + "search/knn.hpp": ""}
        files[GEOMETRY + "search/knn.cpp"] = include("geometry/options.hpp")
        self.quiet(rule, GEOMETRY + "pipeline.cpp", include("geometry/search/knn.hpp"), files)
        files[GEOMETRY + "options.hpp"] = include("geometry/search/knn.hpp")
        self.speaks(rule, GEOMETRY + "options.hpp", files[GEOMETRY + "options.hpp"], 1, files)


class Headers(RuleTest):
    def test_lists_are_read_as_cmake_reads_them(self):
        with_comment = {**HOUSE, LIST: LISTS}
        self.assertEqual(found(house.unlisted_headers, with_comment), [])

    def test_every_header_is_listed_once(self):
        rule = house.unlisted_headers
        self.speaks(rule, GEOMETRY + "search/new.hpp", "", files=HOUSE)
        self.speaks(rule, GEOMETRY + "search/loops.inl", "", files=HOUSE)
        twice = LISTS.replace("search/cells.hpp", "search/cells.hpp search/knn.hpp")
        self.speaks(rule, GEOMETRY + "search/knn.hpp", "", files={**HOUSE, LIST: twice})
        self.speaks(rule, LIST, LISTS, 3, {GEOMETRY + "search/cells.hpp": ""})  # knn.hpp is gone

    def test_private_headers_stay_in_their_room(self):
        rule = house.private_headers_used_elsewhere
        text = include("geometry/search/tree.hpp")
        self.quiet(rule, GEOMETRY + "search/knn.cpp", text, HOUSE)
        self.quiet(rule, "tests/geometry/search/knn_test.cpp", text, HOUSE)
        self.quiet(rule, GEOMETRY + "mesh/a.cpp", include("geometry/search/cells.hpp"), HOUSE)
        self.speaks(rule, GEOMETRY + "mesh/a.cpp", text, files=HOUSE)
        self.speaks(rule, "apps/turnscan/main.cpp", text, files=HOUSE)

    def test_what_is_written_as_users_write_includes_installed_headers(self):
        rule = house.users_include_installed_headers
        main = "examples/main.cpp"
        self.quiet(rule, main, include("geometry/search/knn.hpp"), HOUSE)
        self.quiet(rule, "apps/turnscan/main.cpp", include("geometry/search/cells.hpp"), HOUSE)
        self.speaks(rule, main, include("geometry/search/cells.hpp"), files=HOUSE)
        for folder in house.USERS:
            self.speaks(rule, folder + "a/a.cpp", include("geometry/search/cells.hpp"), files=HOUSE)

    def test_the_umbrella_header_is_on_the_highest_floor(self):
        rule = house.upward_includes
        self.quiet(rule, house.UMBRELLA, include("workflow/open.hpp"))
        self.speaks(rule, "src/turnscan/other.hpp", include("workflow/open.hpp"))

    def test_programs_do_not_use_each_others_files(self):
        rule = house.programs_in_each_other
        files = {"apps/turnscan/cli/a.hpp": "", "plugins/support.hpp": ""}
        self.quiet(rule, "apps/turnscan/main.cpp", '#include "cli/a.hpp"\n', files)
        self.quiet(rule, "plugins/k4a/k4a.cpp", '#include "plugins/support.hpp"\n', files)
        self.speaks(rule, "apps/turnscan-studio/a.cpp", '#include "apps/turnscan/cli/a.hpp"\n',
                    files=files)

    def test_project_headers_are_used_by_other_rooms(self):
        rule = house.needless_project_headers
        text = include("geometry/search/cells.hpp")
        self.quiet(rule, GEOMETRY + "mesh/a.cpp", text, HOUSE)
        self.assertEqual(found(rule, {**HOUSE, GEOMETRY + "search/a.cpp": text}), [(LIST, 5)])
        self.assertEqual(found(rule, {**HOUSE, "tests/geometry/a.cpp": text}), [(LIST, 5)])

    def test_installed_headers_are_for_users(self):
        rule = house.internal_installed_headers
        knn, cells = GEOMETRY + "search/knn.hpp", GEOMETRY + "search/cells.hpp"
        self.quiet(rule, cells, "// Internal to the search.\n", HOUSE)
        self.quiet(rule, knn, "// Nearest neighbours.\nint internal_points();\n",
                   {LIST: LISTS, cells: ""})
        self.speaks(rule, knn, "\n// Internal to the search.\n", 2, {LIST: LISTS})
        self.speaks(rule, knn, "// Bricks; not installed.\n", 1, {LIST: LISTS})
        self.speaks(rule, knn, include("geometry/search/cells.hpp"), 1, {LIST: LISTS, cells: ""})

    def test_headers_have_a_guard_or_another_name(self):
        rule = house.headers_without_guard
        self.quiet(rule, GEOMETRY + "a.hpp", "// A.\n#pragma once\n")
        self.quiet(rule, GEOMETRY + "a.h", "/* A */\n#ifndef A_H\n#define A_H\n#endif\n")
        self.quiet(rule, GEOMETRY + "loops.inl", "template <class T> void f(T);\n")
        self.speaks(rule, GEOMETRY + "loops.hpp", "template <class T> void f(T);\n")
        self.speaks(rule, "apps/turnscan/cli/a.hpp", "void f();\n")


class Rooms(RuleTest):
    def test_no_namespace_is_called_detail(self):
        rule = house.shared_detail
        self.quiet(rule, GEOMETRY + "a.cpp", "namespace turnscan::search {  // not detail\n")
        for text in ("namespace turnscan::detail {\n", "namespace detail {\n",
                     "using namespace turnscan::detail;\n", "turnscan::detail::f();\n"):
            self.speaks(rule, GEOMETRY + "a.cpp", text)
            self.speaks(rule, "tests/geometry/a.cpp", text)

    def test_a_room_has_few_sources(self):
        rule = house.crowded_rooms
        for folder in (GEOMETRY + "search/", "apps/turnscan/commands/", "tests/geometry/"):
            files = {f"{folder}{i:02}.cpp": "" for i in range(house.MAX_SOURCES)}
            files[folder + "mesh/deeper.cpp"] = ""
            files[folder + "a.hpp"] = ""
            self.assertEqual(found(rule, files), [])
            self.speaks(rule, folder + "00.cpp", "", files={**files, folder + "20.cpp": ""})

    def test_tests_mirror_the_rooms(self):
        rule = house.tests_elsewhere
        files = {**HOUSE, "plugins/k4a/k4a.cpp": ""}
        for path in ("geometry/search/knn_test.cpp", "geometry/shapes.hpp", "capture/k4a/a_test.cpp",
                     "capture/plugins/driver.cpp", "support/deep/rig.cpp", "e2e/a/b.cpp"):
            self.quiet(rule, "tests/" + path, "", files)
        self.speaks(rule, "tests/geometry/mesh/clean_test.cpp", "", files=files)
        self.speaks(rule, "tests/geometry/search/deep/knn_test.cpp", "", files=files)


class Drawing(RuleTest):
    FILES = {"src/turnscan/core/pose.hpp": "", GEOMETRY + "search/knn.hpp": include("core/pose.hpp"),
             GEOMETRY + "mesh/clean.cpp": include("geometry/search/knn.hpp") + include("core/pose.hpp")}

    def page(self):
        class Sample(Tree):
            def lines(self, path):
                return Drawing.FILES[path].splitlines()
        return "\n".join(["# Architecture", *drawing.drawing(Sample(".", list(self.FILES))), ""])

    def test_arrows_are_those_of_the_includes(self):
        self.assertIn("    geometry --> core", self.page())
        self.assertRegex(self.page(), r"geometry/mesh +-> search\n")
        self.assertEqual(drawing.reduced({("a", "b"), ("b", "c"), ("a", "c")}),
                         {("a", "b"), ("b", "c")})

    def test_the_page_follows_the_includes(self):
        rule = drawing.stale_drawing
        self.quiet(rule, drawing.PAGE, self.page(), self.FILES)
        self.speaks(rule, drawing.PAGE, "# Architecture\n", 1, self.FILES)
        changed = {**self.FILES, GEOMETRY + "grid/a.cpp": include("geometry/search/knn.hpp")}
        self.speaks(rule, drawing.PAGE, self.page(), 2, changed)

    def test_every_room_has_a_line(self):
        rule = drawing.rooms_without_a_word
        rows = "| `core/` | types |\n| `geometry/search/` | neighbours |\n"
        with_mesh = rows + "| `geometry/mesh/` | meshes |\n| `src/turnscan/` | libraries |\n"
        self.quiet(rule, drawing.PAGE, with_mesh, self.FILES)
        self.speaks(rule, drawing.PAGE, rows, 1, self.FILES)
        self.speaks(rule, drawing.PAGE, with_mesh + "| `io/mesh/` | formats |\n", 5, self.FILES)


if __name__ == "__main__":
    unittest.main()
