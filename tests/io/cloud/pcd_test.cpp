#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <turnscan/io/cloud/cloud_io.hpp>

#include "tests/io/bytes.hpp"

namespace turnscan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::raw;

std::string pcd_error_of(std::string_view bytes) {
  const auto file = decode_cloud(bytes);
  return file ? "no error" : std::string(name_of(file.error().code)) + ": " + file.error().message;
}

std::string header(std::string_view fields, int width, int height, std::string_view data) {
  return fmt::format(
      "# .PCD v.7 - Point Cloud Data file format\nVERSION .7\n{}WIDTH {}\nHEIGHT {}\n"
      "VIEWPOINT 0.5 -1 2 1 0 0 0\nPOINTS {}\nDATA {}\n",
      fields, width, height, width * height, data);
}

const std::string kPcdXyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
const std::string kFull =
    "FIELDS x y z normal_x normal_y normal_z rgb hist label\nSIZE 4 4 4 4 4 4 4 2 8\n"
    "TYPE F F F F F F U U I\nCOUNT 1 1 1 1 1 1 1 3 1\n";

std::string full_row(float k) {
  std::string row;
  for (const float v : {k, k + 1, k + 2, 0.0F, 1.0F, 0.0F}) row += raw(v);
  return row + raw(0xff010203U) + raw(std::uint16_t(1)) + raw(std::uint16_t(2)) +
         raw(std::uint16_t(3)) + raw(std::int64_t(-1));
}

/// Literal runs only: valid LZF, made without a packer.
std::string lzf_literals(std::string_view data) {
  std::string packed;
  for (std::size_t i = 0; i < data.size(); i += 32) {
    const std::string_view piece = data.substr(i, 32);
    packed += static_cast<char>(piece.size() - 1);
    packed += piece;
  }
  return packed;
}

std::string compressed(std::string_view packed, std::size_t size) {
  return raw(static_cast<std::uint32_t>(packed.size())) + raw(static_cast<std::uint32_t>(size)) +
         std::string(packed);
}

TEST(Pcd, ReadsText) {
  const auto file = decode_cloud(header(kFull, 2, 1, "ascii") +
                                 "1 2 3 0 1 0 66051 1 2 3 -1\n 4 5 6 0 1 0 4278256131 1 2 3 9\n");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(1, 2, 3), Vec3f(4, 5, 6)));
  EXPECT_THAT(file->cloud.normals, ElementsAre(Vec3f(0, 1, 0), Vec3f(0, 1, 0)));
  EXPECT_THAT(file->cloud.colors, ElementsAre(Rgb{1, 2, 3}, Rgb{1, 2, 3}));
  EXPECT_TRUE(file->grid.empty());
  ASSERT_TRUE(file->viewpoint);
  EXPECT_EQ(file->viewpoint->value, Vec3d(0.5, -1, 2));
  EXPECT_FALSE(file->viewpoint->parallel);
}

TEST(Pcd, ReadsBinary) {
  const auto file = decode_cloud(header(kFull, 2, 1, "binary") + full_row(1) + full_row(4));
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(1, 2, 3), Vec3f(4, 5, 6)));
  EXPECT_THAT(file->cloud.normals, ElementsAre(Vec3f(0, 1, 0), Vec3f(0, 1, 0)));
  EXPECT_THAT(file->cloud.colors, ElementsAre(Rgb{1, 2, 3}, Rgb{1, 2, 3}));
}

TEST(Pcd, ReadsCompressedFieldAfterField) {
  std::string data;
  for (const float v : {1.0F, 4.0F, 2.0F, 5.0F, 3.0F, 6.0F}) data += raw(v);
  const auto file = decode_cloud(header(kPcdXyz, 2, 1, "binary_compressed") +
                                 compressed(lzf_literals(data), data.size()));
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(1, 2, 3), Vec3f(4, 5, 6)));
}

TEST(Pcd, ReadsCompressedRepetitions) {
  // Two literals of 4 bytes, then the rest as a copy that overlaps itself.
  const std::string literal = raw(1.0F);
  std::string packed = std::string(1, '\x03') + literal;
  // length 44 = 2 + 7 + 35, distance 4.
  packed += std::string("\xe0", 1) + std::string(1, static_cast<char>(35)) + std::string(1, '\x03');
  const auto file =
      decode_cloud(header(kPcdXyz, 4, 1, "binary_compressed") + compressed(packed, 48));
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.points, ::testing::Each(Vec3f(1, 1, 1)));
  EXPECT_EQ(file->cloud.size(), 4U);
}

TEST(Pcd, DamagedCompressionIsRefused) {
  const std::string start = header(kPcdXyz, 4, 1, "binary_compressed");
  const std::string literal = std::string(1, '\x03') + raw(1.0F);
  const auto with = [&](std::string_view packed, std::size_t size = 48) {
    return pcd_error_of(start + compressed(packed, size));
  };
  EXPECT_THAT(with(literal + std::string("\xe0\x23\x04", 3)), HasSubstr("are damaged"));
  EXPECT_THAT(with(literal + std::string("\xe0\x24\x03", 3)), HasSubstr("are damaged"));
  EXPECT_THAT(with(literal + std::string("\xe0\x22\x03", 3)), HasSubstr("are damaged"));
  EXPECT_THAT(with(literal + std::string("\xe0\x23", 2)), HasSubstr("are damaged"));
  EXPECT_THAT(with("\x1f"), HasSubstr("are damaged"));
  EXPECT_THAT(with(""), HasSubstr("do not fit"));
  EXPECT_THAT(with(literal, 47), HasSubstr("do not fit"));
  EXPECT_THAT(with(literal, 60), HasSubstr("do not fit"));
  EXPECT_THAT(pcd_error_of(start), HasSubstr("ends before"));
  EXPECT_THAT(pcd_error_of(start + raw(1000U) + raw(48U) + literal), HasSubstr("do not fit"));
  EXPECT_THAT(pcd_error_of(header(kPcdXyz, 40000, 40000, "binary_compressed") + raw(5U) +
                           raw(1920000000U) + literal),
              HasSubstr("do not fit"));
}

TEST(Pcd, OrganisedFileIsAGridWithoutItsEmptyCells) {
  const auto file = decode_cloud(header(kPcdXyz, 3, 2, "ascii") +
                                 "1 1 1\nnan nan nan\n2 2 2\nNaN 0 0\n3 3 3\n4 4 4\n");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_EQ(file->grid_width, 3);
  EXPECT_EQ(file->grid_height, 2);
  EXPECT_THAT(file->grid, ElementsAre(0, -1, 1, -1, 2, 3));
  EXPECT_EQ(file->cloud.size(), 4U);
}

TEST(Pcd, ColoursMayHideInFloats) {
  const std::string fields = "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n";
  const auto text = decode_cloud(header(fields, 2, 1, "ascii") +
                                 "0 0 0 4.2108e+06\n0 0 0 9.2557e-41\n");  // 0x010203
  ASSERT_TRUE(text) << text.error().text();
  EXPECT_THAT(text->cloud.colors, ElementsAre(Rgb{64, 64, 112}, Rgb{1, 2, 3}));
  std::string row;
  for (const float v : {0.0F, 0.0F, 0.0F}) row += raw(v);
  const auto binary = decode_cloud(header(fields, 2, 1, "binary") + row + raw(0xff918273U) + row +
                                   raw(0x00010203U));
  EXPECT_THAT(binary.value().cloud.colors, ElementsAre(Rgb{0x91, 0x82, 0x73}, Rgb{1, 2, 3}));
}

TEST(Pcd, ReadsIntegerAndDoubleCoordinates) {
  const std::string fields = "FIELDS x y z\nSIZE 8 2 1\nTYPE F I U\n";
  const auto file = decode_cloud(header(fields, 1, 1, "binary") + raw(0.1) + raw(std::int16_t(-5)) +
                                 raw(std::uint8_t(200)));
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_THAT(file->cloud.points, ElementsAre(Vec3f(0.1F, -5, 200)));
}

TEST(Pcd, DamagedHeadersAreRefused) {
  EXPECT_THAT(pcd_error_of("# .PCD v.7\n"), HasSubstr("it has no DATA"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y\nWIDTH 0\nDATA ascii\n"), HasSubstr("no field 'z'"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nSIZE 4 4\nDATA ascii\n"), HasSubstr("line 3"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nSIZE 4 4 3\nDATA ascii\n"), HasSubstr("size 3"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nSIZE 4 4 2\nDATA ascii\n"), HasSubstr("size 2"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nTYPE F F Q\nDATA ascii\n"), HasSubstr("line 3"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nCOUNT 1 1 0\nDATA ascii\n"),
              HasSubstr("count 0"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nWIDTH -3\nDATA ascii\n"), HasSubstr("line 3"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nVIEWPOINT nan 0 0\nDATA ascii\n"),
              HasSubstr("not a position"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nWIDTH 3\nPOINTS 4\nDATA ascii\n"),
              HasSubstr("4 points are not 3 x 1"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nDATA zip\n"), HasSubstr("unknown kind of data"));
  EXPECT_THAT(pcd_error_of("# .PCD\nFOO\nDATA ascii\n"), HasSubstr("unknown statement"));
}

TEST(Pcd, CountThatTheFileCannotHoldIsRefusedAtOnce) {
  for (const std::string_view data : {"ascii", "binary"}) {
    EXPECT_THAT(pcd_error_of(header(kPcdXyz, 30000, 30000, data) + "1 2 3\n"),
                HasSubstr("too short"));
    EXPECT_THAT(pcd_error_of(fmt::format("# .PCD\n{}WIDTH 2147483647\nHEIGHT 2147483647\nDATA {}\n",
                                         kPcdXyz, data)),
                HasSubstr("points are not"));
  }
  EXPECT_THAT(pcd_error_of("# .PCD\nFIELDS x y z\nWIDTH 2147483648\nDATA ascii\n"),
              HasSubstr("not a number of points"));
}

TEST(Pcd, TruncatedFilesAreRefusedWhereverTheyEnd) {
  const std::string binary = header(kFull, 2, 1, "binary") + full_row(1) + full_row(4);
  for (std::size_t length = 0; length < binary.size(); ++length)
    EXPECT_FALSE(decode_cloud(binary.substr(0, length))) << length;
  EXPECT_THAT(pcd_error_of(header(kPcdXyz, 2, 1, "ascii") + "1 2 3\n4 5\n    "),
              HasSubstr("line 13"));
}

}  // namespace
}  // namespace turnscan
