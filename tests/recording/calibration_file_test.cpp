#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/recording/calibration_file.hpp>

#include "tests/recording/sequences.hpp"

namespace turnscan {
namespace {

Calibration some_calibration(std::uint64_t seed) {
  const auto random = [&](std::uint64_t k) { return uniform01(hash_key(seed, k)); };
  Calibration c;
  c.method = CalibrationMethod::kMotion;
  c.table.axis = Vec3d(random(0), -random(1) - 1, -random(2)).normalized();
  c.table.center_m = Vec3d(random(3), random(4), random(5));
  c.table.radius_m = 0.1 + random(6);
  c.table.reach_m = 0.1 + random(20);
  c.table.speed_rad_s = random(7) - 0.5;
  c.axis_sigma_rad = random(8) * 1e-3;
  c.center_sigma_m = random(9) * 1e-3;
  c.axis_found = "a \"quoted\" reason";
  for (std::uint64_t i = 0; i < 50; ++i) {
    c.angles_rad.push_back(7.0 * random(100 + i));
    c.angle_sigma_rad.push_back(i == 3 ? std::nan("") : 1e-3 * random(200 + i));
  }
  c.start_s = random(10);
  c.undetermined = {"speed"};
  c.notes = {"one", "two"};
  CameraCorrection camera;
  camera.intrinsics.width = 512, camera.intrinsics.height = 424;
  camera.intrinsics.fx = 360.0 + random(12), camera.intrinsics.fy = 361.0;
  camera.intrinsics.distortion = {0.1 * random(13), -0.2, 1e-3, 0.0, 0.3};
  if (seed % 2 == 0) {
    camera.color_intrinsics = camera.intrinsics;
    camera.T_color_sensor.translation() = Vec3d(-0.052, 0.01 * random(14), 0.0);
  }
  camera.found = "somebody";
  c.camera = camera;
  for (std::uint64_t i = 0; i < seed % 3; ++i) {
    SensorPlace place;
    place.T_table_sensor.linear() =
        Eigen::AngleAxisd(random(15 + i), Vec3d::UnitY()).toRotationMatrix();
    place.T_table_sensor.translation() = Vec3d(random(17), random(18), random(19));
    place.heading_sigma_rad = i == 0 ? 1e-3 * random(20) : std::nan("");
    place.shift_sigma_m = 1e-4;
    place.found = "the object";
    if (i == 0) {
      place.depth = DepthCorrection{0.01 * random(21), 0.99, 2e-4, 1e-3, "ball"};
    } else {
      place.camera.emplace();
      place.camera->intrinsics = testing::small_header().sensors[0].intrinsics;
      place.camera->intrinsics.fx += random(22);
    }
    c.others.push_back(place);
  }
  if (seed % 2 == 1) c.made_at = "2026-11-24T08:30:00Z";
  c.depth = DepthCorrection{-0.02 * random(11), 1.01, 1e-4, std::nan(""), "gauge"};
  return c;
}

TEST(CalibrationFile, RefusesADateThatIsNone) {
  std::string text = calibration_json(some_calibration(1));
  text.replace(text.find("2026-11-24T08"), 13, "2026-11-31T08");
  const auto read = parse_calibration(text);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kFormat);
}

TEST(CalibrationFile, ReadAndWrittenAgainIsTheSameText) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::string first = calibration_json(some_calibration(seed));
    const auto read = parse_calibration(first);
    ASSERT_TRUE(read) << read.error().text();
    const std::string second = calibration_json(*read);
    EXPECT_EQ(second, first);
    // What came from a file goes back to the last bit.
    const auto again = parse_calibration(second);
    EXPECT_EQ(again->table.axis, read->table.axis);
    EXPECT_EQ(again->angles_rad, read->angles_rad);
    EXPECT_EQ(again->made_at, some_calibration(seed).made_at);
    EXPECT_EQ(again->table.speed_rad_s, read->table.speed_rad_s);
  }
}

TEST(CalibrationFile, KeepsLengthsExactlyAndAnglesToARounding) {
  const Calibration c = some_calibration(5);
  const auto read = parse_calibration(calibration_json(c));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->table.axis, c.table.axis);
  EXPECT_EQ(read->table.center_m, c.table.center_m);
  EXPECT_EQ(read->table.radius_m, c.table.radius_m);
  EXPECT_EQ(read->table.reach_m, c.table.reach_m);
  EXPECT_EQ(read->start_s, c.start_s);
  EXPECT_EQ(read->notes, c.notes);
  EXPECT_EQ(read->depth->bias_m, c.depth->bias_m);
  EXPECT_TRUE(std::isnan(read->angle_sigma_rad[3]));
  for (std::size_t i = 0; i < c.angles_rad.size(); ++i)
    EXPECT_NEAR(read->angles_rad[i], c.angles_rad[i], 1e-15 * 8);
}

TEST(CalibrationFile, TakesTheTurntableOfARecording) {
  const char* text = R"({"turntable": {"axis": [0, -2, 0], "center_m": [0, 0, 1],
                         "speed_rad_s": 0.5}})";
  const auto read = parse_calibration(text);
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->table.axis, Vec3d(0, -1, 0));
  EXPECT_EQ(read->table.speed_rad_s, 0.5);
}

TEST(CalibrationFile, WithWrongFieldsIsRefused) {
  const std::string good = calibration_json(some_calibration(1));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  EXPECT_TRUE(parse_calibration(good));
  EXPECT_FALSE(parse_calibration(""));
  EXPECT_FALSE(parse_calibration("[]"));
  EXPECT_FALSE(parse_calibration(good.substr(0, good.size() / 2)));
  EXPECT_EQ(parse_calibration(with("\"schema_version\": 1", "\"schema_version\": 9")).error().code,
            ErrorCode::kUnsupported);
  EXPECT_FALSE(parse_calibration(with("\"motion\"", "\"magic\"")));
  EXPECT_FALSE(parse_calibration(with("\"radius_m\": ", "\"radius_m\": -")));
  EXPECT_FALSE(parse_calibration(with("\"reach_m\": ", "\"reach_m\": -")));
  EXPECT_FALSE(parse_calibration(with("\"angles_deg\": [", "\"angles_deg\": [null, ")));
  EXPECT_FALSE(parse_calibration(with("\"angles_deg\": [", "\"angles_deg\": [1, ")));
  EXPECT_FALSE(parse_calibration(with("\"axis\"", "\"axes\"")));
  EXPECT_FALSE(parse_calibration(with("\"scale\": 1.01", "\"scale\": 0")));
}

TEST(WithCalibration, ReplacesTurntableAnglesAndDepthAndLeavesTheFramesAlone) {
  SequenceHeader header = testing::small_header();
  header.sensors[0].T_table_sensor = Pose::Identity();
  std::vector<Frame> frames;
  for (std::uint32_t i = 0; i < 50; ++i) {
    frames.push_back(testing::depth_frame(i));
    frames.back().info.T_table_sensor = Pose::Identity();
  }
  const testing::CountingFrames sequence(header, frames);
  Calibration c = some_calibration(2);
  c.camera->intrinsics.width = header.sensors[0].intrinsics.width;
  c.camera->intrinsics.height = header.sensors[0].intrinsics.height;
  c.others.clear();
  const auto seen = with_calibration(sequence, c);
  ASSERT_TRUE(seen) << seen.error().text();
  EXPECT_EQ((*seen)->header().sensors[0].intrinsics.fx, c.camera->intrinsics.fx);
  EXPECT_EQ((*seen)->header().sensors[0].intrinsics.distortion, c.camera->intrinsics.distortion);
  EXPECT_FALSE((*seen)->header().sensors[0].T_table_sensor);
  EXPECT_NEAR((*seen)->header().sensors[0].depth_unit_m, 1.01e-4, 1e-12);
  EXPECT_EQ((*seen)->frames()[7].angle_rad, c.angles_rad[7]);
  EXPECT_FALSE((*seen)->frames()[7].T_table_sensor);
  EXPECT_EQ((*seen)->read(7)->info.angle_rad, c.angles_rad[7]);
  EXPECT_TRUE(sequence.frames()[7].T_table_sensor);
  Calibration wrong = c;
  wrong.angles_rad.pop_back();
  EXPECT_EQ(with_calibration(sequence, wrong).error().code, ErrorCode::kInvalidOption);
  wrong = c;
  wrong.camera->intrinsics.width += 1;
  EXPECT_EQ(with_calibration(sequence, wrong).error().code, ErrorCode::kInvalidOption);
  wrong = c;
  wrong.others.resize(1);
  EXPECT_EQ(with_calibration(sequence, wrong).error().code, ErrorCode::kInvalidOption);
}

TEST(WithCalibration, PlacesTheOtherSensors) {
  SequenceHeader header = testing::small_header();
  header.sensors.push_back(header.sensors[0]);
  const testing::CountingFrames sequence(header, {testing::depth_frame(0)});
  Calibration c;
  c.table.center_m = Vec3d(0, 0, 1);
  c.others.resize(1);
  c.others[0].T_table_sensor.translation() = Vec3d(1, 2, 3);
  const auto seen = with_calibration(sequence, c);
  ASSERT_TRUE(seen) << seen.error().text();
  EXPECT_EQ((*seen)->header().sensors[1].T_table_sensor->translation(), Vec3d(1, 2, 3));
}

TEST(CorrectSensors, EachSensorGetsItsOwnDepthAndCamera) {
  SequenceHeader header = testing::small_header();
  header.sensors.push_back(header.sensors[0]);
  header.sensors.push_back(header.sensors[0]);
  const testing::CountingFrames sequence(header, {testing::depth_frame(0)});
  Calibration c;
  c.table.center_m = Vec3d(0, 0, 1);
  c.others.resize(1);
  c.depth.emplace().bias_m = 0.01;
  c.others[0].depth.emplace().bias_m = -0.02;
  c.others[0].depth->scale = 1.5;
  c.others[0].camera.emplace();
  c.others[0].camera->intrinsics = header.sensors[1].intrinsics;
  c.others[0].camera->intrinsics.fx = 99.0;
  const auto seen = with_calibration(sequence, c);
  ASSERT_TRUE(seen) << seen.error().text();
  const auto& sensors = (*seen)->header().sensors;
  EXPECT_EQ(sensors[0].depth_bias_m, 0.01);
  EXPECT_EQ(sensors[0].intrinsics.fx, header.sensors[0].intrinsics.fx);
  EXPECT_EQ(sensors[1].depth_bias_m, -0.02);
  EXPECT_EQ(sensors[1].depth_unit_m, 1.5 * header.sensors[1].depth_unit_m);
  EXPECT_EQ(sensors[1].intrinsics.fx, 99.0);
  EXPECT_EQ(sensors[2].depth_bias_m, header.sensors[2].depth_bias_m);
}

TEST(CorrectSensors, ACameraOfAnotherSizeIsRefusedByItsSensorAndChangesNone) {
  std::vector<SensorInfo> sensors(2, testing::small_header().sensors[0]);
  const double bias_m = sensors[0].depth_bias_m;
  Calibration c;
  c.depth.emplace().bias_m = bias_m + 0.01;
  c.others.resize(1);
  c.others[0].camera.emplace();
  c.others[0].camera->intrinsics = sensors[1].intrinsics;
  c.others[0].camera->intrinsics.width += 1;
  const auto done = correct_sensors(c, sensors);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(done.error().message.find("sensor 1: "), 0u) << done.error().message;
  EXPECT_EQ(sensors[0].depth_bias_m, bias_m);
}

TEST(CorrectSensors, TakesColourOnlyForImagesOfItsSizeThatAreNotRegistered) {
  Calibration c;
  c.camera.emplace();
  SensorInfo registered = testing::small_header().sensors[0];
  c.camera->intrinsics = registered.intrinsics;
  c.camera->color_intrinsics = registered.intrinsics;
  c.camera->color_intrinsics->fx = 77.0;
  registered.color_intrinsics.reset();
  SensorInfo own = registered, other = registered;
  own.color_intrinsics = registered.intrinsics;
  other.color_intrinsics = registered.intrinsics;
  other.color_intrinsics->width += 1;
  for (SensorInfo* sensor : {&registered, &own, &other}) {
    std::vector<SensorInfo> one{*sensor};
    ASSERT_TRUE(correct_sensors(c, one));
    *sensor = one[0];
  }
  EXPECT_FALSE(registered.color_intrinsics);
  EXPECT_EQ(own.color_intrinsics->fx, 77.0);
  EXPECT_NE(other.color_intrinsics->fx, 77.0);
}

}  // namespace
}  // namespace turnscan
