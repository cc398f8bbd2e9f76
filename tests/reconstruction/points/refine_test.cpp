#include <gtest/gtest.h>

#include <tests/support/synthetic_cloud.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/points/normals.hpp>
#include <turnscan/reconstruction/points/refine.hpp>
#include "tests/support/sanitizers.hpp"

namespace turnscan::points {
namespace {

struct Oriented {
  voxels::MeasuredCells measurements;
  voxels::VoxelGrid grid;
  Candidates candidates;
};

Oriented orient(const voxels::MergedCloud& merged, double size, double radius) {
  Oriented out;
  out.measurements = testing::measured(merged, size);
  out.grid = out.measurements.grid;
  out.grid.filter(voxels::count_filter(out.grid, choose_min_points(out.grid).min_points));
  out.candidates = *find_candidates(out.measurements, out.grid, RunContext());
  EXPECT_TRUE(estimate_normals(out.candidates, radius, RunContext()));
  return out;
}

TEST(Normals, OfASpherePointOutwardsEverywhere) {
  const Oriented o = orient(testing::noisy_sphere(200000, 0.05, 0.0005), 0.002, 0.006);
  for (std::size_t i = 0; i < o.candidates.cloud.size(); ++i)
    EXPECT_GT(o.candidates.cloud.normals[i].dot(o.candidates.cloud.points[i].normalized()), 0.8f);
}

TEST(Normals, OfBothSidesOfAThinPlatePointApart) {
  voxels::MergedCloud merged = testing::noisy_plane(60000, 0.02, 0.0002, 0.0015);
  const voxels::MergedCloud top = merged;
  for (std::size_t i = 0; i < top.cloud.size(); ++i) {
    Vec3f p = top.cloud.points[i];
    p.y() = -p.y();
    merged.cloud.points.push_back(p);
    merged.cloud.frame.push_back(top.cloud.frame[i] + 3);
  }
  for (int f = 0; f < 3; ++f) {
    Viewpoint below = merged.viewpoints[std::size_t(f)];
    below.value.y() = -below.value.y();
    merged.viewpoints.push_back(below);
  }
  const Oriented o = orient(merged, 0.001, 0.004);
  for (std::size_t i = 0; i < o.candidates.cloud.size(); ++i) {
    const Vec3f& p = o.candidates.cloud.points[i];
    if (std::max(std::abs(p.x()), std::abs(p.z())) > 0.015f) continue;
    EXPECT_GT(o.candidates.cloud.normals[i].y() * (p.y() > 0 ? 1.0f : -1.0f), 0.9f);
  }
}

TEST(Normals, WithTooFewNeighboursPointToTheSensor) {
  voxels::MergedCloud merged;
  merged.viewpoints = {{Vec3d::UnitZ(), true}};
  merged.cloud.points = {Vec3f(0, 0, 0), Vec3f(1, 0, 0)};
  merged.cloud.frame = {0, 0};
  const Oriented o = orient(merged, 0.01, 0.02);
  for (const Vec3f& n : o.candidates.cloud.normals) EXPECT_LT((n - Vec3f::UnitZ()).norm(), 1e-6f);
}

TEST(Refine, BringsANoisyPlaneBelowATenthOfTheNoise) {
  Oriented o = orient(testing::noisy_plane(300000, 0.04, 0.0015), 0.001, 0.0045);
  const auto refined =
      refine_candidates(o.measurements, o.grid, o.candidates, {0.002, 0.0015}, 3, RunContext());
  ASSERT_TRUE(refined);
  double sum = 0.0, squares = 0.0;
  std::size_t n = 0;
  for (const Vec3f& p : refined->cloud.points) {
    if (std::max(std::abs(p.x()), std::abs(p.z())) > 0.035f) continue;
    sum += p.y();
    squares += double(p.y()) * p.y();
    ++n;
  }
  ASSERT_GT(n, 3000u);
  EXPECT_LT(std::sqrt(squares / double(n)), 0.00015);
  EXPECT_LT(std::abs(sum / double(n)), 0.00003);
}

TEST(Refine, KeepsTheRadiusOfANoisySphere) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  Oriented o = orient(testing::noisy_sphere(500000, 0.04, 0.001), 0.001, 0.004);
  const auto refined =
      refine_candidates(o.measurements, o.grid, o.candidates, {0.0015, 0.001}, 3, RunContext());
  ASSERT_TRUE(refined);
  double sum = 0.0;
  for (const Vec3f& p : refined->cloud.points) sum += p.norm() - 0.04;
  EXPECT_LT(std::abs(sum / double(refined->cloud.size())), 0.00005);
}

TEST(Refine, LeavesOneCandidateAVoxelAndSide) {
  Oriented o = orient(testing::noisy_plane(300000, 0.03, 0.0015), 0.001, 0.0045);
  const auto refined =
      refine_candidates(o.measurements, o.grid, o.candidates, {0.002, 0.0015}, 3, RunContext());
  ASSERT_TRUE(refined);
  const auto grid =
      voxels::VoxelGrid::build(refined->cloud.points, 0.0012, RunContext());  // 0.6 radii
  // The mean of a voxel's candidates may round into its neighbour.
  EXPECT_LE(double(refined->cloud.size()), 1.05 * double(grid->voxels().size()));
}

TEST(Refine, IsTheSameForOneAndTwoThreads) {
  Oriented o = orient(testing::noisy_plane(50000, 0.02, 0.001), 0.001, 0.003);
  set_thread_count(1);
  const auto one =
      refine_candidates(o.measurements, o.grid, o.candidates, {0.001, 0.001}, 2, RunContext());
  set_thread_count(2);
  const auto two =
      refine_candidates(o.measurements, o.grid, o.candidates, {0.001, 0.001}, 2, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->cloud.points, two->cloud.points);
  EXPECT_EQ(one->cloud.normals, two->cloud.normals);
}

TEST(Refine, GivesNothingOnceCancelled) {
  Oriented o = orient(testing::noisy_plane(5000, 0.02, 0.001), 0.002, 0.004);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(refine_candidates(o.measurements, o.grid, o.candidates, {0.001, 0.001}, 2, context)
                .error()
                .code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::points
