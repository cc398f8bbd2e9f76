#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {
namespace {

SequenceHeader header_with_table() {
  SequenceHeader header;
  header.sensors.resize(1);
  TurntableInfo table;
  table.axis = Vec3d(0, -1, -0.3).normalized();
  table.center_m = Vec3d(0, 0.1, 0.9);
  header.turntable = table;
  return header;
}

FrameInfo at_time(double t) {
  FrameInfo frame;
  frame.time_s = t;
  return frame;
}

TEST(Rotation, TakesAPointThatTurnsWithThePlatterBackToOnePlace) {
  const SequenceHeader header = header_with_table();
  const Pose sensor = *sensor_pose(header, 0);
  const Vec3d p_table(0.05, 0.1, 0.02);
  std::vector<FrameInfo> frames(8);
  for (int i = 0; i < 8; ++i) frames[std::size_t(i)].angle_rad = 0.7 * i;
  const auto poses = frame_poses(header, frames, std::nullopt);
  ASSERT_TRUE(poses);
  for (int i = 0; i < 8; ++i) {
    const Vec3d p_sensor = sensor.inverse() * (rotation_about_y(0.7 * i) * p_table);
    EXPECT_LT((poses->T_table_sensor[std::size_t(i)] * p_sensor - p_table).norm(), 1e-12);
  }
}

TEST(Rotation, APositiveAngleIsCounterClockwiseSeenFromAbove) {
  // From above (+Y towards the eye) with +Z to the right, +X is up on the page: counter-clockwise
  // takes +Z to +X.
  EXPECT_LT((rotation_about_y(std::numbers::pi / 2) * Vec3d::UnitZ() - Vec3d::UnitX()).norm(),
            1e-12);
}

TEST(Rotation, SpeedTimesTimeSinceTheFirstFrameIsTheAngle) {
  SequenceHeader header = header_with_table();
  header.turntable->speed_rad_s = 0.2;
  const auto poses = frame_poses(header, {at_time(3.0), at_time(8.0)}, std::nullopt);
  ASSERT_TRUE(poses);
  const Pose turned = rotation_about_y(-0.2 * 5.0) * *sensor_pose(header, 0);
  EXPECT_TRUE(poses->T_table_sensor[1].isApprox(turned));
  EXPECT_EQ(poses->source, PoseSource::kTimesAndSpeed);
}

TEST(Rotation, NoSpeedSpansTheGapBeforeARecordingWasResumed) {
  SequenceHeader header = header_with_table();
  header.turntable->speed_rad_s = 0.2;
  FrameInfo later = at_time(8.0);
  later.stretch = 1;
  for (const std::optional<double> stated : {std::optional<double>(), std::optional(0.2)})
    EXPECT_EQ(frame_poses(header, {at_time(3.0), later}, stated).error().code,
              ErrorCode::kMissingData);
  later.angle_rad = 1.0;
  EXPECT_TRUE(frame_poses(header, {at_time(3.0), later}, std::nullopt));
}

TEST(Rotation, AStatedSpeedGoesBeforeTheRecordedOne) {
  SequenceHeader header = header_with_table();
  header.turntable->speed_rad_s = 0.2;
  const auto poses = frame_poses(header, {at_time(0.0), at_time(1.0)}, 0.5);
  ASSERT_TRUE(poses);
  EXPECT_TRUE(poses->T_table_sensor[1].isApprox(rotation_about_y(-0.5) * *sensor_pose(header, 0)));
}

TEST(Rotation, AFramesOwnPoseGoesBeforeItsAngle) {
  const SequenceHeader header = header_with_table();
  FrameInfo frame;
  frame.angle_rad = 1.0;
  frame.T_table_sensor = rotation_about_y(0.25);
  const auto poses = frame_poses(header, {frame}, std::nullopt);
  ASSERT_TRUE(poses);
  EXPECT_TRUE(poses->T_table_sensor[0].isApprox(rotation_about_y(0.25)));
}

TEST(Rotation, TimesWithoutASpeedAreRefusedWithTheOptionThatHelps) {
  const auto poses = frame_poses(header_with_table(), {at_time(0.0)}, std::nullopt);
  ASSERT_FALSE(poses);
  EXPECT_EQ(poses.error().code, ErrorCode::kMissingData);
  EXPECT_NE(poses.error().message.find("--speed"), std::string::npos);
}

TEST(Rotation, AFrameWithoutTimeAngleAndPoseIsNamed) {
  FrameInfo frame;
  frame.index = 17;
  const auto poses = frame_poses(header_with_table(), {frame}, 0.2);
  ASSERT_FALSE(poses);
  EXPECT_NE(poses.error().message.find("17"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
