#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include "tests/io/bytes.hpp"
#include "tests/io/scarcity.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Order;
using testing::raw;
using testing::raw_all;
using testing::TempFolder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

PointCloud full_cloud(std::size_t n) {
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const auto f = static_cast<float>(i);
    cloud.points.emplace_back(0.1F * f, -1e-7F / (f + 1), 1e6F * f);
    cloud.normals.push_back(Vec3f(f, 1.0F, -2.0F).normalized());
    cloud.colors.push_back({static_cast<std::uint8_t>(i), 7, static_cast<std::uint8_t>(255 - i)});
    cloud.weights.push_back(1.5F * f);
    cloud.frame.push_back(static_cast<std::uint32_t>(4294967295U - i));
  }
  return cloud;
}

void expect_equal(const PointCloud& a, const PointCloud& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.frame, b.frame);
}

std::string error_of(std::string_view bytes) {
  const auto file = decode_cloud(bytes);
  return file ? "no error" : std::string(name_of(file.error().code)) + ": " + file.error().message;
}

TEST(CloudPly, KeepsEveryAttribute) {
  const TempFolder folder;
  for (const std::size_t n : {1U, 5U, 4096U, 10000U}) {
    const PointCloud cloud = full_cloud(n);
    ASSERT_TRUE(write_cloud(folder / "c.ply", cloud));
    const auto back = read_cloud(folder / "c.ply");
    ASSERT_TRUE(back) << back.error().text();
    expect_equal(back->cloud, cloud);
    EXPECT_TRUE(back->grid.empty());
    EXPECT_FALSE(back->viewpoint);
  }
}

TEST(CloudPly, KeepsAnyChoiceOfAttributes) {
  const TempFolder folder;
  for (int choice = 0; choice < 16; ++choice) {
    PointCloud cloud = full_cloud(3);
    if ((choice & 1) == 0) cloud.normals.clear();
    if ((choice & 2) == 0) cloud.colors.clear();
    if ((choice & 4) == 0) cloud.weights.clear();
    if ((choice & 8) == 0) cloud.frame.clear();
    ASSERT_TRUE(write_cloud(folder / "c.ply", cloud));
    expect_equal(read_cloud(folder / "c.ply").value().cloud, cloud);
  }
}

TEST(CloudPly, CloudWithoutPointsIsNoError) {
  const TempFolder folder;
  ASSERT_TRUE(write_cloud(folder / "c.ply", PointCloud()));
  EXPECT_TRUE(read_cloud(folder / "c.ply").value().cloud.empty());
}

TEST(CloudPly, KeepsTheGridAndTheViewpoint) {
  const TempFolder folder;
  CloudFile file;
  file.cloud = full_cloud(4);
  file.grid_width = 3;
  file.grid_height = 2;
  file.grid = {-1, 0, 1, 3, -1, 2};
  for (const bool parallel : {false, true}) {
    file.viewpoint = Viewpoint{Vec3d(0.1, -2e-9, 1.0 / 3.0), parallel};
    ASSERT_TRUE(write_cloud(folder / "c.ply", file));
    const auto back = read_cloud(folder / "c.ply");
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(back->grid_width, 3);
    EXPECT_EQ(back->grid_height, 2);
    EXPECT_EQ(back->grid, file.grid);
    ASSERT_TRUE(back->viewpoint);
    EXPECT_EQ(back->viewpoint->value, file.viewpoint->value);
    EXPECT_EQ(back->viewpoint->parallel, parallel);
  }
}

TEST(CloudPly, PointsThatAreNotFiniteAreLeftOutAndTheirCellsAreEmpty) {
  const TempFolder folder;
  CloudFile file;
  file.cloud = full_cloud(4);
  file.cloud.points[1].y() = kNan;
  file.cloud.points[2].x() = std::numeric_limits<float>::infinity();
  file.grid_width = 5;
  file.grid_height = 1;
  file.grid = {3, 2, 1, 0, -1};
  ASSERT_TRUE(write_cloud(folder / "c.ply", file));
  const auto back = read_cloud(folder / "c.ply");
  ASSERT_TRUE(back);
  EXPECT_THAT(back->grid, ElementsAre(1, -1, -1, 0, -1));
  EXPECT_THAT(back->cloud.weights, ElementsAre(0.0F, 4.5F));
  EXPECT_THAT(back->cloud.points, ElementsAre(file.cloud.points[0], file.cloud.points[3]));
  EXPECT_EQ(back->cloud.frame.size(), 2U);
  EXPECT_EQ(back->cloud.colors.size(), 2U);
  EXPECT_EQ(back->cloud.normals.size(), 2U);
}

TEST(CloudPly, ReadsAStanfordScan) {
  const auto file = decode_cloud(
      "ply\r\nformat ascii 1.0\r\nobj_info is_mesh 0\r\nobj_info num_cols 2\r\n"
      "obj_info num_rows 2\r\nelement vertex 2\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nelement range_grid 4\r\nproperty list uchar int vertex_indices\r\n"
      "end_header\r\n-0.5 1e-3 +2 \r\n3 4 5\r\n0\r\n1 1\r\n1 0 \r\n0");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(-0.5F, 1e-3F, 2.0F), Vec3f(3, 4, 5)));
  EXPECT_THAT(file->grid, ElementsAre(-1, 1, 0, -1));
}

std::string header(std::string_view format, std::string_view vertices, std::string_view more = "") {
  return fmt::format("ply\nformat {} 1.0\ncomment made by hand\n{}{}end_header\n", format, vertices,
                     more);
}

template <class Position>
std::string binary_rows(Order order) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += raw_all(order, std::uint8_t(i), Position(i + 1), std::int16_t(-i), Position(2 * i),
                    double(0.5), Position(i - 1), std::uint16_t(257 * i), std::uint8_t(9));
  return text;
}

TEST(CloudPly, ReadsEveryTypeInBothByteOrdersAndSkipsTheRest) {
  const auto check = [](std::string_view type, auto rows) {
    const std::string vertices = fmt::format(
        "element vertex 3\nproperty uchar red\nproperty {} x\nproperty short unknown\n"
        "property {} y\nproperty double other\nproperty {} z\nproperty ushort green\n"
        "property uint8 blue\n",
        type, type, type);
    for (const Order order : {Order::kLittle, Order::kBig}) {
      const auto file = decode_cloud(
          header(order == Order::kLittle ? "binary_little_endian" : "binary_big_endian", vertices) +
          rows(order));
      ASSERT_TRUE(file) << file.error().text();
      EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(1, 0, -1), Vec3f(2, 2, 0), Vec3f(3, 4, 1)));
      EXPECT_THAT(file->cloud.colors, ElementsAre(Rgb{0, 0, 9}, Rgb{1, 1, 9}, Rgb{2, 2, 9}));
    }
  };
  check("float", binary_rows<float>);
  check("float64", binary_rows<double>);
  check("char", binary_rows<std::int8_t>);
  check("int16", binary_rows<std::int16_t>);
  check("int", binary_rows<std::int32_t>);
}

TEST(CloudPly, SkipsListsAndElementsAroundTheVertices) {
  const std::string vertices =
      "element camera 2\nproperty list ushort double matrix\nproperty char c\n"
      "element vertex 2\nproperty float x\nproperty list int short neighbours\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\n";
  for (const Order order : {Order::kLittle, Order::kBig}) {
    const std::string body =
        raw_all(order, std::uint16_t(2), 1.0, 2.0, std::int8_t(1), std::uint16_t(0),
                std::int8_t(1)) +
        raw_all(order, 1.0F, std::int32_t(2), std::int16_t(5), std::int16_t(6), 2.0F, 3.0F) +
        raw_all(order, 4.0F, std::int32_t(0), 5.0F, 6.0F) +
        raw_all(order, std::uint8_t(3), 0, 1, 99);
    const auto file = decode_cloud(
        header(order == Order::kLittle ? "binary_little_endian" : "binary_big_endian", vertices) +
        body);
    ASSERT_TRUE(file) << file.error().text();
    EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(1, 2, 3), Vec3f(4, 5, 6)));
  }
  const auto text = decode_cloud(header("ascii", vertices) +
                                 "2 1.5 2.5 1\n0 1\n\n1 2 5 6 2 3\n4 0 5 6\n3 0 1 99\n");
  ASSERT_TRUE(text) << text.error().text();
  EXPECT_THAT(text->cloud.points, ElementsAre(Vec3f(1, 2, 3), Vec3f(4, 5, 6)));
}

TEST(CloudPly, ColoursOfFloatingPointTypeRunFromZeroToOne) {
  const auto file =
      decode_cloud(header("ascii",
                          "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                          "property float red\nproperty double green\nproperty float blue\n") +
                   "0 0 0 0 0.5 1\n1 0 0 -1 2 nan\n2 0 0 0.25 1e-3 0.999\n");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.colors, ElementsAre(Rgb{0, 128, 255}, Rgb{0, 255, 0}, Rgb{64, 0, 255}));
}

TEST(CloudPly, QualityCountsAsWeight) {
  const auto file = decode_cloud(header("ascii",
                                        "element vertex 1\nproperty float x\nproperty float y\n"
                                        "property float z\nproperty float quality\n") +
                                 "0 0 0 2.5\n");
  EXPECT_THAT(file.value().cloud.weights, ElementsAre(2.5F));
}

TEST(CloudPly, TextNumbersReadAsWellAsBinaryOnes) {
  const auto file = decode_cloud(header("ascii",
                                        "element vertex 4\nproperty float x\nproperty double y\n"
                                        "property int z\nproperty uint frame\n") +
                                 "1e-60 -1E-400 3 4294967295\n+0.1 +0.1 +7 1\n"
                                 "16777217 0.30000001192092896 -2147483648 2.0\ninf -nan 1 1\n");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(0, 0, 3), Vec3f(0.1F, 0.1F, 7),
                                              Vec3f(16777216.0F, 0.3F, -2147483648.0F)));
  EXPECT_THAT(file->cloud.frame, ElementsAre(4294967295U, 1U, 2U));
}

const std::string kXyz = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";

TEST(CloudPly, DamagedHeadersAreRefused) {
  EXPECT_THAT(error_of(""), HasSubstr("unsupported: neither a PLY nor a PCD file"));
  EXPECT_THAT(error_of("ply\n"), HasSubstr("neither"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\n"),
              HasSubstr("format: PLY header, line 3: it has no end_header"));
  EXPECT_THAT(error_of("ply\nend_header\n"), HasSubstr("does not say its format"));
  EXPECT_THAT(error_of(header("ascii", "")), HasSubstr("no element 'vertex'"));
  EXPECT_THAT(error_of(header("ebcdic", kXyz)), HasSubstr("unknown format 'ebcdic'"));
  EXPECT_THAT(error_of(header("ascii", "property float x\n")), HasSubstr("before the first"));
  EXPECT_THAT(error_of(header("ascii", "element vertex\n")), HasSubstr("a name and a count"));
  EXPECT_THAT(error_of(header("ascii", "element vertex -1\n")), HasSubstr("a name and a count"));
  EXPECT_THAT(error_of(header("ascii", "element vertex 2x\n")), HasSubstr("a name and a count"));
  EXPECT_THAT(error_of(header("ascii", kXyz + "property quad w\n")), HasSubstr("not a type"));
  EXPECT_THAT(error_of(header("ascii", kXyz + "property list float int w\n")),
              HasSubstr("not an integer"));
  EXPECT_THAT(error_of(header("ascii", kXyz + kXyz)), HasSubstr("appears twice"));
  EXPECT_THAT(error_of(header("ascii", kXyz + "nonsense\n")), HasSubstr("unknown statement"));
  EXPECT_THAT(error_of(header("ascii", "element vertex 0\nproperty float x\n")),
              HasSubstr("no x, y and z"));
  EXPECT_THAT(error_of(header("ascii", "element vertex 1\n") + "1 2 3\n"),
              HasSubstr("no properties"));
}

TEST(CloudPly, CountThatTheFileCannotHoldIsRefusedAtOnce) {
  for (const std::string_view format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const std::string_view count :
         {"2147483648", "4294967296", "9223372036854775807", "18446744073709551615", "3"}) {
      const std::string element = fmt::format(
          "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n", count);
      EXPECT_THAT(error_of(header(format, element) + "1 2 3\n4 5 6"), HasSubstr("too short"))
          << format << ' ' << count;
      const std::string lists =
          kXyz + fmt::format("element face {}\nproperty list uchar int vertex_indices\n", count);
      EXPECT_THAT(error_of(header(format, lists) + "1 2 3\n4 5 6\n          "),
                  HasSubstr(format == "ascii" && count == "3" ? "damaged at line" : "too short"));
    }
}

TEST(CloudPly, ListLongerThanTheFileIsRefusedAtOnce) {
  const std::string element = "element e 1\nproperty list uint int v\n";
  EXPECT_THAT(error_of(header("binary_little_endian", element + kXyz) + raw(0xfffffff0U) +
                       std::string(24, '\0')),
              HasSubstr("a list is longer than the file"));
  EXPECT_THAT(error_of(header("ascii", element + kXyz) + "4294967280 1\n1 2 3\n4 5 6\n"),
              HasSubstr("a list is longer than the file"));
  EXPECT_THAT(error_of(header("ascii", element + kXyz) + "-1 1\n1 2 3\n4 5 6\n"),
              HasSubstr("a list is longer than the file"));
}

TEST(CloudPly, TruncatedFilesAreRefusedWhereverTheyEnd) {
  const TempFolder folder;
  CloudFile file;
  file.cloud = full_cloud(3);
  file.grid_width = 3;
  file.grid_height = 1;
  file.grid = {0, 2, 1};
  ASSERT_TRUE(write_cloud(folder / "c.ply", file));
  const std::string bytes = testing::content_of(folder / "c.ply");
  ASSERT_TRUE(decode_cloud(bytes));
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(decode_cloud(bytes.substr(0, length))) << length;
}

TEST(CloudPly, DamagedTextNamesTheLine) {
  const std::string start = header("ascii", kXyz);
  EXPECT_THAT(error_of(start + "1 2 3\n4 five 6\n"),
              HasSubstr("damaged at line 10, row 1 of element 'vertex'"));
  EXPECT_THAT(error_of(start + "1 2 3\n4 5\n6   \n"), HasSubstr("line 10"));
  EXPECT_THAT(error_of(start + "1 2 3 4\n5 6 7\n"), HasSubstr("line 9"));
  EXPECT_THAT(error_of(start + "1 2 3\n4 5,0 6\n"), HasSubstr("line 10"));
  EXPECT_THAT(error_of(start + "1 2 3\n\n\n      \n\n"), HasSubstr("row 1"));
}

TEST(CloudPly, GridMustFitItsSizeAndItsPoints) {
  const auto grid = [](std::string_view info, std::string_view cells) {
    return fmt::format(
        "ply\nformat ascii 1.0\n{}{}element range_grid 2\nproperty list uchar int "
        "vertex_indices\nend_header\n0 0 0\n1 1 1\n{}",
        info, kXyz, cells);
  };
  const std::string_view good = "obj_info num_cols 2\nobj_info num_rows 1\n";
  EXPECT_EQ(error_of(grid(good, "1 0\n1 1\n")), "no error");
  EXPECT_THAT(error_of(grid("", "1 0\n1 1\n")), HasSubstr("not num_cols x num_rows"));
  EXPECT_THAT(error_of(grid("obj_info num_cols 3\nobj_info num_rows 1\n", "1 0\n1 1\n")),
              HasSubstr("not num_cols x num_rows"));
  EXPECT_THAT(error_of(grid("obj_info num_cols -1\nobj_info num_rows -2\n", "1 0\n1 1\n")),
              HasSubstr("not num_cols x num_rows"));
  EXPECT_THAT(error_of(grid(good, "1 0\n1 2\n")), HasSubstr("out of range"));
  EXPECT_THAT(error_of(grid(good, "1 0\n1 -1\n")), HasSubstr("out of range"));
  EXPECT_THAT(error_of(grid(good, "2 0 1\n1 1\n")), HasSubstr("several vertices"));
}

TEST(CloudPly, WriterRefusesWhatDoesNotFit) {
  PointCloud cloud = full_cloud(3);
  cloud.weights.pop_back();
  EXPECT_THROW((void)write_cloud("c.ply", cloud), std::invalid_argument);
  CloudFile file;
  file.cloud = full_cloud(1);
  file.grid_width = 2;
  file.grid_height = 1;
  file.grid = {0};
  EXPECT_THROW((void)write_cloud("c.ply", file), std::invalid_argument);
  file.grid = {0, 1};
  EXPECT_THROW((void)write_cloud("c.ply", file), std::invalid_argument);
  EXPECT_EQ(write_cloud("c.xyz", full_cloud(1)).error().code, ErrorCode::kUnsupported);
}

TEST(CloudPly, WriterOnAFullDiskLeavesNothing) {
  const TempFolder folder;
  const testing::FullDisk full(10000);
  EXPECT_EQ(write_cloud(folder / "c.ply", full_cloud(5000)).error().code, ErrorCode::kIo);
  EXPECT_EQ(folder.count(), 0U);
}

TEST(CloudText, ReadsPointsAndColoursAsProgramsWriteThem) {
  const TempFolder folder;
  const auto read = [&](const char* name, const std::string& text) {
    folder.put(name, text);
    const auto file = read_cloud(folder / name);
    EXPECT_TRUE(file) << file.error().text();
    return file ? file->cloud : PointCloud();
  };
  const PointCloud plain = read("a.xyz", "1 2 3\n\n# a\n-1.5e1\t+2 3.25 \r\nnan nan nan\n");
  EXPECT_THAT(plain.points, ElementsAre(Vec3f(1, 2, 3), Vec3f(-15, 2, 3.25F)));
  const PointCloud named = read("a.asc", "//X Y Z R G B\n1 2 3 255 0 7\n4 5 6 0 0 1\n");
  EXPECT_THAT(named.colors, ElementsAre(Rgb{255, 0, 7}, Rgb{0, 0, 1}));
  const PointCloud counted = read("a.pts", "2\n1 2 3 -800 255 0 7\n4 5 6 -20 0 0 1\n");
  EXPECT_EQ(counted.size(), 2U);
  EXPECT_EQ(counted.colors[0], (Rgb{255, 0, 7}));
  EXPECT_THAT(read("a.txt", "x;y;z\n1,5;2;3\n").points, ElementsAre(Vec3f(1.5F, 2, 3)));
  EXPECT_THAT(read("a.txt", "x,y,z\n1.5,2,3\n").points, ElementsAre(Vec3f(1.5F, 2, 3)));
  EXPECT_TRUE(read("a.xyz", "1 2 3 0 0 1\n1 2 3 0 1 0\n").colors.empty()) << "normals";
  EXPECT_TRUE(read("a.xyz", "1 2 3 9 9 9\n1 2 3 0.5 1 0\n").colors.empty());
  ASSERT_TRUE(write_cloud(folder / "c.ply", full_cloud(3)));
  std::filesystem::rename(folder / "c.ply", folder / "c.txt");
  EXPECT_EQ(read_cloud(folder / "c.txt")->cloud.size(), 3U);
}

TEST(CloudText, WhatIsNoPointIsNamed) {
  const TempFolder folder;
  const auto why = [&](const std::string& text) {
    folder.put("a.xyz", text);
    const auto file = read_cloud(folder / "a.xyz");
    return file ? std::string("read") : file.error().text();
  };
  EXPECT_THAT(why("// of a scanner\nX Y Z\n1 2 3\n1 2\n"), HasSubstr("line 4"));
  EXPECT_THAT(why("1 2 3\n1 2\n"), HasSubstr("line 2: this is not a point"));
  EXPECT_THAT(why("1 2 3\n1 2 3x\n"), HasSubstr("line 2"));
  EXPECT_THAT(why("1 2 3\n1 2 1e30\n"), HasSubstr("beyond"));
  EXPECT_THAT(why("x y z\nx y z\n"), HasSubstr("line 2"));
}

TEST(Cloud, MissingFileIsNotFound) {
  EXPECT_EQ(read_cloud("/no/such.ply").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace turnscan
