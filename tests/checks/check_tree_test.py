#!/usr/bin/env python3
"""Shows that each rule of check_tree.py is silent on a good sample and speaks on a bad one; house_test.py
and manual_test.py show it of house.py and manual.py."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check_tree  # noqa: E402  (needs the path above)
from sample import RuleTest  # noqa: E402

CMAKE = "turnscan_floor(geometry\n  SOURCES knn.cpp\n  PUBLIC_HEADERS knn.hpp\n  USES x)\n"


class Rules(RuleTest):
    def test_libraries_stay_in_their_folders(self):
        rule = check_tree.libraries_out_of_place
        self.quiet(rule, "bench/icp.cpp", "#include <pcl/registration/icp.h>\n")
        self.speaks(rule, "src/turnscan/geometry/icp.cpp", "#include <pcl/registration/icp.h>\n")
        self.quiet(rule, "apps/turnscan-concave-hull/main.cpp", "#include <libqhull_r/qhull_ra.h>\n")
        self.speaks(rule, "src/turnscan/io/cloud_io.cpp", "#include <pcl/io/pcd_io.h>\n")
        self.speaks(rule, "apps/turnscan/main.cpp", "#include <pcl/point_types.h>\n")
        self.speaks(rule, "src/turnscan/reconstruction/tsdf/a.cpp", "#include <pcl/point_types.h>\n")
        self.quiet(rule, "src/turnscan/simulator/scene.cpp", "#include <embree3/rtcore.h>\n")
        self.speaks(rule, "src/turnscan/evaluation/a.cpp", "#include <embree3/rtcore.h>\n")
        self.quiet(rule, "apps/turnscan-studio/main.cpp", "#include <QMainWindow>\n")
        self.quiet(rule, "tests/studio/driver.cpp", "#include <QMainWindow>\n")
        self.speaks(rule, "apps/turnscan/main.cpp", "#include <QMainWindow>\n")
        self.speaks(rule, "apps/turnscan/main.cpp", "#include <QVTKOpenGLNativeWidget.h>\n")
        self.speaks(rule, "src/turnscan/geometry/a.cpp", "#include <QtCore/QString>\n")
        self.speaks(rule, "src/turnscan/reconstruction/a.cpp", "#include <vtkPolyData.h>\n")
        self.speaks(rule, "src/turnscan/geometry/a.cpp", "#include <tbb/parallel_for.h>\n")
        self.speaks(rule, "src/turnscan/recording/a.cpp", "#include <png.h>\n")
        self.speaks(rule, "src/turnscan/io/a.cpp", "#include <spdlog/spdlog.h>\n")
        self.speaks(rule, "apps/turnscan/main.cpp", "#include <spdlog/spdlog.h>\n")
        self.quiet(rule, "src/turnscan/workflow/config_file.cpp", "#include <toml++/toml.h>\n")

    def test_private_libraries_stay_out_of_installed_headers(self):
        rule = check_tree.libraries_out_of_place
        files = {"src/turnscan/geometry/CMakeLists.txt": CMAKE}
        text = "#pragma once\n#include <nanoflann.hpp>\n"
        self.speaks(rule, "src/turnscan/geometry/knn.hpp", text, 2, files=files)
        self.quiet(rule, "src/turnscan/geometry/knn_private.hpp", text, files=files)
        files = {"src/turnscan/io/CMakeLists.txt": "turnscan_floor(io\n  PUBLIC_HEADERS\n    a.hpp\n  USES x)\n"}
        self.speaks(rule, "src/turnscan/io/a.hpp", "#include <nlohmann/json.hpp>\n", files=files)

    def test_numbers_are_not_read_by_the_locale(self):
        rule = check_tree.numbers_by_locale
        self.quiet(rule, "src/turnscan/io/a.cpp", "auto x = parse_number(text);  // not stod(text)\n")
        for call in ("std::stod(s)", "atof(s)", "strtod(s, &e)", 'sscanf(s, "%f", &x)'):
            self.speaks(rule, "src/turnscan/io/a.cpp", f"x = {call};\n")

    def test_sources_are_not_globbed(self):
        rule = check_tree.globbed_sources
        self.quiet(rule, "src/turnscan/io/CMakeLists.txt", "# no file(GLOB) here\n")
        self.speaks(rule, "src/turnscan/io/CMakeLists.txt", "\nfile(GLOB_RECURSE sources *.cpp)\n", 2)

    def test_no_flag_depends_on_the_machine(self):
        rule = check_tree.machine_flags
        self.speaks(rule, "cmake/a.cmake", "add_compile_options(-march=native)\n")
        self.speaks(rule, "CMakePresets.json", '{"CMAKE_CXX_FLAGS": "-Ofast"}\n')
        self.quiet(rule, "cmake/a.cmake", "# never -march=native\n")
        self.speaks(rule, "src/turnscan/io/CMakeLists.txt", "target_compile_options(x PRIVATE -ffast-math)\n")

    def test_folders_are_those_of_the_project(self):
        rule = check_tree.paths_of_the_top_level
        self.quiet(rule, "cmake/a.cmake", "include(${PROJECT_SOURCE_DIR}/a)  # not CMAKE_SOURCE_DIR\n")
        self.speaks(rule, "src/turnscan/io/CMakeLists.txt", "\nset(a ${CMAKE_SOURCE_DIR}/b)\n", 2)
        self.speaks(rule, "cmake/a.cmake", "set(a ${CMAKE_BINARY_DIR}/b)\n")

    def test_every_source_is_listed(self):
        rule = check_tree.unlisted_files
        files = {"src/turnscan/geometry/CMakeLists.txt": CMAKE}
        self.quiet(rule, "src/turnscan/geometry/knn.cpp", "", files=files)
        self.speaks(rule, "src/turnscan/geometry/other.cpp", "", files=files)
        self.speaks(rule, "src/turnscan/geometry/nn.cpp", "", files=files)  # part of a listed name
        self.speaks(rule, "src/turnscan/geometry/deep/knn.cpp", "", files=files)
        self.speaks(rule, "src/turnscan/geometry/knn.cpp", "")  # no list at all
        self.speaks(rule, "src/turnscan/geometry/knn.cpp", "",
                    files={"src/turnscan/geometry/CMakeLists.txt": "# knn.cpp\n"})

    def test_no_path_of_one_machine(self):
        rule = check_tree.machine_paths_and_hosts
        self.quiet(rule, "docs/a.md", "see ../shared/data, src/work/a, https://github.com/work/a\n")
        for folder in ("work", "home", "root", "tmp"):
            self.speaks(rule, "docs/a.md", f"see /{folder}/someone/data\n")
            self.speaks(rule, "src/turnscan/io/a.cpp", f'open("/{folder}/x");\n')
        self.speaks(rule, "scripts/test", "\nDIR=/" + "home/x\n", 2)

    def test_only_known_hosts_are_named(self):
        rule = check_tree.machine_paths_and_hosts
        self.quiet(rule, "docs/a.md", "https://graphics.stanford.edu/data/3Dscanrep\n")
        self.speaks(rule, "docs/a.md", "get it from https:" + "//packages.invalid/pool\n")

    def test_links_lead_somewhere(self):
        rule = check_tree.broken_links
        files = {"docs/b.md": "# One `part`: 2.5 mm\n```sh\n# no heading\n```\n",
                 "docs/images/demo.png": ""}
        self.quiet(rule, "docs/a.md", "[b](b.md#one-part-25-mm) ![i](images/demo.png) [up](../docs)\n"
                   "[web](https://github.com) [here](#part)\n## Part\n", files=files)
        self.speaks(rule, "docs/a.md", "\n[c](c.md)\n", 2, files=files)
        self.speaks(rule, "docs/a.md", "\n[b](b.md#two)\n", 2, files=files)
        self.speaks(rule, "docs/a.md", "\n[b](b.md#no-heading)\n", 2, files=files)
        self.speaks(rule, "docs/a.md", "\n[here](#there)\n", 2, files=files)

    def test_documents_name_files_that_are_there(self):
        rule = check_tree.documents_name_what_is_there
        files = {"src/turnscan/core/frame.hpp": "", "bench/noise_bench.cpp": ""}
        self.quiet(rule, "docs/a.md", "`core/frame.hpp`, `src/turnscan/core/frame.hpp`, `src/turnscan/`,"
                   " `src/turnscan/FLOOR/NAME.hpp`,"
                   " `bench/noise_bench`, `recording/depth/000000.png`, `build/release`\n", files)
        for name in ("core/frames.hpp", "src/core/frame.hpp", "src/core", "tests/io", "scripts/x"):
            self.speaks(rule, "docs/a.md", f"\nsee `{name}`\n", 2, files)
        self.quiet(rule, "CHANGELOG.md", "`src/core` was moved\n", files)

    def test_no_file_is_large(self):
        self.quiet(check_tree.oversized_files, "a.bin", "x" * 1000)
        self.speaks(check_tree.oversized_files, "a.bin", "x" * 1_000_001)

    def test_every_rule_has_spoken(self):
        folder = os.path.dirname(os.path.abspath(__file__))
        text = ""
        for name in ("check_tree_test.py", "house_test.py", "manual_test.py"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                text += file.read()
        for rule in check_tree.RULES:
            self.assertRegex(text, rf"(check_tree|house|drawing|manual)[.]{rule.__name__}\b")


if __name__ == "__main__":
    unittest.main()
