#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {
namespace {

TurntableInfo tilted_table() {
  TurntableInfo table;
  table.axis = Vec3d(0.05, -0.9, -0.4).normalized();
  table.center_m = Vec3d(0.02, 0.1, 0.9);
  return table;
}

TEST(TableFrame, TakesTheCentreToTheOrigin) {
  const auto pose = table_from_sensor(tilted_table());
  ASSERT_TRUE(pose);
  EXPECT_LT((*pose * tilted_table().center_m).norm(), 1e-12);
}

TEST(TableFrame, TakesTheAxisToPlusY) {
  const auto pose = table_from_sensor(tilted_table());
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->linear() * tilted_table().axis - Vec3d::UnitY()).norm(), 1e-12);
}

TEST(TableFrame, IsARightHandedRotation) {
  const auto pose = table_from_sensor(tilted_table());
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->linear().determinant(), 1.0, 1e-12);
}

TEST(TableFrame, PutsTheSensorOnTheSideOfMinusZ) {
  // X = RA x O and Z = X x Y: the sensor, at the origin of its own frame, has x = 0 and z < 0.
  const auto pose = table_from_sensor(tilted_table());
  ASSERT_TRUE(pose);
  const Vec3d sensor = pose->translation();
  EXPECT_NEAR(sensor.x(), 0.0, 1e-12);
  EXPECT_LT(sensor.z(), 0.0);
}

TEST(TableFrame, StillExistsWhenTheSensorLooksDownTheAxis) {
  TurntableInfo table;
  table.axis = -Vec3d::UnitZ();
  table.center_m = Vec3d(0, 0, 0.9);
  const auto pose = table_from_sensor(table);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->linear().determinant(), 1.0, 1e-12);
  EXPECT_LT((*pose * table.center_m).norm(), 1e-12);
  EXPECT_NEAR((*pose * Vec3d(0, 0, 0)).y(), 0.9, 1e-12);
}

TEST(TableFrame, RefusesAnAxisWithoutLengthAndValuesThatAreNotFinite) {
  TurntableInfo table = tilted_table();
  table.axis.setZero();
  EXPECT_EQ(table_from_sensor(table).error().code, ErrorCode::kFormat);
  table = tilted_table();
  table.center_m.x() = std::nan("");
  EXPECT_EQ(table_from_sensor(table).error().code, ErrorCode::kFormat);
}

TEST(SensorPose, PrefersTheSensorsOwnPose) {
  SequenceHeader header;
  header.sensors.resize(2);
  header.turntable = tilted_table();
  header.sensors[1].T_table_sensor = rotation_about_y(1.0);
  EXPECT_TRUE(sensor_pose(header, 0)->isApprox(*table_from_sensor(tilted_table())));
  EXPECT_TRUE(sensor_pose(header, 1)->isApprox(rotation_about_y(1.0)));
}

TEST(SensorPose, SaysWhatIsMissingWhenNothingTellsWhereTheTableIs) {
  SequenceHeader header;
  header.sensors.resize(1);
  const auto pose = sensor_pose(header, 0);
  ASSERT_FALSE(pose);
  EXPECT_EQ(pose.error().code, ErrorCode::kMissingData);
  EXPECT_NE(pose.error().message.find("--turntable-axis"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
