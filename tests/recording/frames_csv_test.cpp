#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>
#include <numbers>
#include <turnscan/recording/frames_csv.hpp>

namespace turnscan::recording_format {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string table(const std::string& lines) { return frames_csv_header() + lines; }

FrameTable parsed(const std::string& text, std::size_t sensors = 1) {
  auto result = parse_frames_csv(text, sensors);
  EXPECT_TRUE(result) << result.error().text();
  return result.value_or(FrameTable{});
}

std::string refusal(const std::string& text, std::size_t sensors = 1) {
  const auto result = parse_frames_csv(text, sensors);
  EXPECT_FALSE(result);
  return result ? "" : result.error().message;
}

TEST(FramesCsv, LineHasAFieldForEachColumn) {
  FrameInfo info;
  info.index = 7;
  info.time_s = 0.25;
  info.sensor = 0;
  info.pass = 2;
  info.turn = 3;
  info.angle_rad = std::numbers::pi / 2;
  info.file = "depth/000007.png";
  EXPECT_EQ(frames_csv_line(info, "color/000007.png"),
            "7,0.25,0,2,3,90,,,,,,,,depth/000007.png,color/000007.png,ok\n");
}

TEST(FramesCsv, NamesThatNeedQuotesReadBack) {
  for (const std::string name : {"a,1.png", "a\"b\".png", " a.png"}) {
    FrameInfo info;
    info.file = name;
    const FrameTable t = parsed(table(frames_csv_line(info, name)));
    ASSERT_EQ(t.rows.size(), 1u);
    EXPECT_EQ(t.rows[0].info.file, name);
    EXPECT_EQ(t.rows[0].color_file, name);
  }
}

TEST(FramesCsv, TimesAnglesAndPosesThatNoScanHasAreRefused) {
  EXPECT_THAT(refusal(table("0,1e307,0,0,0,,,,,,,,,a.png,,\n")), HasSubstr("its time"));
  EXPECT_THAT(refusal(table("0,0,0,0,0,1e300,,,,,,,,a.png,,\n")), HasSubstr("its angle"));
  EXPECT_THAT(refusal(table("0,0,0,0,0,,1e8,0,0,0,0,0,1,a.png,,\n")), HasSubstr("km"));
  parsed(table("0,1.7e12,0,0,0,36000,1e5,0,0,0,0,0,1,a.png,,\n"));
}

TEST(FramesCsv, EmptyFieldsAreUnknown) {
  const FrameTable t = parsed(table("3,,,,,,,,,,,,,depth/000003.png,,\n"));
  ASSERT_EQ(t.rows.size(), 1u);
  const FrameInfo& info = t.rows[0].info;
  EXPECT_EQ(info.index, 3u);
  EXPECT_TRUE(std::isnan(info.time_s));
  EXPECT_FALSE(info.angle_rad);
  EXPECT_FALSE(info.T_table_sensor);
  EXPECT_EQ(info.status, FrameStatus::kOk);
}

TEST(FramesCsv, ColumnsMayStandInAnyOrderAndUnknownOnesAreIgnored) {
  const FrameTable t = parsed("file,exposure_ms,index,pass\na.png,12.5,4,1\n");
  ASSERT_EQ(t.rows.size(), 1u);
  EXPECT_EQ(t.rows[0].info.file, "a.png");
  EXPECT_EQ(t.rows[0].info.index, 4u);
  EXPECT_EQ(t.rows[0].info.pass, 1u);
}

TEST(FramesCsv, WindowsLineEndsAndAByteOrderMarkAreAccepted) {
  const FrameTable t = parsed("\xEF\xBB\xBFindex,file\r\n1,a.png\r\n");
  ASSERT_EQ(t.rows.size(), 1u);
  EXPECT_EQ(t.rows[0].info.file, "a.png");
}

TEST(FramesCsv, LastLineHalfWrittenIsLeftOutWithANote) {
  const FrameTable t = parsed(table("0,,0,0,0,,,,,,,,,a.png,,ok\n1,,0,0,0,,,,,,,,,depth/00"));
  EXPECT_EQ(t.rows.size(), 1u);
  EXPECT_THAT(t.notes, ElementsAre(HasSubstr("half written")));
}

TEST(FramesCsv, AnyCutOfTheLastLineLeavesTheLinesBeforeIt) {
  const std::string first = "0,0.5,0,0,0,10,1,2,3,0,0,0,1,depth/000000.png,,ok\n";
  const std::string last = "1,0.6,0,0,0,20,1,2,3,0,0,0,1,depth/000001.png,color/000001.png,ok\n";
  for (std::size_t cut = 0; cut <= last.size(); ++cut) {
    const FrameTable t = parsed(table(first + last.substr(0, cut)));
    ASSERT_GE(t.rows.size(), 1u) << cut;
    EXPECT_EQ(t.rows[0].info.file, "depth/000000.png");
    // A second row appears only once its names are whole.
    if (t.rows.size() == 2) {
      EXPECT_EQ(t.rows[1].info.file, "depth/000001.png") << cut;
      EXPECT_EQ(t.rows[1].color_file, "color/000001.png") << cut;
    }
  }
}

TEST(FramesCsv, WholeLastLineWithoutItsEndIsTaken) {
  const FrameTable t = parsed(table("0,,0,0,0,,,,,,,,,a.png,,dropped"));
  ASSERT_EQ(t.rows.size(), 1u);
  EXPECT_EQ(t.rows[0].info.status, FrameStatus::kDropped);
  EXPECT_THAT(t.notes, IsEmpty());
}

TEST(FramesCsv, ZerosAtTheEndAreIgnoredWithANote) {
  const FrameTable t = parsed(table("0,,0,0,0,,,,,,,,,a.png,,ok\n") + std::string(4096, '\0'));
  EXPECT_EQ(t.rows.size(), 1u);
  EXPECT_THAT(t.notes, ElementsAre(HasSubstr("zeros")));
}

TEST(FramesCsv, TwoFramesWithOneIndexNameBothLines) {
  EXPECT_EQ(refusal(table("5,,,,,,,,,,,,,a.png,,ok\n6,,,,,,,,,,,,,b.png,,ok\n"
                          "5,,,,,,,,,,,,,c.png,,ok\n")),
            "lines 2 and 4 have the same index 5");
}

TEST(FramesCsv, FramesOutOfOrderAreSortedWithANote) {
  const FrameTable t = parsed(table("2,,,,,,,,,,,,,c.png,,ok\n0,,,,,,,,,,,,,a.png,,ok\n"));
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(t.rows[0].info.file, "a.png");
  EXPECT_EQ(t.rows[1].info.file, "c.png");
  EXPECT_THAT(t.notes, ElementsAre(HasSubstr("sorted")));
}

TEST(FramesCsv, NumbersThatAreNotFiniteNameTheirLine) {
  for (const std::string bad : {"nan", "inf", "-inf", "1e999", "0x10", "1,5", "12abc"}) {
    const std::string time =
        refusal(table("0,,,,,,,,,,,,,a.png,,ok\n1," + bad + ",,,,,,,,,,,,b.png,,ok\n"));
    EXPECT_THAT(time, HasSubstr("line 3: ")) << bad;
    const std::string pose = refusal(table("1,,,,,,0,0," + bad + ",0,0,0,1,b.png,,ok\n"));
    EXPECT_THAT(pose, HasSubstr("line 2: ")) << bad;
  }
}

TEST(FramesCsv, IncompletePoseIsAnError) {
  EXPECT_THAT(refusal(table("1,,,,,,0,0,0,0,0,0,,b.png,,ok\n")), HasSubstr("line 2: column qw"));
  EXPECT_THAT(refusal(table("1,,,,,,0,0,0,0,0,0,0,b.png,,ok\n")), HasSubstr("line 2: "));
}

TEST(FramesCsv, SensorThatDoesNotExistIsAnError) {
  EXPECT_THAT(refusal(table("1,,2,,,,,,,,,,,b.png,,ok\n"), 2),
              HasSubstr("line 2: sensor 2 does not exist"));
  EXPECT_EQ(parsed(table("1,,1,,,,,,,,,,,b.png,,ok\n"), 2).rows.size(), 1u);
}

TEST(FramesCsv, FilesOutsideTheFolderAreRefused) {
  for (const std::string name : {"/etc/passwd", "../a.png", "depth/../../a.png", ".."}) {
    EXPECT_THAT(refusal(table("1,,,,,,,,,,,,," + name + ",,ok\n")), HasSubstr("inside")) << name;
    EXPECT_THAT(refusal(table("1,,,,,,,,,,,,,a.png," + name + ",ok\n")), HasSubstr("inside"))
        << name;
  }
}

TEST(FramesCsv, UnknownStatusIsAnError) {
  EXPECT_THAT(refusal(table("1,,,,,,,,,,,,,a.png,,okay\n")), HasSubstr("okay"));
}

TEST(FramesCsv, HeaderMustNameIndexAndFile) {
  EXPECT_THAT(refusal("index,time_s\n1,2\n"), HasSubstr("'file'"));
  EXPECT_THAT(refusal("file,time_s\n1,2\n"), HasSubstr("'index'"));
  EXPECT_THAT(refusal("index,file,file\n1,a,b\n"), HasSubstr("twice"));
  EXPECT_FALSE(parse_frames_csv("", 1));
}

FrameInfo any_info() {
  const auto real = [](int scale) { return *rc::gen::inRange(-scale, scale) / 1000.0; };
  FrameInfo info;
  info.index = *rc::gen::inRange(0u, 2000000u);
  if (*rc::gen::arbitrary<bool>()) info.time_s = real(100000000);
  info.pass = *rc::gen::inRange(0u, 5u);
  info.turn = *rc::gen::inRange(0u, 5u);
  if (*rc::gen::arbitrary<bool>()) info.angle_rad = real(100000);
  if (*rc::gen::arbitrary<bool>()) {
    const auto pose = pose_from(Vec3d(real(3000), real(3000), real(3000)), real(1000), real(1000),
                                real(1000), 1.001 + real(1000));
    if (pose) info.T_table_sensor = *pose;
  }
  info.file = "depth/x.png";
  if (*rc::gen::arbitrary<bool>()) info.status = FrameStatus::kDropped;
  return info;
}

TEST(FramesCsv, WhatIsWrittenIsReadBack) {
  EXPECT_TRUE(rc::check([] {
    const FrameInfo info = any_info();
    const std::string line = frames_csv_line(info, "");
    const auto read = parse_frames_csv(table(line), 1);
    RC_ASSERT(read.has_value());
    const FrameInfo& back = read->rows.at(0).info;
    if (!info.T_table_sensor) RC_ASSERT(frames_csv_line(back, "") == line);
    RC_ASSERT(back.index == info.index && back.pass == info.pass && back.turn == info.turn);
    RC_ASSERT(back.status == info.status);
    RC_ASSERT((std::isnan(info.time_s) && std::isnan(back.time_s)) || back.time_s == info.time_s);
    RC_ASSERT(back.angle_rad.has_value() == info.angle_rad.has_value());
    if (info.angle_rad) RC_ASSERT(std::abs(*back.angle_rad - *info.angle_rad) < 1e-11);
    RC_ASSERT(back.T_table_sensor.has_value() == info.T_table_sensor.has_value());
    if (info.T_table_sensor)
      RC_ASSERT((back.T_table_sensor->matrix() - info.T_table_sensor->matrix()).norm() < 1e-10);
  }));
}

}  // namespace
}  // namespace turnscan::recording_format
