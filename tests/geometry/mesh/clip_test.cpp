#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <turnscan/geometry/mesh/clip.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

constexpr double kPi = std::numbers::pi;

ClippedMesh clipped(const TriangleMesh& mesh, const Vec3d& normal, double offset_m) {
  const auto out = clip(mesh, {normal.normalized(), offset_m});
  EXPECT_TRUE(out) << (out ? "" : out.error().message);
  return out ? *out : ClippedMesh();
}

double height_above(const TriangleMesh& mesh, const HalfSpace& h) {
  double least = 1e300;
  for (const Vec3f& v : mesh.vertices)
    least = std::min(least, h.normal.dot(v.cast<double>()) - h.offset_m);
  return least;
}

TEST(Clip, LeavesHalfOfABallClosedFlat) {
  const ClippedMesh half = clipped(test::sphere(0.05, 5), Vec3d(1, 2, 3), 0.0);
  const MeshReport check = check_mesh(half.mesh);
  EXPECT_TRUE(check.watertight()) << check.text();
  EXPECT_EQ(check.euler, 2);
  EXPECT_NEAR(check.volume_m3, 2.0 / 3.0 * kPi * std::pow(0.05, 3), 6e-7);
  EXPECT_NEAR(half.cut_area_m2, kPi * 0.05 * 0.05, 2e-5);
  EXPECT_FALSE(half.outlines_cross);
}

TEST(Clip, TheFaceOfARingIsARingOrTwoDiscs) {
  const TriangleMesh ring = test::torus(0.05, 0.02, 64, 32);  // about z
  const ClippedMesh lying = clipped(ring, Vec3d::UnitZ(), 0.0005);
  EXPECT_TRUE(check_mesh(lying.mesh).watertight());
  EXPECT_EQ(check_mesh(lying.mesh).euler, 0);  // still a ring
  EXPECT_NEAR(lying.cut_area_m2, kPi * (0.07 * 0.07 - 0.03 * 0.03), 1e-4);
  const ClippedMesh standing = clipped(ring, Vec3d::UnitX(), 0.0005);
  EXPECT_TRUE(check_mesh(standing.mesh).watertight());
  EXPECT_EQ(check_mesh(standing.mesh).euler, 2);
  EXPECT_NEAR(standing.cut_area_m2, 2.0 * kPi * 0.02 * 0.02, 3e-5);
}

TEST(Clip, ACavityIsAHoleInTheFace) {
  TriangleMesh cavity = test::sphere(0.02, 4, Vec3d(0.01, 0.0, 0.0));
  for (auto& t : cavity.triangles) std::swap(t[1], t[2]);
  const ClippedMesh half =
      clipped(join_meshes({test::sphere(0.05, 4), cavity}), Vec3d::UnitY(), 0.001);
  EXPECT_TRUE(check_mesh(half.mesh).watertight()) << check_mesh(half.mesh).text();
  EXPECT_NEAR(half.cut_area_m2, kPi * (0.05 * 0.05 - 0.02 * 0.02), 5e-5);
}

TEST(Clip, VerticesOnThePlaneDoNotHarm) {
  // Edges and faces of the cube lie in the planes.
  for (const double offset_m : {0.0, 0.5, 1.0}) {
    const ClippedMesh part = clipped(test::subdivided(test::cube(), 2), Vec3d::UnitX(), offset_m);
    const MeshReport check = check_mesh(part.mesh);
    if (offset_m < 1.0) {
      EXPECT_TRUE(check.watertight()) << check.text();
      EXPECT_NEAR(check.volume_m3, 1.0 - offset_m, 1e-5);
    } else {
      EXPECT_LT(std::abs(check.volume_m3), 1e-5);
    }
  }
}

TEST(Clip, AnyPlaneLeavesAClosedPartAndTheTwoPartsMakeTheWhole) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  const TriangleMesh ring = test::torus(0.05, 0.02, 40, 20);
  const double whole = check_mesh(ring).volume_m3;
  for (int i = 0; i < 60; ++i) {
    const Vec3d normal = Vec3d(at(random), at(random), at(random)).normalized();
    const HalfSpace plane{normal, 0.05 * at(random)};
    double sum = 0.0;
    for (const HalfSpace& side : {plane, HalfSpace{-plane.normal, -plane.offset_m}}) {
      const auto part = clip(ring, side);
      ASSERT_TRUE(part);
      if (part->mesh.empty()) continue;
      const MeshReport check = check_mesh(part->mesh);
      EXPECT_TRUE(check.watertight()) << i << ": " << check.text();
      EXPECT_FALSE(part->outlines_cross) << i;
      EXPECT_GT(height_above(part->mesh, side), -2e-6);
      sum += check.volume_m3;
    }
    EXPECT_NEAR(sum, whole, 1e-6 * whole + 1e-8);
  }
}

TEST(Clip, TellsWhereEachPartComesFrom) {
  TriangleMesh ball = test::sphere(0.05, 3);
  for (const Vec3f& v : ball.vertices)
    ball.colors.push_back({std::uint8_t(v.y() > 0.0f ? 200 : 100), 0, 0});
  const ClippedMesh half = clipped(ball, Vec3d::UnitY(), 0.01);
  ASSERT_EQ(half.source.size(), half.mesh.triangles.size());
  ASSERT_EQ(half.vertex_source.size(), half.mesh.vertices.size());
  ASSERT_EQ(half.mesh.colors.size(), half.mesh.vertices.size());
  for (std::size_t v = 0; v < half.mesh.vertices.size(); ++v) {
    const auto [a, b] = half.vertex_source[v];
    const Vec3f edge = ball.vertices[b] - ball.vertices[a];
    const Vec3f from = half.mesh.vertices[v] - ball.vertices[a];
    EXPECT_LT((from - (a == b ? 0.0f : edge.dot(from) / edge.squaredNorm()) * edge).norm(), 1e-7f);
  }
  for (std::size_t t = 0; t < half.source.size(); ++t)
    for (const std::uint32_t v : half.mesh.triangles[t]) {
      if (half.source[t] != ClippedMesh::kCutFace) continue;
      EXPECT_NEAR(half.mesh.vertices[v].y(), 0.01f, 2e-6f);
    }
}

TEST(Clip, OutlinesThatCrossAreClosedOneByOne) {
  const ClippedMesh part =
      clipped(join_meshes({test::sphere(0.05, 4), test::sphere(0.05, 4, Vec3d(0.03, 0, 0))}),
              Vec3d::UnitY(), 0.001);
  EXPECT_TRUE(part.outlines_cross);
  EXPECT_TRUE(check_mesh(part.mesh).watertight()) << check_mesh(part.mesh).text();
  EXPECT_EQ(part.vertex_source.size(), part.mesh.vertices.size());
  EXPECT_EQ(part.source.size(), part.mesh.triangles.size());
}

TEST(Clip, AnOpenMeshStaysOpenAndNothingInsideIsEmpty) {
  TriangleMesh open = test::sphere(0.05, 3);
  open.triangles.pop_back();
  const ClippedMesh part = clipped(open, Vec3d::UnitY(), 0.0);
  EXPECT_FALSE(check_mesh(part.mesh).closed);
  EXPECT_EQ(part.cut_area_m2, 0.0);
  EXPECT_TRUE(clipped(open, Vec3d::UnitY(), 1.0).mesh.empty());
}

TEST(Clip, RefusesADirectionThatIsNone) {
  EXPECT_FALSE(clip(test::cube(), {Vec3d::Zero(), 0.0}));
  EXPECT_FALSE(clip(test::cube(), {Vec3d(0, 2, 0), 0.0}));
  EXPECT_FALSE(clip(test::cube(), {Vec3d::UnitX(), std::nan("")}));
}

}  // namespace
}  // namespace turnscan
