#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/recording/recording_json.hpp>

#include "tests/recording/sequences.hpp"

namespace turnscan::recording_format {
namespace {

using ::testing::HasSubstr;

RecordingDescription full_description() {
  RecordingDescription d;
  d.header = testing::small_header();
  SensorInfo& camera = d.header.sensors[0];
  camera.intrinsics.distortion = {0.1, -0.2, 0.001, -0.002, 0.03};
  camera.depth_unit_m = 0.001;
  camera.depth_bias_m = -0.0125;
  camera.T_table_sensor = rotation_about_y(0.3);
  camera.T_table_sensor->translation() = Vec3d(0.1, 0.2, 0.9);
  camera.color_intrinsics = testing::small_camera();
  camera.T_color_sensor.translation() = Vec3d(0.025, 0, 0);
  SensorInfo scanner = testing::scanner_header().sensors[0];
  scanner.viewpoint = {Vec3d(0, 0, 1), true};
  d.header.sensors.push_back(scanner);
  d.header.turntable =
      TurntableInfo{Vec3d(0, -1, 0), Vec3d(0.01, 0.2, 0.9), 0.15, 10.4478 / 180.0, 0.12};
  d.header.poses_within_pass = true;
  d.header.software = "turnscan 0.1.0";
  d.header.source = "somewhere\nfirst assumption\nsecond assumption";
  d.capture = {{"exposure_ms", "12.5"}, {"gain", "auto"}};
  d.complete = true;
  d.frame_count = 920;
  return d;
}

/// The text with one part replaced.
std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Error json_refusal(const std::string& text) {
  const auto result = parse_recording_json(text);
  EXPECT_FALSE(result);
  return result ? Error{} : result.error();
}

TEST(RecordingJson, WritesFiveCoefficientsOfALensOrTheEightOfARationalOne) {
  RecordingDescription d = full_description();
  EXPECT_THAT(recording_json(d), HasSubstr("\"distortion\": [0.1,-0.2,0.001,-0.002,0.03]"));
  auto& distortion = d.header.sensors[0].intrinsics.distortion;
  distortion = {0.5, -0.02, 0.0, 0.0, -0.003, 0.9, 0.1, -0.01};
  const std::string text = recording_json(d);
  EXPECT_THAT(text, HasSubstr("[0.5,-0.02,0.0,0.0,-0.003,0.9,0.1,-0.01]"));
  const auto back = parse_recording_json(text);
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(back->header.sensors[0].intrinsics.distortion, distortion);
  EXPECT_EQ(json_refusal(changed(text, ",0.9,", ",")).code, ErrorCode::kFormat);
}

TEST(RecordingJson, WhatIsWrittenIsReadBack) {
  const RecordingDescription d = full_description();
  const auto back = parse_recording_json(recording_json(d));
  ASSERT_TRUE(back) << back.error().text();
  ASSERT_EQ(back->header.sensors.size(), 2u);
  const SensorInfo& a = d.header.sensors[0];
  const SensorInfo& b = back->header.sensors[0];
  EXPECT_EQ(b.kind, SensorKind::kDepthCamera);
  EXPECT_EQ(b.model, a.model);
  EXPECT_EQ(b.intrinsics.width, a.intrinsics.width);
  EXPECT_EQ(b.intrinsics.fx, a.intrinsics.fx);
  EXPECT_EQ(b.intrinsics.distortion, a.intrinsics.distortion);
  EXPECT_EQ(b.depth_unit_m, a.depth_unit_m);
  EXPECT_EQ(b.depth_bias_m, a.depth_bias_m);
  ASSERT_TRUE(b.T_table_sensor);
  EXPECT_TRUE(b.T_table_sensor->isApprox(*a.T_table_sensor, 1e-14));
  ASSERT_TRUE(b.color_intrinsics);
  EXPECT_EQ(b.color_intrinsics->cx, a.color_intrinsics->cx);
  EXPECT_TRUE(b.T_color_sensor.isApprox(a.T_color_sensor, 1e-14));
  EXPECT_EQ(back->header.sensors[1].kind, SensorKind::kPointScanner);
  EXPECT_TRUE(back->header.sensors[1].viewpoint.parallel);
  EXPECT_EQ(back->header.sensors[1].viewpoint.value, Vec3d(0, 0, 1));
  ASSERT_TRUE(back->header.turntable);
  EXPECT_EQ(back->header.turntable->axis, d.header.turntable->axis);
  EXPECT_EQ(back->header.turntable->center_m, d.header.turntable->center_m);
  EXPECT_EQ(back->header.turntable->radius_m, d.header.turntable->radius_m);
  EXPECT_EQ(back->header.turntable->reach_m, d.header.turntable->reach_m);
  EXPECT_EQ(back->header.turntable->speed_rad_s, d.header.turntable->speed_rad_s);
  EXPECT_TRUE(back->header.poses_within_pass);
  EXPECT_EQ(back->header.software, d.header.software);
  EXPECT_EQ(back->header.source, d.header.source);
  EXPECT_EQ(back->capture, d.capture);
  EXPECT_TRUE(back->complete);
  EXPECT_EQ(back->frame_count, 920u);
}

TEST(RecordingJson, NewerSchemaIsRefusedAndSaysWhatToDo) {
  const Error error = json_refusal(changed(recording_json(full_description()),
                                           "\"schema_version\": 1", "\"schema_version\": 2"));
  EXPECT_EQ(error.code, ErrorCode::kUnsupported);
  EXPECT_THAT(error.message, HasSubstr("version 2"));
  EXPECT_THAT(error.message, HasSubstr("update turnscan"));
}

TEST(RecordingJson, UnknownFieldsAreIgnored) {
  const std::string text = changed(recording_json(full_description()), "\"sensors\": [\n    {",
                                   "\"mood\": {\"good\": true}, \"sensors\": [\n    {\"x\": 1,");
  EXPECT_TRUE(parse_recording_json(text));
}

TEST(RecordingJson, WrongFieldIsNamedWithItsPlace) {
  const std::string good = recording_json(full_description());
  EXPECT_THAT(json_refusal(changed(good, "\"fx\": 9.5", "\"fx\": \"wide\"")).message,
              HasSubstr("sensors[0].intrinsics.fx is not a number"));
  EXPECT_THAT(json_refusal(changed(good, "\"fx\": 9.5", "\"gx\": 9.5")).message,
              HasSubstr("sensors[0].intrinsics.fx is missing"));
  EXPECT_THAT(
      json_refusal(changed(good, "\"axis\": [0.0,-1.0,0.0]", "\"axis\": [0.0,-1.0]")).message,
      HasSubstr("turntable.axis has 2 numbers"));
  EXPECT_THAT(json_refusal(changed(good, "point-scanner", "oracle")).message, HasSubstr("oracle"));
}

TEST(RecordingJson, UnusableValuesAreRefused) {
  const std::string good = recording_json(full_description());
  for (const std::string bad : {"0.0", "-0.001", "2.0", "1e999", "null"}) {
    const std::string text = changed(good, "\"depth_unit_m\": 0.001", "\"depth_unit_m\": " + bad);
    EXPECT_EQ(json_refusal(text).code, ErrorCode::kFormat) << bad;
  }
  EXPECT_EQ(json_refusal(changed(good, "\"axis\": [0.0,-1.0,0.0]", "\"axis\": [0,0,0]")).code,
            ErrorCode::kFormat);
  EXPECT_EQ(json_refusal(changed(good, "\"radius_m\": 0.15", "\"radius_m\": -1")).code,
            ErrorCode::kFormat);
  EXPECT_EQ(json_refusal(changed(good, "\"reach_m\": 0.12", "\"reach_m\": 0")).code,
            ErrorCode::kFormat);
}

TEST(RecordingJson, WhatIsNoRecordingIsRefused) {
  for (const std::string text : {"", "{", "[]", "7", "{}", "{\"format\": \"other\"}",
                                 "{\"format\": \"turnscan recording\"}"})
    EXPECT_EQ(json_refusal(text).code, ErrorCode::kFormat) << text;
}

TEST(RecordingJson, DepthNestedBeyondReasonIsRefusedWithoutACrash) {
  EXPECT_EQ(json_refusal(std::string(1000000, '[')).code, ErrorCode::kFormat);
  EXPECT_EQ(json_refusal(std::string(500000, '[') + std::string(500000, ']')).code,
            ErrorCode::kFormat);
}

TEST(RecordingJson, TextThatIsNotUtf8IsWrittenAsReplacementCharacters) {
  RecordingDescription d = full_description();
  d.header.source = "caf\xE9";
  EXPECT_TRUE(parse_recording_json(recording_json(d)));
}

}  // namespace
}  // namespace turnscan::recording_format
