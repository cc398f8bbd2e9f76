#include <gtest/gtest.h>

#include <numbers>
#include <tests/reconstruction/passes/lumpy_object.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/passes/free_space.hpp>
#include <turnscan/reconstruction/passes/motion_votes.hpp>
#include <turnscan/reconstruction/passes/samples.hpp>

namespace turnscan::passes {
namespace {

using namespace turnscan::testing;

PassSurface ball_pass() {
  const TriangleMesh ball = star_mesh(ball_radius);
  return pass_of(ball, set_down(ball, Eigen::Matrix3d::Identity()), 0.0, 1);
}

TEST(RotationGrid, AnyRotationHasOneOfTheGridNearIt) {
  const double spacing = 20.0 * std::numbers::pi / 180.0;
  const auto grid = rotation_grid(spacing);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto draw = [&](std::uint64_t k) { return standard_normal(hash_key(3, i, k)); };
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(draw(0), draw(1), draw(2), draw(3)).normalized();
    double nearest = 10.0;
    for (const Eigen::Matrix3f& r : grid)
      nearest = std::min(nearest, q.angularDistance(Eigen::Quaterniond(r.cast<double>())));
    EXPECT_LT(nearest, 0.85 * spacing);
  }
}

TEST(FreeSpace, BeforeTheObjectIsEmptyInsideAndOnItNot) {
  const PassSurface pass = ball_pass();
  const FreeSpace free(pass, 0.004);
  const Vec3f center(0.004f, 0.06f, -0.007f);
  EXPECT_FALSE(free.empty_at(center));
  for (std::size_t i = 0; i < pass.points.size(); i += 97) {
    if (pass.normals[i].y() < 0.0f) continue;
    EXPECT_FALSE(free.empty_at(pass.points[i]));
    EXPECT_TRUE(free.empty_at(pass.points[i] + 0.02f * pass.normals[i]));
  }
}

TEST(FreeSpace, NothingIsInThePlatter) {
  const PassSurface pass = ball_pass();
  const FreeSpace free(pass, 0.004);
  EXPECT_TRUE(free.empty_at({0.0f, -0.01f, 0.0f}));
}

TEST(NearestGrid, GivesTheNearestSampleButForTheCellsSize) {
  const Samples samples = thinned(ball_pass(), 500);
  const int side = 40;
  const double reach = 0.02;
  const NearestGrid grid(samples, side, reach);
  const double cell = (0.12 + 2.0 * reach) / side;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto draw = [&](std::uint64_t k) { return float(uniform01(hash_key(5, i, k))); };
    const Vec3f p(0.2f * draw(0) - 0.1f, 0.15f * draw(1), 0.2f * draw(2) - 0.1f);
    float nearest = 1.0f;
    for (const Vec3f& sample : samples.points) nearest = std::min(nearest, (sample - p).norm());
    const std::uint32_t found = grid(p);
    if (found != NearestGrid::kNone) {
      EXPECT_LT((samples.points[found] - p).norm(), nearest + 2.0 * cell);
    } else {
      EXPECT_GT(nearest, reach - cell);
    }
  }
}

TEST(Samples, AreAboutAsManyAsAskedForAndKeepTheArea) {
  const PassSurface pass = ball_pass();
  double area = 0.0, sampled = 0.0;
  for (const float a : pass.areas) area += double(a);
  for (const std::size_t count : {300u, 3000u}) {
    const Samples samples = thinned(pass, count);
    EXPECT_NEAR(double(samples.size()), double(count), 0.4 * double(count));
    sampled = 0.0;
    for (const float a : samples.areas) sampled += double(a);
    EXPECT_NEAR(sampled, area, 1e-3 * area);
    for (const Vec3f& p : samples.points)
      EXPECT_NEAR((p - Vec3f(0.004f, 0.06f, -0.007f)).norm(), 0.06f, 0.002f);
  }
}

TEST(MeasuredSurface, LeavesOutWhatWasInventedAndItsSurroundings) {
  ObjectResult object;
  object.mesh = star_mesh(ball_radius);
  object.confidence.assign(object.mesh.vertices.size(), 1.0f);
  object.evidence.assign(object.mesh.triangles.size(), Evidence::kMeasured);
  const std::size_t whole = measured_surface(object).points.size();
  for (std::size_t i = 0; i < object.evidence.size() / 2; ++i)
    object.evidence[i] = Evidence::kInvented;
  const PassSurface half = measured_surface(object);
  EXPECT_LT(half.points.size(), whole / 2 - 2 * 180);
  for (std::size_t i = 0; i < half.points.size(); ++i) {
    EXPECT_LT(half.points[i].y(), -0.003f);
    EXPECT_GT(half.normals[i].dot(half.points[i]), 0.05f);
  }
}

}  // namespace
}  // namespace turnscan::passes
