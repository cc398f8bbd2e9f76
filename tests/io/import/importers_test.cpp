// Recognition, options and the scan layouts; the depth image layouts have a file of their own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/import/foreign_data.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using testing::frame_of;
using ::testing::HasSubstr;
using testing::open;
using testing::put_scan;
using testing::refusal;
using testing::TempFolder;

constexpr double kDeg = std::numbers::pi / 180.0;

ImportOptions with(const std::vector<std::pair<std::string, std::string>>& values) {
  ImportOptions options;
  for (const auto& [name, value] : values) {
    const auto done = describe(options).set(name, value);
    EXPECT_TRUE(done) << done.error().text();
  }
  return options;
}

TEST(ImportOptions, DefaultsAreValidAndEveryFieldHasHelp) {
  ImportOptions options;
  EXPECT_TRUE(options.check());
  const OptionTable table = describe(options);
  for (const OptionField& field : table.fields()) {
    EXPECT_FALSE(field.help.empty()) << field.name;
    EXPECT_TRUE(field.set(field.get())) << field.name;
  }
}

TEST(ImportOptions, ValuesOutsideTheirRangeAreRefused) {
  ImportOptions options;
  options.depth_unit_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal("/", options).code, ErrorCode::kInvalidOption);
  options.depth_unit_m = 0.0;
  EXPECT_FALSE(options.check());
}

TEST(Import, PointsToTheLayoutsWhenItRecognisesNone) {
  const TempFolder folder;
  folder.put("notes.txt", "hello");
  const Error error = refusal(folder.path());
  EXPECT_EQ(error.code, ErrorCode::kUnsupported);
  EXPECT_THAT(error.message, HasSubstr("notes.txt"));
  EXPECT_THAT(error.message, HasSubstr("turnscan import --list"));
  EXPECT_EQ(refusal(folder / "notes.txt").code, ErrorCode::kUnsupported);
  EXPECT_EQ(refusal(folder / "nothing").code, ErrorCode::kNotFound);
}

TEST(Import, WhatCannotBeLookedAtIsNotMissing) {
  const TempFolder folder;
  fs::create_symlink("loop", folder / "loop");  // fails for the superuser, too
  EXPECT_EQ(refusal(folder / "loop").code, ErrorCode::kIo);
  folder.put("a.conf", "bmesh loop 0 0 0 0 0 0 1\n");
  EXPECT_EQ(refusal(folder.path()).code, ErrorCode::kIo);
  fs::create_directory(folder / "scans");
  folder.put("a.conf", "bmesh scans 0 0 0 0 0 0 1\n");
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("not a regular file"));
}

TEST(Import, ARecordingNeedsNoImport) {
  const TempFolder folder;
  folder.put("recording.json", "{}");
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("recording already"));
}

TEST(Import, OptionWithoutMeaningForTheLayoutIsRefused) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("a.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  const Error error = refusal(folder.path(), with({{"depth-unit", "1mm"}}));
  EXPECT_EQ(error.code, ErrorCode::kInvalidOption);
  EXPECT_THAT(error.message, HasSubstr("depth-unit has no meaning"));
}

TEST(Import, RadiusWithoutATurntableAsksForIt) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("a.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  EXPECT_THAT(refusal(folder.path(), with({{"turntable-radius", "100mm"}})).message,
              HasSubstr("turntable-axis"));
}

TEST(StanfordConf, PointsLieAtTheTransposedRotationPlusTranslation) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  put_scan(folder, "b.ply");
  // The quaternion is a turn by +90 degrees about z; its transpose turns by -90.
  folder.put("x.conf",
             "# comment\ncamera -0.0172 -0.0936 -0.734  -0.0461723 0.970603 -0.235889 0.0124573\n"
             "bmesh a.ply 0 0 0 0 0 0 1\r\n"
             "mesh b.ply 10 20 30 0 0 0.70710678118654752 0.70710678118654752\n");
  const auto sequence = open(folder / "x.conf");
  ASSERT_EQ(sequence->frames().size(), 2u);
  EXPECT_EQ(sequence->frames()[1].index, 1u);
  EXPECT_EQ(sequence->frames()[1].file, "b.ply");
  const Vec3d p = *sequence->frames()[1].T_table_sensor * Vec3d(1, 2, 3);
  EXPECT_LT((p - Vec3d(12, 19, 33)).norm(), 1e-12);
}

TEST(StanfordConf, KeepsGridAndColourAndSaysWhatItAssumes) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("x.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  const auto sequence = open(folder.path());
  const Frame frame = frame_of(*sequence, 0);
  EXPECT_EQ(frame.grid, (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(frame.points.colors.size(), 2u);
  const SensorInfo& scanner = sequence->header().sensors[0];
  EXPECT_EQ(scanner.kind, SensorKind::kPointScanner);
  EXPECT_TRUE(scanner.viewpoint.parallel);
  EXPECT_EQ(scanner.viewpoint.value, Vec3d(0, 0, 1));
  EXPECT_THAT(sequence->header().source, HasSubstr("metres"));
  EXPECT_THAT(sequence->header().source, HasSubstr("parallel"));
}

TEST(StanfordConf, UnitAndViewpointCanBeStated) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("x.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  const auto sequence =
      open(folder.path(), with({{"point-unit", "mm"}, {"sensor-position", "0m,10cm,900mm"}}));
  EXPECT_FLOAT_EQ(frame_of(*sequence, 0).points.points[0].z(), 0.003f);
  const Viewpoint& viewpoint = sequence->header().sensors[0].viewpoint;
  EXPECT_FALSE(viewpoint.parallel);
  EXPECT_LT((viewpoint.value - Vec3d(0, 0.1, 0.9)).norm(), 1e-12);
}

TEST(StanfordConf, WrongLinesAreNamed) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  const auto message = [&](const std::string& line) {
    folder.put("x.conf", "bmesh a.ply 0 0 0 0 0 0 1\n" + line + "\n");
    return refusal(folder / "x.conf").text();
  };
  EXPECT_THAT(message("bmesh a.ply 0 0 0 0 0 0"), HasSubstr("line 2: there are 8 words"));
  EXPECT_THAT(message("bmesh a.ply 0 0 0 0 0 0 0"), HasSubstr("line 2: pose"));
  EXPECT_THAT(message("bmesh a.ply nan 0 0 0 0 0 1"), HasSubstr("line 2: 'nan'"));
  EXPECT_THAT(message("bmesh b.ply 0 0 0 0 0 0 1"), HasSubstr("no such file"));
  EXPECT_THAT(message("bmesh ../a.ply 0 0 0 0 0 0 1"), HasSubstr("inside"));
  EXPECT_THAT(message("wmesh a.ply 0 0 0 0 0 0 1"), HasSubstr("'wmesh'"));
}

TEST(StanfordConf, TwoConfFilesAskWhichOne) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("x.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  folder.put("y.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  EXPECT_THAT(refusal(folder.path()).message, HasSubstr("several"));
  EXPECT_TRUE(open_foreign(folder / "y.conf", {}));
}

TEST(StanfordConf, WorldUpBecomesY) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("x.conf", "bmesh a.ply 0 0 1 0 0 0 1\n");
  const auto sequence = open(folder.path(), with({{"world-up", "0,0,2"}}));
  EXPECT_LT((*sequence->frames()[0].T_table_sensor * Vec3d::Zero() - Vec3d(0, 1, 0)).norm(), 1e-12);
}

TEST(CloudFolder, TakesTheListedFilesWithTheirAngles) {
  const TempFolder folder;
  for (const char* name : {"a.ply", "b.ply", "c.ply", "unlisted.ply"}) put_scan(folder, name);
  folder.put("angles.csv",
             "\xEF\xBB\xBF"
             "file, angle_deg ,operator\r\nc.ply,90,me\r\n\"a.ply\",0,you\r\n"
             "b.ply,45,\r\n");
  const auto sequence = open(folder.path(), with({{"point-unit", "cm"}}));
  ASSERT_EQ(sequence->frames().size(), 3u);
  EXPECT_EQ(sequence->frames()[0].file, "a.ply");
  EXPECT_EQ(sequence->frames()[2].file, "c.ply");
  EXPECT_NEAR(*sequence->frames()[1].angle_rad, 45 * kDeg, 1e-15);
  const Frame frame = frame_of(*sequence, 0);
  EXPECT_FLOAT_EQ(frame.points.points[0].y(), 0.02f);
  EXPECT_EQ(frame.grid.size(), 2u);
  EXPECT_FALSE(sequence->header().turntable);
  EXPECT_THAT(sequence->header().source, HasSubstr("origin of the scans' frame"));
}

TEST(CloudFolder, ClockwiseAnglesChangeTheirSign) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  put_scan(folder, "b.ply");
  folder.put("t.csv", "file,angle_deg\na.ply,0\nb.ply,30\n");
  const auto sequence = open(
      folder.path(),
      with({{"angles", (folder / "t.csv").string()}, {"point-unit", "m"}, {"clockwise", "true"}}));
  EXPECT_NEAR(*sequence->frames()[1].angle_rad, -30 * kDeg, 1e-15);
}

TEST(CloudFolder, TablesOfSpreadsheetsAreRead) {
  using namespace std::string_literals;
  const std::string excel =
      "\xEF\xBB\xBF"
      "file;angle_deg\r\na.ply;0,0\r\nb.ply;30,5\r\n";
  std::string utf16 = "\xFF\xFE";
  for (const char c : "File\tAngle [deg]\r\na.ply\t0\r\nb.ply\t30,5\r\n"s) utf16 += {c, '\0'};
  for (const std::string& table : {excel, utf16, "File, Angle\na.ply,0\nb.ply,30.5\n"s,
                                   "file,angle (\xC2\xB0)\na.ply,0\nb.ply,\"30,5\"\n"s,
                                   "FILE,ANGLE_RAD\na.ply,0\nb.ply,0.5323254218582705\n"s}) {
    const TempFolder folder;
    for (const char* name : {"a.ply", "b.ply"}) put_scan(folder, name);
    folder.put("angles.csv", table);
    const auto sequence = open_foreign(folder.path(), with({{"point-unit", "m"}}));
    ASSERT_TRUE(sequence) << sequence.error().text();
    ASSERT_EQ((*sequence)->frames().size(), 2u);
    EXPECT_NEAR(*(*sequence)->frames()[1].angle_rad, 30.5 * std::numbers::pi / 180.0, 1e-9);
  }
}

TEST(CloudFolder, UnknownNamesOfColumnsAreToldTheKnownOnes) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("angles.csv", "Datei;Winkel [\xC2\xB0]\na.ply;0\n");
  const auto sequence = open_foreign(folder.path(), with({{"point-unit", "m"}}));
  ASSERT_FALSE(sequence);
  EXPECT_THAT(sequence.error().text(),
              HasSubstr("names Datei, Winkel [\xC2\xB0]; known are file and angle_deg"));
  folder.put("angles.csv", "file,angle [grad]\na.ply,0\n");
  EXPECT_THAT(open_foreign(folder.path(), with({{"point-unit", "m"}})).error().text(),
              HasSubstr("unknown unit; known are deg, rad"));
}

TEST(CloudFolder, StatedAxesAreTurnedToTheSensorsFrame) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("angles.csv", "file,angle_deg\na.ply,0\n");
  const auto plain = open_foreign(folder.path(), with({{"point-unit", "mm"}}));
  const auto unity = open_foreign(folder.path(), with({{"point-unit", "mm"},
                                                       {"axes", "RUF"},
                                                       {"sensor-position", "1m,2m,3m"},
                                                       {"turntable-axis", "0,1,0"},
                                                       {"turntable-center", "0m,-1m,2m"}}));
  ASSERT_TRUE(plain && unity);
  const Vec3f a = (*plain)->read(0)->points.points[0], b = (*unity)->read(0)->points.points[0];
  EXPECT_EQ(b, Vec3f(a.x(), -a.y(), a.z()));
  const SequenceHeader& header = (*unity)->header();
  EXPECT_EQ(header.sensors[0].viewpoint.value, Vec3d(1.0, -2.0, 3.0));
  EXPECT_EQ(header.turntable->axis, Vec3d(0.0, -1.0, 0.0));
  EXPECT_EQ(header.turntable->center_m, Vec3d(0.0, 1.0, 2.0));
  for (const char* wrong : {"ru", "ruu", "rux", "rudf"})
    EXPECT_THAT(
        open_foreign(folder.path(), with({{"point-unit", "mm"}, {"axes", wrong}})).error().text(),
        HasSubstr("where x, y and z point"));
}

TEST(CloudFolder, TextScansWithPosesLieWhereTheySay) {
  const TempFolder folder;
  folder.put("a.xyz", "x y z\n1 2 3\n");
  folder.put("b.xyz", "x y z\n1 2 3\n");
  folder.put("angles.csv", "file,tx,ty,tz,qx,qy,qz,qw\na.xyz,0,0,0,0,0,0,1\nb.xyz,5,0,0,0,0,1,0\n");
  // The points lie in the world as the table says, whatever the axes of the scans are called.
  for (const char* axes : {"", "rub", "flu"}) {
    const auto sequence = open(folder.path(), with({{"point-unit", "m"}, {"axes", axes}}));
    ASSERT_EQ(sequence->frames().size(), 2u);
    const Frame frame = frame_of(*sequence, 1);
    ASSERT_TRUE(frame.info.T_table_sensor);
    EXPECT_LT((*frame.info.T_table_sensor * frame.points.points[0].cast<double>() - Vec3d(4, -2, 3))
                  .norm(),
              1e-6)
        << axes;
  }
  EXPECT_THAT(refusal(folder.path(), with({{"point-unit", "m"}, {"axes", "ruf"}})).text(),
              HasSubstr("left-handed"));
}

TEST(CloudFolder, TimesPassesAndSensorsAreKept) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  put_scan(folder, "b.ply");
  folder.put("angles.csv", "file,time_s,pass,sensor\na.ply,1.5,1,2\nb.ply,3.5,0,\n");
  const auto sequence = open(folder.path(), with({{"point-unit", "m"},
                                                  {"turntable-axis", "0,-2,0"},
                                                  {"turntable-center", "0mm,100mm,900mm"},
                                                  {"turntable-radius", "15cm"},
                                                  {"platter-height", "10mm"},
                                                  {"speed", "10deg/s"},
                                                  {"clockwise", "true"},
                                                  {"sensor-direction", "0,0,-1"}}));
  ASSERT_EQ(sequence->header().sensors.size(), 3u);
  EXPECT_TRUE(sequence->header().sensors[2].viewpoint.parallel);
  const FrameInfo& first = sequence->frames()[0];  // of pass 0
  EXPECT_EQ(first.file, "b.ply");
  EXPECT_EQ(first.time_s, 3.5);
  EXPECT_FALSE(first.angle_rad);
  EXPECT_EQ(sequence->frames()[1].pass, 1u);
  EXPECT_EQ(sequence->frames()[1].sensor, 2u);
  const TurntableInfo& table = *sequence->header().turntable;
  EXPECT_EQ(table.axis, Vec3d(0, -1, 0));
  EXPECT_LT((table.center_m - Vec3d(0, 0.09, 0.9)).norm(), 1e-12);
  EXPECT_NEAR(*table.radius_m, 0.15, 1e-12);
  EXPECT_NEAR(*table.speed_rad_s, -10 * kDeg, 1e-12);
}

TEST(CloudFolder, UnitMustBeStated) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("angles.csv", "file,angle_deg\na.ply,0\n");
  const Error error = refusal(folder.path());
  EXPECT_EQ(error.code, ErrorCode::kMissingData);
  EXPECT_THAT(error.message, HasSubstr("--point-unit"));
}

TEST(CloudFolder, WithoutATableItAsksForOne) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  const Error error = refusal(folder.path());
  EXPECT_EQ(error.code, ErrorCode::kMissingData);
  EXPECT_THAT(error.message, HasSubstr("--angles"));
}

TEST(CloudFolder, WrongTablesAreNamed) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  const auto message = [&](const std::string& table) {
    folder.put("angles.csv", table);
    return refusal(folder.path(), with({{"point-unit", "m"}})).text();
  };
  EXPECT_THAT(message("file,angle_deg\na.ply,0\nb.ply,1\n"), HasSubstr("no such file"));
  EXPECT_THAT(message("a.ply,0\n"), HasSubstr("must name the columns"));
  EXPECT_THAT(message("file,angel\na.ply,0\n"), HasSubstr("must name the columns"));
  EXPECT_THAT(message("file,angle_deg\n"), HasSubstr("no scans"));
  EXPECT_THAT(message(""), HasSubstr("empty"));
  EXPECT_THAT(message("file,angle_deg\na.ply,1 deg\n"), HasSubstr("line 2: column angle_deg"));
  EXPECT_THAT(message("file,angle_deg\na.ply,inf\n"), HasSubstr("line 2: column angle_deg"));
  EXPECT_THAT(message("file,angle_deg\na.ply,\n"), HasSubstr("line 2: there is neither"));
  EXPECT_THAT(message("file,angle_deg\na.ply\n"), HasSubstr("line 2: there are 1 fields"));
  EXPECT_THAT(message("file,angle_deg,sensor\na.ply,0,64\n"), HasSubstr("line 2: column sensor"));
  EXPECT_THAT(message("file,angle_deg\n../a.ply,0\n"), HasSubstr("inside"));
}

TEST(CloudFolder, DamagedScanIsAnErrorWhenItIsRead) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  put_scan(folder, "b.ply");
  fs::resize_file(folder / "b.ply", 200);
  folder.put("angles.csv", "file,angle_deg\na.ply,0\nb.ply,1\n");
  const auto sequence = open(folder.path(), with({{"point-unit", "m"}}));
  EXPECT_TRUE(sequence->read(0));
  EXPECT_FALSE(sequence->read(1));
  EXPECT_THROW((void)sequence->read(2), std::invalid_argument);
}

TEST(Passes, OfSeveralDataSetsAreCountedThrough) {
  const TempFolder first, second;
  for (const TempFolder* folder : {&first, &second}) put_scan(*folder, "a.ply");
  put_scan(first, "b.ply");
  first.put("angles.csv", "file,angle_deg,pass\na.ply,0,3\nb.ply,5,7\n");
  second.put("angles.csv", "file,angle_deg\na.ply,20\n");
  const auto sequence =
      open_foreign_passes({first.path(), second.path()}, with({{"point-unit", "m"}}));
  ASSERT_TRUE(sequence) << sequence.error().text();
  const auto& frames = (*sequence)->frames();
  ASSERT_EQ(frames.size(), 3u);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[i].index, i);
    EXPECT_EQ(frames[i].pass, i);
  }
  EXPECT_NEAR(*frames[2].angle_rad, 20 * kDeg, 1e-15);
  EXPECT_EQ(frame_of(**sequence, 2).info.pass, 2u);
  EXPECT_EQ(frame_of(**sequence, 2).points.size(), 2u);
  EXPECT_FALSE((*sequence)->header().poses_within_pass);
}

TEST(Passes, PosesOfSeveralDataSetsHoldWithinTheirPass) {
  const TempFolder folder;
  put_scan(folder, "a.ply");
  folder.put("x.conf", "bmesh a.ply 0 0 0 0 0 0 1\n");
  folder.put("y.conf", "bmesh a.ply 0 0 1 0 0 0 1\n");
  const auto both = open_foreign_passes({folder / "x.conf", folder / "y.conf"}, {});
  ASSERT_TRUE(both) << both.error().text();
  EXPECT_TRUE((*both)->header().poses_within_pass);
  EXPECT_FALSE((*open_foreign_passes({folder / "x.conf"}, {}))->header().poses_within_pass);
}

TEST(Passes, OfDifferentSensorsBecomeRecordingsOfTheirOwn) {
  const TempFolder first, second;
  for (const TempFolder* folder : {&first, &second}) {
    put_scan(*folder, "a.ply");
    folder->put("angles.csv", "file,angle_deg\na.ply,0\n");
  }
  second.put("a.pcd",
             "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
             "VIEWPOINT 0 0 1 1 0 0 0\nPOINTS 1\nDATA ascii\n1 2 3\n");
  second.put("angles.csv", "file,angle_deg\na.pcd,0\n");
  const auto both = open_foreign_passes({first.path(), second.path()}, with({{"point-unit", "m"}}));
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().code, ErrorCode::kInvalidOption);
  EXPECT_THAT(both.error().message, HasSubstr("recording of its own"));
}

}  // namespace
}  // namespace turnscan
