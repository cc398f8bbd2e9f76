#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/registration/registration.hpp>
#include <turnscan/geometry/search/sample.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

/// A lopsided solid of about 0.2 m that has no symmetry.
TriangleMesh pebble() {
  TriangleMesh mesh = sphere(0.1, 5);
  for (Vec3f& v : mesh.vertices) {
    const Vec3f u = v * 10.0f;
    v *= 1.0f + 0.25f * u.x() * u.y() + 0.2f * std::sin(3.0f * u.z() + u.x()) + 0.1f * u.y();
  }
  return mesh;
}

Pose small_motion() {
  return Eigen::Translation3d(0.004, -0.003, 0.002) *
         Eigen::AngleAxisd(0.05, Vec3d(1, 2, -1).normalized());
}

std::vector<Vec3f> moved(std::vector<Vec3f> points, const Pose& T) {
  for (Vec3f& p : points) p = (T * p.cast<double>()).cast<float>();
  return points;
}

double farthest_error(const Pose& T, const Pose& expected, const std::vector<Vec3f>& points) {
  double farthest = 0.0;
  for (const Vec3f& p : points) {
    farthest = std::max(farthest, (T * p.cast<double>() - expected * p.cast<double>()).norm());
  }
  return farthest;
}

TEST(Icp, FindsAKnownMotionOntoAMesh) {
  const TriangleMesh mesh = pebble();
  const auto source = moved(sample_surface(mesh, 3000, 1)->points, small_motion().inverse());
  const auto result = icp(source, mesh, Pose::Identity(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LT(farthest_error(result->T_target_source, small_motion(), source), 1e-5);
  EXPECT_LT(result->rms_m, 1e-5);
  EXPECT_EQ(result->overlap, 1.0);
  EXPECT_EQ(result->held_directions, 0);
}

TEST(Icp, FindsAKnownMotionOntoPointsWithNormals) {
  const auto target = sample_surface(pebble(), 60000, 2);
  const auto source = moved(sample_surface(pebble(), 3000, 1)->points, small_motion().inverse());
  const auto result =
      icp(source, target->points, target->normals, Pose::Identity(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LT(farthest_error(result->T_target_source, small_motion(), source), 5e-5);
}

TEST(Icp, WithstandsNoiseAndAFifthOfOutliers) {
  const TriangleMesh mesh = pebble();
  auto source = sample_surface(mesh, 5000, 1)->points;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Vec3f noise(float(random_value(7, i, 0)), float(random_value(7, i, 1)),
                      float(random_value(7, i, 2)));
    source[i] += noise * 2e-4f;
    if (i % 5 == 0) source[i] += 0.008f * source[i].normalized() * std::abs(noise.x());
  }
  source = moved(source, small_motion().inverse());
  const auto result = icp(source, mesh, Pose::Identity(), {.keep = 0.8}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LT(farthest_error(result->T_target_source, small_motion(), source), 1e-4);
}

TEST(Icp, HoldsWhatASphereAPlaneAndATubeDoNotDetermine) {
  const Pose off(Eigen::Translation3d(0.0, 0.0, 0.003));
  const auto ball = sample_surface(sphere(0.1, 6), 4000, 1)->points;
  const auto on_ball = icp(ball, sphere(0.1, 6), off, {}, RunContext());
  ASSERT_TRUE(on_ball) << on_ball.error().text();
  EXPECT_EQ(on_ball->held_directions, 3);
  EXPECT_LT(farthest_error(on_ball->T_target_source, Pose::Identity(), ball), 1e-4);

  const auto sheet = moved(sample_surface(plane(3, 0.1), 4000, 1)->points,
                           Pose(Eigen::Translation3d(0.45, 0.45, 0.0)));
  const auto on_plane = icp(sheet, plane(3), off, {}, RunContext());
  ASSERT_TRUE(on_plane) << on_plane.error().text();
  EXPECT_EQ(on_plane->held_directions, 3);
  EXPECT_LT(farthest_error(on_plane->T_target_source, Pose::Identity(), sheet), 1e-6);
}

TEST(Icp, StartsWhereItIsTold) {
  const TriangleMesh mesh = pebble();
  const Pose far = Eigen::Translation3d(3.0, 2.0, 1.0) * Eigen::AngleAxisd(2.0, Vec3d::UnitZ());
  const auto source = moved(sample_surface(mesh, 3000, 1)->points, far.inverse());
  EXPECT_EQ(icp(source, mesh, Pose::Identity(), {}, RunContext()).error().code,
            ErrorCode::kTooFewPoints);
  const auto result = icp(source, mesh, small_motion() * far, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LT(farthest_error(result->T_target_source, far, source), 1e-5);
}

TEST(Icp, IsTheSameForOneAndTwoThreads) {
  const TriangleMesh mesh = pebble();
  const auto source = moved(sample_surface(mesh, 5000, 1)->points, small_motion().inverse());
  set_thread_count(1);
  const auto one = icp(source, mesh, Pose::Identity(), {}, RunContext());
  set_thread_count(2);
  const auto two = icp(source, mesh, Pose::Identity(), {}, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->T_target_source.matrix(), two->T_target_source.matrix());
  EXPECT_EQ(one->rms_m, two->rms_m);
}

TEST(Icp, NeverReturnsSilentlyWhatDidNotConverge) {
  const TriangleMesh mesh = pebble();
  const auto source = moved(sample_surface(mesh, 3000, 1)->points, small_motion().inverse());
  const auto error = [&](const IcpOptions& options) {
    const auto result = icp(source, mesh, Pose::Identity(), options, RunContext());
    return result ? std::string("success") : result.error().message;
  };
  EXPECT_THAT(error({.max_iterations = 2}), testing::HasSubstr("not converged after 2 steps"));
  EXPECT_THAT(error({.max_shift_m = 0.001}), testing::HasSubstr("moved by"));
  EXPECT_THAT(error({.max_turn_rad = 0.01}), testing::HasSubstr("turned by"));
  EXPECT_THAT(error({.max_distance_m = 1e-5}), testing::HasSubstr("lie within 0.01mm"));
  EXPECT_THAT(error({.keep = 2.0}), testing::HasSubstr("icp-keep"));
}

TEST(Icp, FailsByNameOnTooFewPointsBrokenMeshesAndCancel) {
  const RunContext context;
  const auto code = [&](std::span<const Vec3f> source, const TriangleMesh& mesh) {
    return icp(source, mesh, Pose::Identity(), {}, context).error().code;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vec3f> points(10, Vec3f::Zero()), bad(10, Vec3f::Constant(nan));
  EXPECT_EQ(code({}, cube()), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code(bad, cube()), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code(points, TriangleMesh()), ErrorCode::kTooFewPoints);
  TriangleMesh broken = cube();
  broken.triangles[0][0] = 8;
  EXPECT_EQ(code(points, broken), ErrorCode::kFormat);
  EXPECT_EQ(icp(points, points, {}, Pose::Identity(), {}, context).error().code,
            ErrorCode::kInvalidOption);
  context.cancel();
  EXPECT_EQ(code(points, cube()), ErrorCode::kCancelled);
}

TEST(Icp, IsCancelledAmidTheSearchForPairs) {
  const RunContext context;
  std::atomic<int> asked = 0;
  const IcpLookup slow = [&](const Vec3d&, double) -> IcpTarget {
    ++asked;
    context.cancel();
    return {};
  };
  const std::vector<Vec3f> points(100000, Vec3f::Zero());
  EXPECT_EQ(icp(points, slow, Pose::Identity(), {}, context).error().code, ErrorCode::kCancelled);
  EXPECT_LT(asked, 100);
}

}  // namespace
}  // namespace turnscan
