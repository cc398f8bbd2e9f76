#!/usr/bin/env python3
"""Shows that each rule of check_tree.py is silent on a good sample and speaks on a bad one."""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check_tree  # noqa: E402  (needs the path above)

CMAKE = "turnscan_floor(geometry\n  SOURCES knn.cpp\n  HEADERS knn.hpp\n  USES turnscan::core)\n"


def found(rule, files):
    """What a rule finds in a tree of these files (path -> text)."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            full = os.path.join(root, path)
            os.makedirs(os.path.dirname(full), exist_ok=True)
            with open(full, "w", encoding="utf-8") as file:
                file.write(text)
        return [(path, number) for path, number, _ in rule(check_tree.Tree(root, list(files)))]


class Rules(unittest.TestCase):
    def quiet(self, rule, path, text, **others):
        self.assertEqual(found(rule, {path: text, **others.get("files", {})}), [])

    def speaks(self, rule, path, text, line=1, **others):
        self.assertIn((path, line), found(rule, {path: text, **others.get("files", {})}))

    def test_a_floor_includes_only_downwards(self):
        rule = check_tree.upward_includes
        good = "#include <vector>\n#include <turnscan/core/pose.hpp>\n"
        self.quiet(rule, "src/geometry/knn.cpp", good)
        self.speaks(rule, "src/geometry/knn.cpp", good + "#include <turnscan/io/mesh_io.hpp>\n", 3)
        self.speaks(rule, "src/core/pose.cpp", "#include <turnscan/geometry/knn.hpp>\n")
        self.speaks(rule, "src/reconstruction/a.cpp", "#include <turnscan/simulator/scene.hpp>\n")
        self.speaks(rule, "src/simulator/a.cpp", "#include <turnscan/reconstruction/a.hpp>\n")

    def test_own_headers_are_included_by_their_full_name(self):
        rule = check_tree.upward_includes
        self.speaks(rule, "src/geometry/knn.cpp", '#include "../io/mesh_io.hpp"\n')

    def test_a_folder_of_src_is_a_floor(self):
        self.speaks(check_tree.upward_includes, "src/helpers/a.cpp", "\n")

    def test_libraries_stay_in_their_folders(self):
        rule = check_tree.libraries_out_of_place
        self.quiet(rule, "src/geometry/icp.cpp", "#include <pcl/registration/icp.h>\n")
        self.speaks(rule, "src/io/cloud_io.cpp", "#include <pcl/io/pcd_io.h>\n")
        self.speaks(rule, "apps/turnscan/main.cpp", "#include <pcl/point_types.h>\n")
        self.quiet(rule, "src/simulator/scene.cpp", "#include <embree3/rtcore.h>\n")
        self.speaks(rule, "src/evaluation/a.cpp", "#include <embree3/rtcore.h>\n")
        self.quiet(rule, "apps/turnscan-studio/main.cpp", "#include <QMainWindow>\n")
        self.quiet(rule, "tests/studio/driver.cpp", "#include <QMainWindow>\n")
        self.speaks(rule, "apps/turnscan/main.cpp", "#include <QMainWindow>\n")
        self.speaks(rule, "apps/turnscan/main.cpp", "#include <QVTKOpenGLNativeWidget.h>\n")
        self.speaks(rule, "src/geometry/a.cpp", "#include <QtCore/QString>\n")
        self.speaks(rule, "src/reconstruction/a.cpp", "#include <vtkPolyData.h>\n")
        self.speaks(rule, "src/geometry/a.cpp", "#include <tbb/parallel_for.h>\n")
        self.speaks(rule, "src/recording/a.cpp", "#include <png.h>\n")
        self.speaks(rule, "src/io/a.cpp", "#include <spdlog/spdlog.h>\n")

    def test_private_libraries_stay_out_of_installed_headers(self):
        rule = check_tree.libraries_out_of_place
        files = {"src/geometry/CMakeLists.txt": CMAKE}
        text = "#pragma once\n#include <nanoflann.hpp>\n"
        self.speaks(rule, "src/geometry/knn.hpp", text, 2, files=files)
        self.quiet(rule, "src/geometry/knn_private.hpp", text, files=files)
        files = {"src/io/CMakeLists.txt": "turnscan_floor(io\n  HEADERS\n    a.hpp\n  USES x)\n"}
        self.speaks(rule, "src/io/a.hpp", "#include <nlohmann/json.hpp>\n", files=files)

    def test_numbers_are_not_read_by_the_locale(self):
        rule = check_tree.numbers_by_locale
        self.quiet(rule, "src/io/a.cpp", "auto x = parse_number(text);  // not stod(text)\n")
        for call in ("std::stod(s)", "atof(s)", "strtod(s, &e)", 'sscanf(s, "%f", &x)'):
            self.speaks(rule, "src/io/a.cpp", f"x = {call};\n")

    def test_sources_are_not_globbed(self):
        rule = check_tree.globbed_sources
        self.quiet(rule, "src/io/CMakeLists.txt", "# no file(GLOB) here\n")
        self.speaks(rule, "src/io/CMakeLists.txt", "\nfile(GLOB_RECURSE sources *.cpp)\n", 2)

    def test_no_flag_depends_on_the_machine(self):
        rule = check_tree.machine_flags
        self.speaks(rule, "cmake/a.cmake", "add_compile_options(-march=native)\n")
        self.speaks(rule, "CMakePresets.json", '{"CMAKE_CXX_FLAGS": "-Ofast"}\n')
        self.quiet(rule, "cmake/a.cmake", "# never -march=native\n")
        self.speaks(rule, "src/io/CMakeLists.txt", "target_compile_options(x PRIVATE -ffast-math)\n")

    def test_every_source_is_listed(self):
        rule = check_tree.unlisted_files
        files = {"src/geometry/CMakeLists.txt": CMAKE}
        self.quiet(rule, "src/geometry/knn.cpp", "", files=files)
        self.speaks(rule, "src/geometry/other.cpp", "", files=files)
        self.speaks(rule, "src/geometry/nn.cpp", "", files=files)  # part of a listed name
        self.speaks(rule, "src/geometry/deep/knn.cpp", "", files=files)
        self.speaks(rule, "src/geometry/knn.cpp", "")  # no list at all
        self.speaks(rule, "src/geometry/knn.cpp", "",
                    files={"src/geometry/CMakeLists.txt": "# knn.cpp\n"})

    def test_no_path_of_one_machine(self):
        rule = check_tree.machine_paths_and_hosts
        self.quiet(rule, "docs/a.md", "see ../shared/data, src/work/a, https://github.com/work/a\n")
        for folder in ("work", "home", "root", "tmp"):
            self.speaks(rule, "docs/a.md", f"see /{folder}/someone/data\n")
            self.speaks(rule, "src/io/a.cpp", f'open("/{folder}/x");\n')
        self.speaks(rule, "scripts/test", "\nDIR=/" + "home/x\n", 2)

    def test_only_known_hosts_are_named(self):
        rule = check_tree.machine_paths_and_hosts
        self.quiet(rule, "docs/a.md", "https://graphics.stanford.edu/data/3Dscanrep\n")
        self.speaks(rule, "docs/a.md", "get it from https:" + "//packages.invalid/pool\n")

    def test_links_lead_somewhere(self):
        rule = check_tree.broken_links
        files = {"docs/b.md": "", "docs/images/demo.png": ""}
        self.quiet(rule, "docs/a.md", "[b](b.md#part) ![i](images/demo.png) [up](../docs)\n"
                   "[web](https://github.com) [here](#part)\n", files=files)
        self.speaks(rule, "docs/a.md", "\n[c](c.md)\n", 2, files=files)

    def test_no_file_is_large(self):
        self.quiet(check_tree.oversized_files, "a.bin", "x" * 1000)
        self.speaks(check_tree.oversized_files, "a.bin", "x" * 1_000_001)

    def test_every_rule_has_spoken_above(self):
        with open(os.path.abspath(__file__), encoding="utf-8") as file:
            text = file.read()
        for rule in check_tree.RULES:
            self.assertIn(f"check_tree.{rule.__name__}", text)


if __name__ == "__main__":
    unittest.main()
