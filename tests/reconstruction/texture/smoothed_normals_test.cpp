#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/texture/smoothed_normals.hpp>

#include "tests/reconstruction/texture/painted_ellipsoid.hpp"

namespace turnscan::texture {
namespace {

/// Mean angle to those of the ellipsoid itself, radians.
double error_of(const TriangleMesh& mesh, const std::vector<Vec3f>& normals) {
  const Vec3f axes = testing::ellipsoid_axes().cast<float>();
  double sum = 0.0;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3f truth = mesh.vertices[v].cwiseQuotient(axes.cwiseProduct(axes)).normalized();
    sum += double(std::acos(std::clamp(normals[v].dot(truth), -1.0f, 1.0f)));
  }
  return sum / double(normals.size());
}

TEST(SmoothedNormals, ErrLessThanThoseOfARoughMesh) {
  TriangleMesh mesh = testing::ellipsoid_mesh(400);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertices[v] *= 1.0f + 2e-3f * float(uniform01(hash_key(1, 2, v)) - 0.5);
  const double rough = error_of(mesh, vertex_normals(mesh));
  EXPECT_GT(rough, 0.05);
  EXPECT_LT(error_of(mesh, smoothed_normals(mesh)), 0.3 * rough);
}

TEST(SmoothedNormals, AreTheMeshsOwnWhereItIsCoarse) {
  const TriangleMesh mesh = testing::ellipsoid_mesh(60);
  EXPECT_EQ(smoothed_normals(mesh), vertex_normals(mesh));
}

TEST(SmoothedNormals, FollowABendThatIsMoreThanNoise) {
  const TriangleMesh mesh = testing::ellipsoid_mesh(400);
  EXPECT_LT(error_of(mesh, smoothed_normals(mesh)), 0.01);
}

}  // namespace
}  // namespace turnscan::texture
