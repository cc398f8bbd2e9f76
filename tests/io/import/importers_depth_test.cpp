// The layouts of depth images.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>

#include "tests/io/bytes.hpp"
#include "tests/io/import/foreign_data.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::frame_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::open;
using testing::put_color;
using testing::put_depth;
using testing::raw;
using testing::refusal;
using testing::TempFolder;

constexpr const char* kIdentity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";

ImportOptions with_depth_unit() {
  ImportOptions options;
  options.depth_unit_m = 1e-3;
  return options;
}

/// Two frames with poses: the second one stands 1 m to the right, turned by 90 degrees about y.
void put_frame_pose(const TempFolder& folder) {
  put_depth(folder, "frame-000007.depth.png", 700);
  put_depth(folder, "frame-000010.depth.png", 1000);
  put_color(folder, "frame-000010.color.png");
  folder.put("frame-000007.pose.txt", kIdentity);
  folder.put("frame-000010.pose.txt", " 0 0 1e+000 1\n 0 1 0 0\n -1 0 0 0\n 0 0 0 1\n");
  folder.put("camera-intrinsics.txt", " 5.85e+02\t 0 2\n0 585.5 1\n0 0 1\n");
}

TEST(DepthFolder, NamesAreSortedAsNumbersAndColourStandsBeside) {
  const TempFolder folder;
  for (const char* name : {"shot_9.png", "shot_10.png", "shot_100.png"})
    put_depth(folder, name, 700);
  ASSERT_TRUE(fs::create_directory(folder / "rgb"));
  put_color(folder, "rgb/shot_10.png");
  ImportOptions options = with_depth_unit();
  options.intrinsics = "585,585,1.5,1";
  options.fps = 2.0;
  const auto sequence = open(folder.path(), options);
  ASSERT_EQ(sequence->frames().size(), 3u);
  EXPECT_EQ(sequence->frames()[0].file, "shot_9.png");
  EXPECT_EQ(sequence->frames()[1].file, "shot_10.png");
  EXPECT_EQ(sequence->frames()[2].time_s, 1.0);
  EXPECT_EQ(frame_of(*sequence, 1).color.at(1, 1), (Rgb{1, 2, 3}));
  EXPECT_EQ(sequence->header().sensors[0].intrinsics.width, 4);
}

TEST(DepthFolder, AsksForWhatImagesDoNotSay) {
  const TempFolder folder;
  put_depth(folder, "a.png", 700);
  EXPECT_THAT(refusal(folder.path(), with_depth_unit()).message, HasSubstr("--intrinsics fx,fy"));
  ImportOptions options;
  options.intrinsics = "585,585,1.5,1";
  EXPECT_THAT(refusal(folder.path(), options).message, HasSubstr("--depth-unit"));
  EXPECT_THAT(open(folder.path(),
                   [&] {
                     options.depth_unit_m = 1e-3;
                     return options;
                   }())
                  ->header()
                  .source,
              HasSubstr("neither times nor angles"));
}

TEST(DepthFolder, TakesAnglesFromATable) {
  const TempFolder folder;
  put_depth(folder, "a.png", 700);
  put_depth(folder, "b.png", 700);
  folder.put("turns.csv", "File;Angle\nb.png;90,5\na.png;0\n");
  ImportOptions options = with_depth_unit();
  options.intrinsics = "585,585,1.5,1";
  options.angles = (folder / "turns.csv").string();
  const auto sequence = open(folder.path(), options);
  EXPECT_NEAR(*sequence->frames()[1].angle_rad, 90.5 * kRadiansPerDegree, 1e-12);
  folder.put("turns.csv", "file,angle_deg\nb.png,0\n");
  EXPECT_THAT(refusal(folder.path(), options).message, HasSubstr("does not name a.png"));
}

TEST(DepthFolder, TakesPosesFromATable) {
  const TempFolder folder;
  for (const char* name : {"a.png", "b.png", "c.png"}) put_depth(folder, name, 700);
  folder.put("poses.csv",
             "file;TX [mm];ty [mm];tz [mm];qx;qy;qz;qw;time_s\n"
             "b.png;1500,5;0;0;0;0;0;2;1\na.png;0;0;250;1;0;0;0;0\nc.png;;;;;;;;3\n");
  ImportOptions options = with_depth_unit();
  options.intrinsics = "585,585,1.5,1";
  options.angles = (folder / "poses.csv").string();
  const auto sequence = open(folder.path(), options);
  EXPECT_NEAR(sequence->frames()[1].T_table_sensor->translation().x(), 1.5005, 1e-12);
  EXPECT_NEAR(sequence->frames()[0].T_table_sensor->linear()(1, 1), -1.0, 1e-12);
  EXPECT_EQ(sequence->frames()[2].status, FrameStatus::kDropped);
  folder.put("poses.csv", "file,tx,ty,tz,qx,qy,qz\na.png,0,0,0,0,0,0\n");
  EXPECT_THAT(refusal(folder.path(), options).message, HasSubstr("a pose needs the columns"));
  folder.put("poses.csv", "file,tx,ty,tz,qx,qy,qz,qw\na.png,0,0,0,0,0,0,0\n");
  EXPECT_THAT(refusal(folder.path(), options).message, HasSubstr("line 2"));
}

TEST(DepthFolder, OfStrayScannerIsNotRtabmaps) {
  const TempFolder folder;
  ASSERT_TRUE(fs::create_directory(folder / "depth"));
  put_depth(folder, "depth/000000.png", 700);
  folder.put("camera_matrix.csv", "1600.0, 0.0, 1000.0\n0.0, 1600.0, 750.0\n0.0, 0.0, 1.0\n");
  folder.put("odometry.csv", "timestamp, frame, x, y, z, qx, qy, qz, qw\n");
  const auto sequence = open(folder.path());
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.depth_unit_m, 1e-3);
  EXPECT_NEAR(sensor.intrinsics.fx, 1600.0 * 4 / 2000, 1e-9);
  EXPECT_NEAR(sensor.intrinsics.cy, 1.5, 1e-9);
  EXPECT_THAT(sequence->header().source, HasSubstr("images of about 2000 x 1500 pixels"));
}

TEST(DepthFolder, OfScanNetHasItsCameraAndItsPosesAreNotRead) {
  const TempFolder folder;
  ASSERT_TRUE(fs::create_directory(folder / "depth"));
  ASSERT_TRUE(fs::create_directory(folder / "pose"));
  ASSERT_TRUE(fs::create_directory(folder / "intrinsic"));
  put_depth(folder, "depth/0.PNG", 700);
  folder.put("intrinsic/intrinsic_depth.txt", "580 0 2 0\n0 581 1.5 0\n0 0 1 0\n0 0 0 1\n");
  const auto sequence = open(folder.path(), with_depth_unit());
  EXPECT_EQ(sequence->header().sensors[0].intrinsics.fx, 580.0);
  EXPECT_EQ(sequence->header().sensors[0].intrinsics.cy, 1.5);
  EXPECT_THAT(sequence->header().source, HasSubstr("pose/ is not read"));
}

TEST(DepthFolder, OfOtherFilesIsToldToConvertThem) {
  const TempFolder folder;
  folder.put("depth_0.npz", "x");
  folder.put("views.json", "{}");
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("write depth as 16-bit PNG or NPY"));
  const TempFolder scans;
  scans.put("a.e57", "x");
  EXPECT_THAT(refusal(scans.path()).message, HasSubstr(".e57 files (write its scans as PLY"));
}

TEST(DepthFolder, TakesTheCalibrationsOfOpenCVRosAndOthers) {
  const TempFolder folder;
  put_depth(folder, "a.png", 700);
  ImportOptions options = with_depth_unit();
  options.intrinsics = (folder / "camera").string();
  const auto camera = [&](const std::string& text) {
    folder.put("camera", text);
    return open(folder.path(), options)->header().sensors[0].intrinsics;
  };
  const CameraIntrinsics opencv = camera(
      "%YAML:1.0\n---\nimage_width: 8\nimage_height: 6\ncamera_matrix: !!opencv-matrix\n"
      "   rows: 3\n   cols: 3\n   dt: d\n   data: [ 80., 0., 4., 0.,\n       82., 3., 0., 0., 1. "
      "]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
      "   data: [ 0.1, 0., 0., 0., 0.2 ]\n");
  EXPECT_EQ(opencv.width, 4);
  EXPECT_DOUBLE_EQ(opencv.fx, 40.0);  // 8 x 6 pixels became 4 x 3
  EXPECT_DOUBLE_EQ(opencv.cy, 1.5);
  EXPECT_EQ(opencv.distortion[4], 0.2);
  EXPECT_EQ(camera("height: 3\nwidth: 4\ndistortion_model: plumb_bob\nD: []\n"
                   "K: [40.0, 0.0, 2.0, 0.0, 41.0, 1.5, 0.0, 0.0, 1.0]\n")
                .fy,
            41.0);
  EXPECT_EQ(camera(R"({"width": 4, "height": 3,
                       "intrinsic_matrix": [40, 0, 0, 0, 41, 0, 2, 1.25, 1]})")
                .cy,
            1.25);
  EXPECT_EQ(camera(R"({"camera_matrix": [[40, 0, 2], [0, 41, 1.25], [0, 0, 1]],
                       "dist_coeffs": [[0.1, 0.2, 0, 0, 0]]})")
                .distortion[1],
            0.2);
  EXPECT_EQ(camera(R"({"fx": 40, "fy": 41, "cx": 2, "cy": 1.5})").fx, 40.0);
  const auto why = [&](const std::string& text) {
    folder.put("camera", text);
    return refusal(folder.path(), options).text();
  };
  EXPECT_THAT(why("camera_matrix:\n  data: [1, 2]\n"), HasSubstr("2 numbers, not 9"));
  EXPECT_THAT(why("nothing"), HasSubstr("neither a 3x3 matrix nor a calibration"));
  EXPECT_THAT(why(R"({"fx": 40, "fy": 41})"), HasSubstr("cx is missing"));
  EXPECT_THAT(why("distortion_model: equidistant\nK: [1]\n"), HasSubstr("fisheye"));
}

/// An array as numpy.save() writes it.
template <class T>
std::string npy(std::string_view type, std::string_view shape, const std::vector<T>& values) {
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  header.resize(117, ' ');
  return std::string("\x93NUMPY\1\0\x76\0", 10) + header + '\n' +
         std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

TEST(DepthFolder, TakesArraysOfFloatsInMetres) {
  const TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const char* name : {"10.npy", "9.npy"})
    folder.put(name, npy<float>("<f4", "(1, 2, 3)", {0.5f, 1.00004f, nan, -1.0f, 7.0f, 0.00003f}));
  put_color(folder, "9.png");
  ImportOptions options;
  options.intrinsics = "585,585,1,0.5";
  const auto sequence = open(folder.path(), options);
  ASSERT_EQ(sequence->frames().size(), 2u);
  EXPECT_EQ(sequence->frames()[0].file, "9.npy");
  EXPECT_EQ(sequence->header().sensors[0].depth_unit_m, 1e-4);
  EXPECT_THAT(frame_of(*sequence, 0).depth.pixels, ElementsAre(5000, 10000, 0, 0, 0, 0));
  options.depth_unit_m = 1e-3;
  EXPECT_THAT(frame_of(*open(folder.path(), options), 0).depth.pixels,
              ElementsAre(5, 10, 0, 0, 70, 0));
}

/// What is imported of a folder with this file.
auto pixels_of(const char* name, const std::string& bytes, const ImportOptions& options) {
  const TempFolder folder;
  folder.put(name, bytes);
  return frame_of(*open(folder.path(), options), 0).depth.pixels;
}

TEST(DepthFolder, TakesArraysOfIntegersPgmAndEightBits) {
  ImportOptions options = with_depth_unit();
  options.intrinsics = "585,585,1,0.5";
  const auto pixels = [&](const char* name, const std::string& bytes) {
    return pixels_of(name, bytes, options);
  };
  EXPECT_THAT(pixels("a.npy", npy<std::int32_t>("<i4", "(2, 3)", {70000, 700, -1, 1, 2, 3})),
              ElementsAre(0, 700, 0, 1, 2, 3));
  EXPECT_THAT(pixels("a.npy", npy<std::uint16_t>(">u2", "(1, 2, 2)", {0x0201, 0x0100, 0, 0}) + "x"),
              ElementsAre(0x0102, 1, 0, 0));
  EXPECT_THAT(pixels("a.pgm", std::string("P5\n# a\n2 2\n4095\n\1\2\0\1\0\0\3\0", 25)),
              ElementsAre(0x0102, 1, 0, 0x0300));
  const TempFolder folder;
  ASSERT_TRUE(write_grey_png(folder / "a.png", Image<std::uint8_t>(2, 2, 200)));
  const auto sequence = open(folder.path(), options);
  EXPECT_EQ(frame_of(*sequence, 0).depth.at(1, 1), 200);
  EXPECT_THAT(sequence->header().source, HasSubstr("8 bits"));
}

/// A TIFF of one strip that is not packed, by the specification (TIFF 6.0, sections 2 and 8).
std::string tiff(bool big, std::uint32_t columns, std::uint32_t rows, std::uint16_t bits,
                 std::uint16_t format, const std::string& values, std::uint16_t codec = 1) {
  const auto number = [&](std::uint32_t value, int bytes) {
    std::string out;
    for (int k = 0; k < bytes; ++k) out += char(value >> (8 * (big ? bytes - 1 - k : k)));
    return out;
  };
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t value;
  };
  constexpr std::uint16_t kShort = 3, kLong = 4;
  const std::vector<Entry> entries{
      {256, kLong, columns}, {257, kLong, rows}, {258, kShort, bits},
      {259, kShort, codec},  {262, kShort, 1},   {273, kLong, 8},
      {277, kShort, 1},      {278, kLong, rows}, {279, kLong, std::uint32_t(values.size())},
      {339, kShort, format}};
  std::string out = (big ? "MM" : "II") + number(42, 2);
  out += number(std::uint32_t(8 + values.size()), 4) + values + number(entries.size(), 2);
  for (const Entry& e : entries) {
    const bool is_short = e.type == kShort;
    out += number(e.tag, 2) + number(e.type, 2) + number(1, 4) + number(e.value, is_short ? 2 : 4);
    if (is_short) out += std::string(2, '\0');
  }
  return out + number(0, 4);
}

TEST(DepthFolder, TakesTiffOfIntegersAndFloats) {
  ImportOptions options = with_depth_unit();
  options.intrinsics = "585,585,1,0.5";
  const auto pixels = [&](const char* name, const std::string& bytes) {
    return pixels_of(name, bytes, options);
  };
  const std::string four("\1\2\0\1\0\0\3\0", 8);
  EXPECT_THAT(pixels("a.tiff", tiff(true, 2, 2, 16, 1, four)), ElementsAre(0x0102, 1, 0, 0x0300));
  EXPECT_THAT(pixels("a.tif", tiff(false, 2, 2, 16, 1, four)), ElementsAre(0x0201, 0x0100, 0, 3));
  const std::array<float, 2> floats{0.5f, std::numeric_limits<float>::quiet_NaN()};
  const std::string bytes(reinterpret_cast<const char*>(floats.data()), sizeof(floats));
  options.depth_unit_m.reset();
  EXPECT_THAT(pixels("a.tif", tiff(false, 2, 1, 32, 3, bytes)), ElementsAre(5000, 0));
}

TEST(DepthFolder, TiffThatIsNotDepthOrIsDamagedIsNamed) {
  ImportOptions options = with_depth_unit();
  options.intrinsics = "585,585,1,0.5";
  const auto why = [&](const std::string& bytes) {
    const TempFolder folder;
    folder.put("a.tif", bytes);
    return refusal(folder.path(), options).text();
  };
  const std::string four(8, '\1');
  EXPECT_THAT(why(tiff(false, 2, 2, 12, 1, four)), HasSubstr("12 bits a value"));
  EXPECT_THAT(why(tiff(false, 2, 2, 16, 1, four, 7)), HasSubstr("codec 7"));
  EXPECT_THAT(why(tiff(false, 20000, 600, 16, 1, four)), HasSubstr("cannot hold 20000 x 600"));
  EXPECT_THAT(why(tiff(false, 60000, 60000, 16, 1, four)), HasSubstr("at most"));
  EXPECT_THAT(why(tiff(false, 2, 300, 16, 1, four)), HasSubstr("row"));
  EXPECT_THAT(why(tiff(false, 2, 2, 16, 1, four).substr(0, 40)), HasSubstr("tables"));
}

TEST(DepthFolder, TakesSnapshotsOfRealSenseViewer) {
  const TempFolder folder;
  // As common/model-views.cpp of librealsense writes them.
  const char* table =
      "Frame Info: \nType,Depth\nFormat,Z16\nFrame Number,42\nTimestamp (ms),1.00\n"
      "Resolution x,3\nResolution y,2\nBytes per pixel,2\n\nIntrinsic:,\nFx,425.5\nFy,425.25\n"
      "PPx,1.5\nPPy,0.75\nDistorsion,Brown Conrady\n";
  for (const char* name : {"b_Depth", "a_Depth"}) {
    folder.put(std::string(name) + ".raw", std::string("\1\2\0\0\3\0\4\0\5\0\6\0", 12));
    folder.put(std::string(name) + "_metadata.csv", table);
    ASSERT_TRUE(write_color_png(folder / (std::string(name) + "_Color.png"), ColorImage(3, 2)));
  }
  const auto sequence = open(folder.path(), with_depth_unit());
  ASSERT_EQ(sequence->frames().size(), 2u);
  const CameraIntrinsics& camera = sequence->header().sensors[0].intrinsics;
  EXPECT_EQ(camera.fx, 425.5);
  EXPECT_EQ(camera.cy, 0.75);
  EXPECT_THAT(frame_of(*sequence, 0).depth.pixels, ElementsAre(0x0201, 0, 3, 4, 5, 6));
  folder.put("a_Depth.raw", "short");
  EXPECT_THAT(refusal(folder.path(), with_depth_unit()).text(), HasSubstr("cannot hold 3 x 2"));
  std::filesystem::remove(folder / "a_Depth_metadata.csv");
  EXPECT_THAT(refusal(folder.path(), with_depth_unit()).text(), HasSubstr("a_Depth_metadata.csv"));
}

/// An EXR of one part in rows that are not packed, by "OpenEXR File Layout". A value is 2 bytes
/// (half) or 4; `rows` hold the channels of a row one after the other.
struct ExrFile {
  std::vector<std::string> channels{"Y"};
  std::int32_t type = 2;  ///< 0: whole numbers, 1: half, 2: float
  std::int32_t columns = 2;
  std::vector<std::string> rows;
  char codec = 0;
  std::int32_t left = 0;  ///< of the data window
  std::string bytes() const {
    const auto attribute = [](std::string name, std::string kind, const std::string& value) {
      return name + '\0' + kind + '\0' + raw(std::int32_t(value.size())) + value;
    };
    const auto box = [&](std::int32_t x) {
      return raw(x) + raw(0) + raw(x + columns - 1) + raw(std::int32_t(rows.size()) - 1);
    };
    std::string list, out("\x76\x2f\x31\x01\2\0\0\0", 8);
    for (const std::string& name : channels)
      list += name + '\0' + raw(type) + raw(0) + raw(1) + raw(1);
    out += attribute("channels", "chlist", list + '\0') +
           attribute("compression", "compression", {codec}) +
           attribute("dataWindow", "box2i", box(left)) +
           attribute("displayWindow", "box2i", box(0)) +
           attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
           attribute("pixelAspectRatio", "float", raw(1.0f)) +
           attribute("screenWindowCenter", "v2f", raw(0.0f) + raw(0.0f)) +
           attribute("screenWindowWidth", "float", raw(1.0f)) + '\0';
    std::uint64_t at = out.size() + 8 * rows.size();
    for (const std::string& row : rows) {
      out += raw(at);
      at += 8 + row.size();
    }
    for (std::size_t y = 0; y < rows.size(); ++y)
      out += raw(std::int32_t(y)) + raw(std::int32_t(rows[y].size())) + rows[y];
    return out;
  }
};

TEST(DepthFolder, TakesExrOfFloatsHalvesAndWholeNumbers) {
  ImportOptions options;
  options.intrinsics = "585,585,1,0.5";
  const auto pixels = [&](const ExrFile& file) {
    const TempFolder folder;
    folder.put("a.exr", file.bytes());
    return frame_of(*open(folder.path(), options), 0).depth.pixels;
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::string near = raw(0.5f) + raw(kNan);
  const std::string far = raw(-1.0f) + raw(1e10f);
  EXPECT_THAT(pixels({.rows = {near, far}}), ElementsAre(5000, 0, 0, 0));
  EXPECT_THAT(pixels({.channels = {"Depth.Z", "V"}, .rows = {near + far, far + near}}),
              ElementsAre(5000, 0, 0, 0));
  EXPECT_THAT(pixels({.channels = {"A", "B", "Z"}, .rows = {far + far + near}}),
              ElementsAre(5000, 0));
  const std::string halves = raw(std::uint16_t(0x3800)) + raw(std::uint16_t(0x7e00));
  EXPECT_THAT(pixels({.type = 1, .rows = {halves}}), ElementsAre(5000, 0));  // 0.5 and no number
  options.depth_unit_m = 1e-3;
  const std::string whole = raw(std::uint32_t(700)) + raw(std::uint32_t(70000));
  EXPECT_THAT(pixels({.type = 0, .rows = {whole}}), ElementsAre(700, 0));
}

TEST(DepthFolder, ExrThatIsNotDepthOrIsDamagedIsNamed) {
  ImportOptions options;
  options.intrinsics = "585,585,1,0.5";
  const auto why = [&](const std::string& bytes) {
    const TempFolder folder;
    folder.put("a.exr", bytes);
    return refusal(folder.path(), options).text();
  };
  const std::string row = raw(0.5f) + raw(0.5f);
  EXPECT_THAT(why(ExrFile{.channels = {"B", "G", "R"}, .rows = {row + row + row}}.bytes()),
              HasSubstr("3 channels (B, G, ...), and none is named Z or depth"));
  EXPECT_THAT(why(ExrFile{.rows = {row}, .codec = 8}.bytes()), HasSubstr("B44 or DWA"));
  EXPECT_THAT(why(ExrFile{.rows = {row}, .left = 1}.bytes()), HasSubstr("a part of its image"));
  EXPECT_THAT(why(ExrFile{.columns = 70000, .rows = {row}}.bytes()), HasSubstr("at most"));
  const std::string two = ExrFile{.rows = {row, row}}.bytes();
  EXPECT_THAT(why(two.substr(0, two.size() - 9)), HasSubstr("row 1 of 2"));
  EXPECT_THAT(why(two.substr(0, 100)), HasSubstr("header"));
  EXPECT_THAT(why(ExrFile{.columns = 60000, .rows = {row}}.bytes()), HasSubstr("row 0 of 1"));
}

TEST(DepthFolder, DamagedArraysAreNamed) {
  ImportOptions options = with_depth_unit();
  options.intrinsics = "585,585,1,0.5";
  const auto why = [&](const char* name, const std::string& bytes) {
    const TempFolder folder;
    folder.put(name, bytes);
    return refusal(folder.path(), options).text();
  };
  const std::vector<std::uint16_t> four(4, 7);
  EXPECT_THAT(why("a.npy", npy("<u2", "(20000, 600)", four)), HasSubstr("cannot hold 600 x 20000"));
  EXPECT_THAT(why("a.npy", npy("<u2", "(70000, 70000)", four)), HasSubstr("at most"));
  EXPECT_THAT(why("a.npy", npy("<u2", "(4,)", four)), HasSubstr("not one image"));
  EXPECT_THAT(why("a.npy", npy("<c8", "(2, 2)", four)), HasSubstr("uint16 or float32"));
  EXPECT_THAT(why("a.npy", npy("|O", "(2, 2)", four)), HasSubstr("plain numbers"));
  EXPECT_THAT(why("a.npy", std::string("\x93NUMPY\2\0\xff\xff\xff\xff{}", 14)),
              HasSubstr("cut off"));
  EXPECT_THAT(why("a.pgm", "P5 2 2 255\nabcd"), HasSubstr("up to 255"));
  EXPECT_THAT(why("a.pgm", "P5 2 # 2"), HasSubstr("header"));
}

TEST(FramePose, ReadsDepthColourPosesAndIntrinsics) {
  const TempFolder folder;
  put_frame_pose(folder);
  const auto sequence = open(folder.path(), with_depth_unit());
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.intrinsics.fx, 585.0);
  EXPECT_EQ(sensor.intrinsics.fy, 585.5);
  EXPECT_EQ(sensor.intrinsics.cx, 2.0);
  EXPECT_EQ(sensor.intrinsics.cy, 1.0);
  EXPECT_EQ(sensor.intrinsics.width, 4);
  EXPECT_EQ(sensor.intrinsics.height, 3);
  EXPECT_EQ(sensor.depth_unit_m, 1e-3);
  ASSERT_EQ(sequence->frames().size(), 2u);
  EXPECT_EQ(sequence->frames()[0].index, 7u);
  EXPECT_EQ(sequence->frames()[1].index, 10u);
  EXPECT_LT((*sequence->frames()[1].T_table_sensor * Vec3d(0, 0, 2) - Vec3d(3, 0, 0)).norm(),
            1e-12);
  EXPECT_TRUE(frame_of(*sequence, 0).color.empty());
  EXPECT_EQ(frame_of(*sequence, 1).color.at(1, 1), (Rgb{1, 2, 3}));
}

TEST(FramePose, TakesCamerasAndOffsetOfAKinect2Calibration) {
  const TempFolder folder;
  put_frame_pose(folder);
  fs::create_directory(folder.path() / "k");
  folder.put("k/calib_depth.yaml", "depthShift: -20\n");
  ImportOptions options = with_depth_unit();
  options.iai_kinect2 = (folder.path() / "k").string();
  const auto sequence = open(folder.path(), options);
  EXPECT_DOUBLE_EQ(sequence->header().sensors[0].depth_bias_m, -0.02);
  EXPECT_EQ(sequence->header().sensors[0].intrinsics.fx, 585.0);
  // Images of another size than a Kinect v2's.
  folder.put("k/calib_ir.yaml",
             "cameraMatrix: [ 365, 0, 250, 0, 365, 200, 0, 0, 1 ]\n"
             "distortionCoefficients: [ 0, 0, 0, 0, 0 ]\n");
  const Error error = refusal(folder.path(), options);
  EXPECT_EQ(error.code, ErrorCode::kInvalidOption);
  EXPECT_THAT(error.message, HasSubstr("512 x 424"));
}

TEST(FramePose, MissingDepthIsNoReturnWhicheverWayItIsMarked) {
  const TempFolder folder;
  put_frame_pose(folder);
  const Frame frame = frame_of(*open(folder.path(), with_depth_unit()), 0);
  EXPECT_EQ(frame.depth.at(0, 0), kNoReturn);
  EXPECT_EQ(frame.depth.at(3, 2), kNoReturn);
  EXPECT_EQ(frame.depth.at(1, 1), 700);
}

TEST(FramePose, AsksForTheDepthUnit) {
  const TempFolder folder;
  put_frame_pose(folder);
  const Error error = refusal(folder.path());
  EXPECT_EQ(error.code, ErrorCode::kMissingData);
  EXPECT_THAT(error.message, HasSubstr("--depth-unit"));
}

TEST(FramePose, PosesMayBeWorldToCamera) {
  const TempFolder folder;
  put_frame_pose(folder);
  ImportOptions options = with_depth_unit();
  options.pose_direction = PoseDirection::kWorldToCamera;
  const auto sequence = open(folder.path(), options);
  EXPECT_LT((*sequence->frames()[1].T_table_sensor * Vec3d(3, 0, 0) - Vec3d(0, 0, 2)).norm(),
            1e-12);
}

TEST(FramePose, LostTrackingDropsTheFrameWithANote) {
  const TempFolder folder;
  put_frame_pose(folder);
  folder.put("frame-000007.pose.txt", "nan nan nan nan nan nan nan nan -inf 0 0 0 0 0 0 1");
  const auto sequence = open(folder.path(), with_depth_unit());
  EXPECT_EQ(sequence->frames()[0].status, FrameStatus::kDropped);
  EXPECT_EQ(sequence->frames()[1].status, FrameStatus::kOk);
  EXPECT_FALSE(sequence->read(0));
  EXPECT_THAT(sequence->header().source, HasSubstr("1 of 2 frames"));
}

TEST(FramePose, WrongPosesAndNumbersAreNamed) {
  const TempFolder folder;
  put_frame_pose(folder);
  for (const char* bad : {"", "1 0 0", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 x",
                          "2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "nan 1"}) {
    folder.put("frame-000007.pose.txt", bad);
    EXPECT_THAT(refusal(folder.path(), with_depth_unit()).text(),
                HasSubstr("frame-000007.pose.txt"))
        << bad;
  }
  folder.put("frame-000007.pose.txt", kIdentity);
  put_depth(folder, "frame-7.depth.png", 1);
  EXPECT_THAT(refusal(folder.path(), with_depth_unit()).message, HasSubstr("same number"));
  fs::rename(folder / "frame-7.depth.png", folder / "frame-x.depth.png");
  EXPECT_THAT(refusal(folder.path(), with_depth_unit()).text(), HasSubstr("frame-x.depth.png"));
}

TEST(FramePose, IntrinsicsCanBeStated) {
  const TempFolder folder;
  put_frame_pose(folder);
  fs::remove(folder / "camera-intrinsics.txt");
  ImportOptions options = with_depth_unit();
  EXPECT_THAT(refusal(folder.path(), options).message, HasSubstr("--intrinsics"));
  options.intrinsics = "500, 501, 2, 1.5";
  EXPECT_EQ(open(folder.path(), options)->header().sensors[0].intrinsics.fy, 501.0);
  options.intrinsics = folder.put("k.txt", "400 0 2 0 401 1 0 0 1");
  EXPECT_EQ(open(folder.path(), options)->header().sensors[0].intrinsics.fy, 401.0);
  options.intrinsics = "500,501,2";
  EXPECT_EQ(refusal(folder.path(), options).code, ErrorCode::kInvalidOption);
  options.intrinsics = "-500,501,2,1";
  EXPECT_EQ(refusal(folder.path(), options).code, ErrorCode::kFormat);
}

TEST(FramePose, ColourOfAnotherSizeIsLeftOutWithANote) {
  const TempFolder folder;
  put_frame_pose(folder);
  put_color(folder, "frame-000010.color.png", 9);
  const auto sequence = open(folder.path(), with_depth_unit());
  EXPECT_TRUE(frame_of(*sequence, 1).color.empty());
  EXPECT_THAT(sequence->header().source, HasSubstr("not registered"));
}

/// Depth at 1.0, 1.1, 1.2 s; colour near the first two; poses that move along x with time.
void put_tum(const TempFolder& folder) {
  fs::create_directory(folder / "depth");
  fs::create_directory(folder / "rgb");
  for (const char* name : {"depth/a.png", "depth/b.png", "depth/c.png"})
    put_depth(folder, name, 5000);
  put_color(folder, "rgb/a.png");
  put_color(folder, "rgb/b.png");
  folder.put("depth.txt", "# depth maps\n1.2 depth/c.png\n1.0 depth/a.png\n1.1 depth/b.png\n");
  folder.put("rgb.txt", "1.015 rgb/a.png\n1.125 rgb/b.png\n");
  folder.put("groundtruth.txt",
             "0.99 0.99 0 0 0 0 0 1\n1.01 1.01 0 0 0 0 0 1\n1.115 1.115 0 0 0 0 0 1\n");
}

ImportOptions with_intrinsics() {
  ImportOptions options;
  options.intrinsics = "525,525,2,1";
  return options;
}

TEST(Tum, DepthHas5000StepsAMetreAndItSaysSo) {
  const TempFolder folder;
  put_tum(folder);
  const auto sequence = open(folder.path(), with_intrinsics());
  EXPECT_DOUBLE_EQ(sequence->header().sensors[0].depth_unit_m, 0.0002);
  EXPECT_THAT(sequence->header().source, HasSubstr("5000 steps"));
  EXPECT_EQ(sequence->header().sensors[0].model, "kinect-v1") << "whose range the unit has to fit";
  ImportOptions stated = with_intrinsics();
  stated.depth_unit_m = 1e-3;
  EXPECT_DOUBLE_EQ(open(folder.path(), stated)->header().sensors[0].depth_unit_m, 0.001);
}

/// An image whose values are multiples of a number, in a folder of 5000 steps a metre.
std::unique_ptr<FrameSequence> in_steps_of(const TempFolder& folder, unsigned steps) {
  DepthImage image(40, 2);
  for (unsigned i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = std::uint16_t(i == 3 ? 65535 : steps * (1000 + i / 2));
  EXPECT_TRUE(write_depth_png(folder / "a.png", image));
  folder.put("depth.txt", "0 a.png\n");
  folder.put("cam_K.txt", "500 0 20 0 500 1 0 0 1");
  return open(folder.path());
}

TEST(Tum, DepthsThatAreAllMultiplesAreReadInTheStepsOfTheirSensor) {
  const TempFolder rounded, fine;
  const auto got = in_steps_of(rounded, 5), as_it_is = in_steps_of(fine, 1);
  EXPECT_DOUBLE_EQ(got->header().sensors[0].depth_unit_m, 1e-3);
  EXPECT_THAT(got->header().source, HasSubstr("a multiple of 5 steps: the sensor's are 1mm"));
  const Frame frame = frame_of(*got, 0);
  EXPECT_EQ(frame.depth.at(10, 0), 1005);
  EXPECT_EQ(frame.depth.at(3, 0), kNoReturn);
  EXPECT_EQ(as_it_is->header().sensors[0].depth_unit_m, 1.0 / 5000);
  EXPECT_EQ(frame_of(*as_it_is, 0).depth.at(10, 0), 1005);
}

TEST(Tum, FramesAreInTheOrderOfTimeWithTheColourNearest) {
  const TempFolder folder;
  put_tum(folder);
  const auto sequence = open(folder.path(), with_intrinsics());
  ASSERT_EQ(sequence->frames().size(), 3u);
  EXPECT_EQ(sequence->frames()[0].time_s, 1.0);
  EXPECT_EQ(sequence->frames()[2].file, "depth/c.png");
  EXPECT_FALSE(frame_of(*sequence, 0).color.empty());
  EXPECT_TRUE(frame_of(*sequence, 1).color.empty());  // 25 ms away
}

TEST(Tum, PosesAreInterpolatedOrTakenFromTheNearestWithin20Milliseconds) {
  const TempFolder folder;
  put_tum(folder);
  const auto sequence = open(folder.path(), with_intrinsics());
  EXPECT_NEAR(sequence->frames()[0].T_table_sensor->translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(sequence->frames()[1].T_table_sensor->translation().x(), 1.115, 1e-12);
  EXPECT_FALSE(sequence->frames()[2].T_table_sensor);
  EXPECT_EQ(sequence->frames()[2].status, FrameStatus::kDropped);
  EXPECT_THAT(sequence->header().source, HasSubstr("1 of 3 frames have no pose within 20 ms"));
}

TEST(Tum, WithoutGroundTruthFramesHaveTimesOnly) {
  const TempFolder folder;
  put_tum(folder);
  fs::remove(folder / "groundtruth.txt");
  fs::remove(folder / "rgb.txt");
  const auto sequence = open(folder.path(), with_intrinsics());
  EXPECT_EQ(sequence->frames()[2].status, FrameStatus::kOk);
  EXPECT_FALSE(sequence->frames()[0].T_table_sensor);
}

/// Put where a file was, it fails for the superuser, too.
void make_unreadable(const fs::path& path) {
  fs::remove(path);
  fs::create_symlink(path.filename(), path);
}

TEST(Tum, ListsThatCannotBeReadAreNotMissing) {
  for (const char* name : {"groundtruth.txt", "rgb.txt", "depth/c.png"}) {
    const TempFolder folder;
    put_tum(folder);
    make_unreadable(folder / name);
    EXPECT_EQ(refusal(folder.path(), with_intrinsics()).code, ErrorCode::kIo) << name;
  }
}

TEST(FramePose, APoseThatCannotBeReadIsNotMissing) {
  for (const char* name : {"frame-000010.pose.txt", "camera-intrinsics.txt"}) {
    const TempFolder folder;
    put_frame_pose(folder);
    make_unreadable(folder / name);
    EXPECT_EQ(refusal(folder.path(), with_depth_unit()).code, ErrorCode::kIo) << name;
  }
}

TEST(Tum, IntrinsicsAreKnownByTheFoldersName) {
  const TempFolder parent;
  const fs::path folder = parent / "rgbd_dataset_freiburg2_desk";
  {
    const TempFolder data;
    put_tum(data);
    fs::copy(data.path(), folder, fs::copy_options::recursive);
    EXPECT_THAT(refusal(data.path()).message, HasSubstr("--intrinsics"));
  }
  const auto sequence = open(folder);
  EXPECT_EQ(sequence->header().sensors[0].intrinsics.fx, 525.0);
  EXPECT_THAT(sequence->header().source, HasSubstr("319.5"));
}

TEST(Tum, WrongLinesAreNamed) {
  const TempFolder folder;
  put_tum(folder);
  folder.put("groundtruth.txt", "# t x y z\n1.0 0 0 0 0 0 0 0\n");
  EXPECT_THAT(refusal(folder.path(), with_intrinsics()).text(),
              HasSubstr("groundtruth.txt: line 2: pose"));
  folder.put("groundtruth.txt", "1.0 0 0 0 0 0 0\n");
  EXPECT_THAT(refusal(folder.path(), with_intrinsics()).text(), HasSubstr("line 1: there are 7"));
  fs::remove(folder / "groundtruth.txt");
  folder.put("depth.txt", "nan depth/a.png\n");
  EXPECT_THAT(refusal(folder.path(), with_intrinsics()).text(), HasSubstr("line 1: 'nan'"));
  folder.put("depth.txt", "1.0 depth/z.png\n");
  EXPECT_EQ(refusal(folder.path(), with_intrinsics()).code, ErrorCode::kNotFound);
  folder.put("depth.txt", "# nothing\n");
  EXPECT_FALSE(open_foreign(folder.path(), with_intrinsics()));
}

constexpr const char* kCamera =
    R"("intrinsics": {"fx": 600, "fy": 601, "cx": 2, "cy": 1, "width": 4, "height": 3,
       "depth_unit_m": 0.001})";

void put_views(const TempFolder& folder, const std::string& more) {
  put_depth(folder, "depth_0.png", 400);
  put_depth(folder, "depth_1.png", 401);
  put_color(folder, "color_1.png");
  folder.put("views.json", std::string("{") + kCamera + ", " + more + "}");
}

TEST(JsonPng, ReadsAnglesAndTheAxis) {
  const TempFolder folder;
  put_views(folder, R"("axis_dir": [0, -2, 0], "axis_point": [0, 0.1, 0.4],
                       "angle_rad": [0, 9], "angle_rad_closed": [0, -0.5])");
  const auto sequence = open(folder.path());
  ASSERT_EQ(sequence->frames().size(), 2u);
  EXPECT_EQ(*sequence->frames()[1].angle_rad, -0.5);
  EXPECT_EQ(sequence->header().turntable->axis, Vec3d(0, -1, 0));
  EXPECT_EQ(sequence->header().turntable->center_m, Vec3d(0, 0.1, 0.4));
  EXPECT_THAT(sequence->header().source,
              AllOf(HasSubstr("angle_rad_closed was taken"), HasSubstr("--platter-height")));
  EXPECT_TRUE(frame_of(*sequence, 0).color.empty());
  EXPECT_FALSE(frame_of(*sequence, 1).color.empty());
}

TEST(JsonPng, ImagesMayBeArraysInItsUnit) {
  const TempFolder folder;
  folder.put("views.json", R"({"intrinsics": {"width": 3, "height": 2, "fx": 80, "fy": 80,
             "cx": 1, "cy": 0.5, "depth_unit_m": 0.001}, "angle_deg": [0, 45]})");
  for (const char* name : {"depth_0.npy", "depth_1.npy"})
    folder.put(name, npy<double>("<f8", "(2, 3)", {700.0, 0.0, 1.0, 2.0, 3.0, 4.04}));
  ASSERT_TRUE(write_color_png(folder / "color_1.png", ColorImage(3, 2)));
  const auto sequence = open(folder.path());
  EXPECT_EQ(sequence->header().sensors[0].depth_unit_m, 1e-4);
  const Frame frame = frame_of(*sequence, 1);
  EXPECT_THAT(frame.depth.pixels, ElementsAre(7000, 0, 10, 20, 30, 40));
  EXPECT_FALSE(frame.color.empty());
  std::filesystem::remove(folder / "depth_1.npy");
  EXPECT_THAT(refusal(folder.path()).text(), HasSubstr("depth_1.npy"));
}

TEST(JsonPng, PlatterHeightMovesTheCentreAlongTheAxis) {
  const TempFolder folder;
  put_views(folder, R"("axis_dir": [0, -1, 0], "axis_point": [0, 0.1, 0.4], "angle_deg": [0, 45])");
  ImportOptions options;
  options.platter_height_m = 0.02;
  const auto sequence = open(folder.path(), options);
  EXPECT_LT((sequence->header().turntable->center_m - Vec3d(0, 0.08, 0.4)).norm(), 1e-12);
  EXPECT_THAT(sequence->header().source, HasSubstr("20mm above"));
  EXPECT_THAT(sequence->header().source, Not(HasSubstr("--platter-height")));
}

TEST(JsonPng, FileMaySayThePlattersHeightAndRadius) {
  const TempFolder folder;
  put_views(folder, R"("axis_dir": [0, -1, 0], "axis_point": [0, 0.1, 0.4], "radius_m": 0.12,
                       "platter_height_m": -0.01, "speed_rad_s": 0.2, "times_s": [0, 1.5])");
  const auto sequence = open(folder.path());
  const TurntableInfo& table = *sequence->header().turntable;
  EXPECT_LT((table.center_m - Vec3d(0, 0.11, 0.4)).norm(), 1e-12);
  EXPECT_EQ(*table.radius_m, 0.12);
  EXPECT_EQ(*table.speed_rad_s, 0.2);
  EXPECT_EQ(sequence->frames()[1].time_s, 1.5);
  EXPECT_FALSE(sequence->frames()[1].angle_rad);
  EXPECT_THAT(sequence->header().source, Not(HasSubstr("--platter-height")));
}

TEST(JsonPng, AxisThatPointsDownIsTurnedRoundWithTheAngles) {
  const TempFolder folder;
  put_views(folder, R"("axis_dir": [0, 0.8, 0.6], "axis_point": [0, 0.1, 0.4],
                       "platter_height_m": 0.01, "speed_rad_s": 0.2, "angle_rad": [0, 0.5])");
  const auto sequence = open(folder.path());
  const TurntableInfo& table = *sequence->header().turntable;
  EXPECT_LT((table.axis - Vec3d(0, -0.8, -0.6)).norm(), 1e-12);
  EXPECT_LT((table.center_m - Vec3d(0, 0.092, 0.394)).norm(), 1e-12);
  EXPECT_EQ(*table.speed_rad_s, -0.2);
  EXPECT_EQ(*sequence->frames()[1].angle_rad, -0.5);
  EXPECT_THAT(sequence->header().source, HasSubstr("turned round"));
}

TEST(JsonPng, LevelAxisIsLeftAloneWithANote) {
  const TempFolder folder;
  put_views(folder, R"("axis_dir": [1, 0.01, 0], "axis_point": [0, 0, 0.4], "angle_rad": [0, 1])");
  const auto sequence = open(folder.path());
  EXPECT_GT(sequence->header().turntable->axis.x(), 0.9);
  EXPECT_THAT(sequence->header().source, HasSubstr("not checked"));
}

TEST(JsonPng, ListsOfFilesPosesPassesAndColourCamera) {
  const TempFolder folder;
  put_depth(folder, "near.png", 400);
  put_color(folder, "near-color.png", 9);
  folder.put("v.json", std::string("{") + kCamera + R"(, "depth_files": ["near.png"],
    "color_files": ["near-color.png"], "passes": [3], "model": "d435", "depth_bias_m": 0.002,
    "poses": [[[1,0,0,0.5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]],
    "color_intrinsics": {"fx": 900, "fy": 900, "cx": 4, "cy": 1, "width": 9, "height": 3},
    "T_color_sensor": [1,0,0,0.015, 0,1,0,0, 0,0,1,0, 0,0,0,1]})");
  const auto sequence = open(folder / "v.json");
  EXPECT_EQ(sequence->frames()[0].pass, 3u);
  EXPECT_EQ(sequence->frames()[0].T_table_sensor->translation(), Vec3d(0.5, 0, 0));
  const SensorInfo& sensor = sequence->header().sensors[0];
  EXPECT_EQ(sensor.model, "d435");
  EXPECT_EQ(sensor.depth_bias_m, 0.002);
  EXPECT_EQ(sensor.color_intrinsics->fx, 900);
  EXPECT_EQ(sensor.T_color_sensor.translation(), Vec3d(0.015, 0, 0));
  EXPECT_EQ(frame_of(*sequence, 0).color.width, 9);
}

TEST(JsonPng, DepthUnitIsAskedForWhenTheFileDoesNotSayIt) {
  const TempFolder folder;
  put_views(folder, R"("angle_rad": [0, 1])");
  std::string text = testing::content_of(folder / "views.json");
  text.replace(text.find("depth_unit_m"), 12, "depth_unit_x");
  folder.put("views.json", text);
  EXPECT_EQ(refusal(folder.path()).code, ErrorCode::kMissingData);
  EXPECT_EQ(open(folder.path(), with_depth_unit())->header().sensors[0].depth_unit_m, 1e-3);
}

TEST(JsonPng, WrongFilesAreNamed) {
  const TempFolder folder;
  const auto message = [&](const std::string& more) {
    put_views(folder, more);
    return refusal(folder.path()).text();
  };
  EXPECT_THAT(message(R"("angle_rad": [0, 1, 2])"), HasSubstr("depth_2.png"));
  EXPECT_THAT(message(R"("angle_rad": [0, 1], "times_s": [0])"), HasSubstr("times_s has 1"));
  EXPECT_THAT(message(R"("angle_rad": [0, null])"), HasSubstr("angle_rad[1] is not a number"));
  EXPECT_THAT(message(R"("angle_rad": [0, 1], "axis_dir": [0,0,0], "axis_point": [0,0,0])"),
              HasSubstr("axis_dir"));
  EXPECT_THAT(message(R"("angle_rad": [0, 1], "axis_dir": [0,1,0])"), HasSubstr("axis_point"));
  EXPECT_THAT(message(R"("depth_files": ["../depth_0.png"])"), HasSubstr("inside"));
  EXPECT_THAT(message(R"("poses": [[1,2,3]])"), HasSubstr("poses[0]"));
  EXPECT_THAT(message(R"("angle_rad": [0, 1], "passes": [0.5, 1])"), HasSubstr("passes"));
  EXPECT_THAT(message(R"("angle_rad": [0, 1)"), HasSubstr("not valid JSON"));
}

TEST(JsonPng, WithoutAnyListTheNumberedImagesAreTheViews) {
  const TempFolder folder;
  put_views(folder, R"("model": "d435")");
  fs::rename(folder.path() / "depth_0.png", folder.path() / "depth_009.png");
  fs::rename(folder.path() / "depth_1.png", folder.path() / "depth_10.png");
  folder.put("depth_map.png", "no number");
  const auto sequence = open(folder.path());
  const auto& frames = sequence->frames();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].file, "depth_009.png");
  EXPECT_EQ(frames[1].file, "depth_10.png");
  fs::copy_file(folder.path() / "depth_10.png", folder.path() / "depth_0010.png");
  EXPECT_THAT(refusal(folder.path()).text(), HasSubstr("have the same number"));
  for (const char* name : {"depth_009.png", "depth_10.png", "depth_0010.png"})
    fs::remove(folder.path() / name);
  EXPECT_THAT(refusal(folder.path()).text(), HasSubstr("lists no views"));
}

TEST(JsonPng, ImageOfAnotherSizeIsAnErrorWhenItIsRead) {
  const TempFolder folder;
  put_views(folder, R"("angle_rad": [0, 1])");
  ASSERT_TRUE(write_depth_png(folder / "depth_1.png", DepthImage(5, 3, 100)));
  const auto sequence = open(folder.path());
  EXPECT_TRUE(sequence->read(0));
  EXPECT_EQ(sequence->read(1).error().code, ErrorCode::kFormat);
}

}  // namespace
}  // namespace turnscan
