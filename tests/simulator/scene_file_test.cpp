#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/scene_file.hpp>

#include "tests/simulator/shapes.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

SceneDescription scene_of(const TempFolder& folder, const std::string& text) {
  SceneDescription scene;
  const auto read = read_scene(folder.put("scene.toml", text), scene);
  EXPECT_TRUE(read) << (read ? "" : read.error().text());
  return scene;
}

void expect_refused(const std::string& text, const std::string& says) {
  const TempFolder folder;
  SceneDescription scene;
  const auto read = read_scene(folder.put("scene.toml", text), scene);
  ASSERT_FALSE(read) << text;
  EXPECT_EQ(read.error().code, ErrorCode::kInvalidOption);
  EXPECT_NE(read.error().text().find(says), std::string::npos) << read.error().text();
}

TEST(SceneFile, SaysEverythingAtOnce) {
  const TempFolder folder;
  const SceneDescription scene = scene_of(folder, R"(
[object]
file = "figure.obj"
unit = "mm"
height = "250mm"
tip = "90deg"

[placement]
distance = "0.8m"
elevation = "30deg"

[[scanner]]
model = "kinect-v2"

[[scanner]]
model = "own/line.toml"
azimuth = "120deg"
elevation = "0deg"

[motion]
frames = 100
speed = "-10deg/s"

[table]
platter-radius = "200mm"
table-tilt = "1deg"

[room]
room = "wall"

[noise]
noise = "model"
seed = 7

[recording]
calibration = "none"
angles = false
)");
  EXPECT_EQ(scene.object, (folder / "figure.obj").string());
  EXPECT_EQ(scene.unit, "mm");
  EXPECT_EQ(scene.object_placement.height_m, 0.25);
  EXPECT_NEAR(scene.object_placement.tip_rad, 90 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(scene.placement.distance_m, 0.8);
  ASSERT_EQ(scene.scanners.size(), 2u);
  EXPECT_EQ(scene.scanners[0].model, "kinect-v2");
  EXPECT_EQ(scene.scanners[1].model, (folder / "own/line.toml").string());
  EXPECT_EQ(scene.motion.frames, 100);
  EXPECT_NEAR(*scene.motion.speed_rad_s, -10 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(scene.platter.radius_m, 0.2);
  EXPECT_NEAR(scene.table.tilt_rad, kRadiansPerDegree, 1e-12);
  EXPECT_EQ(scene.room.kind, RoomKind::kWall);
  EXPECT_EQ(scene.measure.noise, "model");
  EXPECT_EQ(scene.measure.seed, 7);
  EXPECT_EQ(scene.record.calibration, RecordedCalibration::kNone);
  EXPECT_FALSE(scene.record.angles);
}

TEST(SceneFile, ReadsWhatItWrites) {
  const TempFolder folder;
  const SceneDescription scene =
      scene_of(folder,
               "[object]\nfile = 'builtin:doll'\n[motion]\nripple = 0.01\n[[scanner]]\n"
               "model = 'ideal'\nroll = '90deg'\ntravel-along = 'across'\n[[scanner]]\n"
               "model = 'sub/own.toml'\n");
  const std::string text = scene_toml(scene);
  EXPECT_EQ(scene_toml(scene_of(folder, text)), text);
  EXPECT_NE(text.find("ripple = \"0.01\""), std::string::npos);
  EXPECT_NE(text.find("file = \"builtin:doll\""), std::string::npos);
}

TEST(SceneFile, ReadsNamesOfAnyCharactersThatItWrites) {
  SceneDescription scene;
  const std::string many(40, '[');
  for (const std::string& name :
       {std::string("/a\nb\r\t\x01\x7f.obj"), std::string("/back\\slash\\\"quote\".obj"),
        "/" + many + "\\" + many + ".obj", "/" + std::string(60, '.') + "/own.obj"}) {
    scene.object = name;
    SceneDescription again;
    const auto read = parse_scene(scene_toml(scene), "/scenes/one.toml", again);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(again.object, name);
  }
}

TEST(SceneFile, ReadsATextAsItReadsAFile) {
  SceneDescription scene;
  ASSERT_TRUE(parse_scene("[object]\nfile = 'own.obj'\n", "/scenes/one.toml", scene));
  EXPECT_EQ(scene.object, "/scenes/own.obj");
  const auto refused = parse_scene("\n[objects]\n", "/scenes/one.toml", scene);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text().find("one.toml:2: 'objects'"), std::string::npos);
  EXPECT_FALSE(parse_scene("[object\n", "/scenes/one.toml", scene));
}

TEST(SceneFile, WritesPathsThatHoldAnywhere) {
  SceneDescription scene;
  scene.object = "figure.obj";
  EXPECT_NE(scene_toml(scene).find((std::filesystem::current_path() / "figure.obj").string()),
            std::string::npos);
  EXPECT_NE(scene_toml(scene).find("[[scanner]]\nmodel = \"kinect-v2\""), std::string::npos);
}

TEST(SceneFile, NamesFileAndLineOfWhatItCannotUse) {
  expect_refused("[objects]\n", "scene.toml:1: 'objects' is none of the tables");
  expect_refused("[object]\nheigth = '1m'\n", "scene.toml:2: ");
  expect_refused("[object]\nfile = 3\n", "scene.toml:2: file");
  expect_refused("scanner = 'kinect-v2'\n", "scene.toml:1: scanners are tables");
  expect_refused("[[scanner]]\nazimuth = '1deg'\n", "needs its model");
  expect_refused("[[scanner]]\nmodel = 'ideal'\nazimuth = '1mm'\n", "scene.toml:3: azimuth");
  expect_refused("motion = 1\n", "scene.toml:1: ");
  expect_refused("[motion]\nframes = 0\n", "scene.toml:2: frames = 0");
}

TEST(ScannerEntry, HasItsOwnPlaceBehindCommas) {
  const auto entry = parse_scanner_entry("kinect-v2,azimuth=90deg,roll=-5deg");
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->model, "kinect-v2");
  ASSERT_EQ(entry->options.size(), 2u);
  EXPECT_EQ(entry->options[1].first, "roll");
  EXPECT_EQ(entry->options[1].second, "-5deg");
  EXPECT_TRUE(parse_scanner_entry("ideal")->options.empty());
}

TEST(ScannerEntry, HasValuesOfItsOwnForKeysOfItsFile) {
  SceneDescription scene;
  scene.scanners = {*parse_scanner_entry("kinect-v2,far=2m,lateral-length=2mm,pan=3deg")};
  const auto options = scan_options(scene);
  ASSERT_TRUE(options) << options.error().text();
  EXPECT_EQ(options->scanners[0].model.far_m, 2.0);
  EXPECT_EQ(options->scanners[0].model.near_m, 0.5);
  EXPECT_EQ(options->scanners[0].model.noise.lateral_m, 0.002);
  EXPECT_NEAR(options->scanners[0].placement.pan_rad, 3 * kRadiansPerDegree, 1e-12);
  SceneDescription again;
  ASSERT_TRUE(parse_scene(scene_toml(scene), "scene.toml", again));
  EXPECT_EQ(scene_toml(again), scene_toml(scene));
  scene.scanners = {*parse_scanner_entry("kinect-v2,near=5m")};
  EXPECT_NE(scan_options(scene).error().text().find("near = 5000mm"), std::string::npos);
}

TEST(ScannerEntry, RefusesWhatHasNoMeaning) {
  for (const char* text : {"", ",azimuth=90deg", "ideal,azimuth", "ideal,", "ideal,height=1m",
                           "ideal,azimuth=90", "ideal,azimuth="}) {
    const auto entry = parse_scanner_entry(text);
    ASSERT_FALSE(entry) << text;
    EXPECT_EQ(entry.error().code, ErrorCode::kInvalidOption);
  }
}

TEST(ScanOptions, GivesEachScannerTheCommonPlaceAndItsOwn) {
  SceneDescription scene;
  scene.placement.distance_m = 0.7;
  scene.placement.roll_rad = 0.1;
  scene.scanners = {*parse_scanner_entry("ideal"), *parse_scanner_entry("gocator,roll=90deg")};
  const auto options = scan_options(scene);
  ASSERT_TRUE(options) << options.error().text();
  EXPECT_EQ(options->scanners[0].placement.roll_rad, 0.1);
  EXPECT_NEAR(options->scanners[1].placement.roll_rad, 90 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(options->scanners[1].placement.distance_m, 0.7);
  EXPECT_EQ(options->scanners[1].model.kind, ScannerKind::kLine);
  scene.scanners.clear();
  EXPECT_EQ(scan_options(scene)->scanners.at(0).model.name, "kinect-v2");
  scene.scanners = {{"none", {}}};
  EXPECT_EQ(scan_options(scene).error().code, ErrorCode::kNotFound);
}

TEST(PassEntry, ChangesHowTheObjectLiesAndKeepsTheRest) {
  SceneDescription scene;
  scene.object_placement.height_m = 0.2;
  scene.object_placement.yaw_rad = 0.3;
  scene.next_passes = {*parse_pass_entry("tip=90deg"), *parse_pass_entry("lean=180deg,yaw=0deg")};
  const auto placements = pass_placements(scene);
  ASSERT_TRUE(placements) << placements.error().text();
  ASSERT_EQ(placements->size(), 3u);
  EXPECT_EQ((*placements)[0].tip_rad, 0.0);
  EXPECT_NEAR((*placements)[1].tip_rad, 90 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ((*placements)[1].yaw_rad, 0.3);
  EXPECT_EQ((*placements)[2].yaw_rad, 0.0);
  EXPECT_EQ((*placements)[2].height_m, 0.2);
  for (const char* text : {"", "tip", "tip=", "tip=90", "tip=90deg,", "azimuth=90deg"})
    EXPECT_FALSE(parse_pass_entry(text)) << text;
  scene.next_passes = {*parse_pass_entry("height=100mm")};
  EXPECT_EQ(pass_placements(scene).error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
