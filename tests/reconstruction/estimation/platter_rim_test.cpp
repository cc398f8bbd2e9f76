#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/reconstruction/estimation/platter_rim.hpp>

namespace turnscan::estimation {
namespace {

constexpr double kRadius_m = 0.12;

SensorInfo small_camera() {
  SensorInfo sensor;
  sensor.intrinsics.width = 200;
  sensor.intrinsics.height = 160;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 400.0;
  sensor.intrinsics.cx = 99.5;
  sensor.intrinsics.cy = 79.5;
  sensor.depth_unit_m = 1e-4;
  return sensor;
}

/// From 0.7 m in front of the axis, 30 degrees up.
Pose pose_above() {
  Pose pose = Pose::Identity();
  const Vec3d back(0.0, std::sin(0.5236), std::cos(0.5236)), right = Vec3d::UnitX();
  pose.linear().col(0) = right;
  pose.linear().col(2) = -back;
  pose.linear().col(1) = (-back).cross(right);
  pose.translation() = 0.7 * back;
  return pose;
}

/// A platter, if there is one, and before it a box that hides what is less than `hidden_m` from the
/// axis or behind it, if given.
Frame look(bool platter, double hidden_m = 0.0) {
  const SensorInfo sensor = small_camera();
  const Pose pose = pose_above();
  Frame frame;
  frame.depth = DepthImage(200, 160);
  for (int v = 0; v < 160; ++v) {
    for (int u = 0; u < 200; ++u) {
      const Vec3d ray = sensor.intrinsics.ray(u, v), d = pose.linear() * ray;
      const double z = -pose.translation().y() / d.y();
      const Vec3d p = pose.translation() + z * d;
      const bool on = d.y() < 0.0 && std::hypot(p.x(), p.z()) < kRadius_m;
      double depth = on && platter ? z : 0.0;
      if (hidden_m > 0.0 && std::abs(p.x()) < hidden_m && p.z() < hidden_m) depth = z - 0.06;
      frame.depth.pixels[std::size_t(200 * v + u)] = std::uint16_t(depth / sensor.depth_unit_m);
    }
  }
  return frame;
}

double share_seen(const Frame& frame) {
  PlatterRim rim(kRadius_m);
  rim.add(frame, small_camera(), pose_above());
  return rim.share_seen();
}

TEST(PlatterRim, IsSeenAllAround) { EXPECT_EQ(share_seen(look(true)), 1.0); }

TEST(PlatterRim, IsNotThereWhereNothingReturns) { EXPECT_EQ(share_seen(look(false)), 0.0); }

TEST(PlatterRim, WhatAnObjectHidesTellsNothing) {
  EXPECT_GT(share_seen(look(true, 0.08)), 0.95);
  EXPECT_LT(share_seen(look(false, 0.08)), 0.05);
}

TEST(PlatterRim, IsNotSeenWhereAllIsHidden) { EXPECT_EQ(share_seen(look(true, 1.0)), 0.0); }

TEST(PlatterRim, AddsUpFramesThatShowDifferentParts) {
  // Both frames hide half of the rim: one that sees a platter, one that sees past it.
  PlatterRim rim(kRadius_m);
  const Pose turned = Eigen::AngleAxisd(0.5 * kTurn, Vec3d::UnitY()) * pose_above();
  rim.add(look(true, 0.06), small_camera(), pose_above());
  EXPECT_GT(rim.share_seen(), 0.95);
  for (int i = 0; i < 2; ++i) rim.add(look(false, 0.06), small_camera(), turned);
  EXPECT_LT(rim.share_seen(), 0.8);
}

}  // namespace
}  // namespace turnscan::estimation
