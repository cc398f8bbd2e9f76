#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/motion_input/object_base.hpp>

#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan::motion {
namespace {

/// An upright cylinder about the axis, which looks at rest while it turns.
TriangleMesh round_foot(double low_m, double high_m, double radius_m) {
  TriangleMesh mesh = *builtin_object("cylinder");
  const Box box = bounds(mesh.vertices);
  for (Vec3f& p : mesh.vertices) {
    p.x() *= float(radius_m / (0.5 * box.size().x()));
    p.z() *= float(radius_m / (0.5 * box.size().z()));
    p.y() = float(low_m + (high_m - low_m) * (double(p.y()) - box.min.y()) / box.size().y());
  }
  return mesh;
}

/// A letter that turns above a desk with things on it; no platter is seen.
testing::RigOptions without_platter() {
  testing::RigOptions o;
  o.distance_m = 0.9;
  o.elevation_rad = 0.3;
  o.aim_height_m = 0.07;
  o.platter = o.drum = false;
  o.desk_m = 0.045;
  o.clutter = 6;
  o.frames = 40;
  o.fps = 1.0;
  o.angle = [](double t) { return 1.1 * kTurn * t / 40.0; };
  o.objects = {*builtin_object("letter-a")};
  return o;
}

/// With the true axis and angles. Heights count from the platter that is not seen.
ObjectBase base_of(const testing::RigOptions& options) {
  const testing::Rig rig(options);
  const auto data = load_motion(rig, {}, {});
  EXPECT_TRUE(data) << data.error().text();
  if (!data) return {};
  EXPECT_FALSE(data->platter);
  std::vector<double> angles_rad;
  for (const MotionFrame& frame : data->frames)
    angles_rad.push_back(rig.true_angle(frame.position));
  return find_base(*data, rig.truth(), angles_rad, rig).value();
}

TEST(FindBase, TellsWhereTheObjectEndsBelowAndSidewaysInARoom) {
  const ObjectBase base = base_of(without_platter());
  EXPECT_LT(std::abs(base.height_m), 0.008);
  EXPECT_TRUE(base.ends);
  EXPECT_FALSE(base.on_surface);  // the desk lies farther down
  ASSERT_TRUE(base.reach_m);
  EXPECT_NEAR(*base.reach_m, 0.5 * LetterA::width_m, 0.01);
}

TEST(FindBase, DoesNotTakeTheTurntablesFootForTheObjects) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = without_platter();
  o.objects.push_back(round_foot(-0.045, -0.015, 0.04));
  const ObjectBase base = base_of(o);
  EXPECT_LT(std::abs(base.height_m), 0.008);
  EXPECT_TRUE(base.ends);
}

TEST(FindBase, GoesDownToThinPartsThatAreAllOutline) {
  testing::RigOptions o;
  o.distance_m = 1.44;
  o.elevation_rad = 0.576;
  o.aim_height_m = 0.067;
  o.platter = o.room = false;
  o.noise_m = 0.0004;
  o.frames = 42;
  o.fps = 3.5;
  o.angle = [](double t) { return -0.9 * kTurn * t / 12.0; };
  // Pixels are 4 mm apart there, as far as the jaw is thick.
  TriangleMesh skull = *builtin_object("skull");
  const double scale = 0.133 / bounds(skull.vertices).size().y();
  const Eigen::AngleAxisd yaw(4.2, Vec3d::UnitY());
  for (Vec3f& p : skull.vertices)
    p = (yaw * p.cast<double>() * scale + Vec3d(0.014, 0.0, 0.016)).cast<float>();
  o.objects = {std::move(skull)};
  const double low = bounds(o.objects[0].vertices).min.y();
  const ObjectBase base = base_of(o);
  EXPECT_NEAR(base.height_m, low, 0.01);
  EXPECT_TRUE(base.ends);
}

TEST(FindBase, KeepsARoundFootThatLooksAtRest) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = without_platter();
  o.objects.push_back(round_foot(-0.025, 0.01, 0.045));
  const ObjectBase base = base_of(o);
  EXPECT_NEAR(base.height_m, -0.025, 0.006);
  EXPECT_TRUE(base.ends);
}

TEST(FindBase, SaysThatAFootOnADeskLeavesTheHeightOpen) {
  testing::RigOptions o = without_platter();
  o.objects.push_back(round_foot(-0.045, 0.01, 0.045));
  const ObjectBase base = base_of(o);
  EXPECT_NEAR(base.height_m, -0.045, 0.006);
  EXPECT_FALSE(base.ends);
  EXPECT_TRUE(base.on_surface);
}

TEST(FindBase, TakesScansOfPointsAsTheyAre) {
  MotionData data;
  data.projective = false;
  data.spacing_m = 0.002;
  TurntableInfo axis;
  std::vector<double> angles_rad;
  for (int k = 0; k < 6; ++k) {
    MotionFrame frame;
    angles_rad.push_back(0.2 * k);
    const Eigen::AngleAxisd turn(angles_rad.back(), Vec3d::UnitY());
    for (const double x : {0.0, 0.03, 0.07})
      for (const double y : {0.012, 0.05})
        frame.surface.points.push_back((turn * Vec3d(x, y, 0.001)).cast<float>());
    // Dust that stands still turns with nothing.
    frame.surface.points.emplace_back(0.3f, -0.1f, 0.0f);
    data.frames.push_back(std::move(frame));
    data.keys.push_back(std::size_t(k));
  }
  const testing::Rig unread(without_platter());
  const auto base = find_base(data, axis, angles_rad, unread);
  ASSERT_TRUE(base);
  EXPECT_NEAR(base->height_m, 0.012, 1e-6);
  EXPECT_TRUE(base->ends);
  ASSERT_TRUE(base->reach_m);
  EXPECT_NEAR(*base->reach_m, std::hypot(0.07, 0.001), 1e-6);
}

}  // namespace
}  // namespace turnscan::motion
