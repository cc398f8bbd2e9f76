#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/geometry/mesh/cut_handles.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>

#include "tests/geometry/dense_grid.hpp"

namespace turnscan {
namespace {

constexpr int kSamplesAlong = 40;
constexpr double kEverywhere = 1e9;

/// The zero set of value(p) in a box of 2 m around the origin.
template <class Value>
TriangleMesh zero_set(const Value& value) {
  DenseGrid grid{Vec3d(-1, -1, -1),
                 2.0 / (kSamplesAlong - 1),
                 {kSamplesAlong, kSamplesAlong, kSamplesAlong},
                 {}};
  for (int k = 0; k < kSamplesAlong; ++k) {
    for (int j = 0; j < kSamplesAlong; ++j) {
      for (int i = 0; i < kSamplesAlong; ++i)
        grid.values.push_back(float(value(grid.origin_m + grid.cell_m * Vec3d(i, j, k))));
    }
  }
  return *isosurface(grid, {}, RunContext());
}

double ring_field(const Vec3d& p) {
  return std::hypot(std::hypot(p.x(), p.y()) - 0.6, p.z()) - 0.15;
}

double rod_field(const Vec3d& p, double x) { return std::hypot(p.x() - x, p.z()) - 0.08; }

/// Two balls, one above the other, and three rods between them: genus 2.
double balls_with_rods(const Vec3d& p) {
  double out = std::min((p - Vec3d(0, 0.5, 0)).norm(), (p + Vec3d(0, 0.5, 0)).norm()) - 0.4;
  if (std::abs(p.y()) < 0.5)
    for (const double x : {-0.2, 0.0, 0.2}) out = std::min(out, rod_field(p, x));
  return out;
}

/// A plate with a hole of 0.1 m radius.
double plate_with_hole(const Vec3d& p) {
  const double plate =
      std::max({std::abs(p.x()) - 0.8, std::abs(p.y()) - 0.2, std::abs(p.z()) - 0.8});
  return std::max(plate, 0.1 - std::hypot(p.x(), p.z()));
}

std::vector<std::uint8_t> all_cuttable(const TriangleMesh& mesh) {
  return std::vector<std::uint8_t>(mesh.vertices.size(), 1);
}

TEST(CutHandles, PartsARing) {
  TriangleMesh mesh = zero_set(ring_field);
  ASSERT_EQ(check_mesh(mesh).euler, 0);
  const double volume = check_mesh(mesh).volume_m3;
  const auto cuts = cut_handles(mesh, all_cuttable(mesh), 1.5, RunContext());
  ASSERT_TRUE(cuts) << cuts.error().text();
  EXPECT_EQ(*cuts, 1u);
  EXPECT_EQ(check_mesh(mesh).euler, 2);
  EXPECT_TRUE(check_mesh(mesh).watertight()) << check_mesh(mesh).text();
  EXPECT_NEAR(check_mesh(mesh).volume_m3, volume, 0.05 * volume);
}

TEST(CutHandles, LeavesOneOfThreeRodsBetweenTwoBalls) {
  TriangleMesh mesh = zero_set(balls_with_rods);
  ASSERT_EQ(check_mesh(mesh).euler, -2);
  EXPECT_EQ(*cut_handles(mesh, all_cuttable(mesh), 0.9, RunContext()), 2u);
  EXPECT_EQ(check_mesh(mesh).euler, 2);
  EXPECT_EQ(check_mesh(mesh).components, 1);
  EXPECT_TRUE(check_mesh(mesh).watertight()) << check_mesh(mesh).text();
}

TEST(CutHandles, WallsUpATunnel) {
  TriangleMesh mesh = zero_set(plate_with_hole);
  ASSERT_EQ(check_mesh(mesh).euler, 0);
  EXPECT_EQ(*cut_handles(mesh, all_cuttable(mesh), 1.0, RunContext()), 1u);
  EXPECT_EQ(check_mesh(mesh).euler, 2);
  EXPECT_TRUE(check_mesh(mesh).watertight()) << check_mesh(mesh).text();
}

TEST(CutHandles, LeavesHandlesThickerThanAskedAndSurfaceThatMayNotBeCut) {
  const TriangleMesh mesh = zero_set(ring_field);
  TriangleMesh thick = mesh, half = mesh;
  EXPECT_EQ(*cut_handles(thick, all_cuttable(mesh), 0.7, RunContext()), 0u);
  EXPECT_EQ(thick.triangles, mesh.triangles);
  std::vector<std::uint8_t> above(mesh.vertices.size());
  for (std::size_t v = 0; v < above.size(); ++v) above[v] = mesh.vertices[v].z() > 0.0f ? 1 : 0;
  EXPECT_EQ(*cut_handles(half, above, 1.5, RunContext()), 0u);
  // Around the middle of the ring, above, a longer loop separates nothing.
  EXPECT_EQ(*cut_handles(half, above, kEverywhere, RunContext()), 1u);
}

TEST(CutHandles, LeavesNecksThatPartThePiece) {
  TriangleMesh mesh = zero_set([](const Vec3d& p) {
    const double balls =
        std::min((p - Vec3d(0, 0.5, 0)).norm(), (p + Vec3d(0, 0.5, 0)).norm()) - 0.4;
    return std::abs(p.y()) < 0.5 ? std::min(balls, rod_field(p, 0.0)) : balls;
  });
  EXPECT_EQ(*cut_handles(mesh, all_cuttable(mesh), 2.0, RunContext()), 0u);
}

TEST(CutHandles, RefusesAnOpenMesh) {
  TriangleMesh mesh = zero_set(ring_field);
  mesh.triangles.pop_back();
  const auto cuts = cut_handles(mesh, all_cuttable(mesh), 1.0, RunContext());
  ASSERT_FALSE(cuts);
  EXPECT_EQ(cuts.error().code, ErrorCode::kFormat);
}

}  // namespace
}  // namespace turnscan
