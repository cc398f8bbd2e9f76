#pragma once

#include <gtest/gtest.h>

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::testing {

/// A closed tetrahedron with every attribute; coordinates that are not exact in text or in
/// millimetres.
inline TriangleMesh tetrahedron(float size = 0.1F, float shift = 0.0F) {
  TriangleMesh mesh;
  mesh.vertices = {{shift, 0, 0}, {shift + size, 0, 0}, {shift, size, 1e-7F}, {shift, 0, size / 3}};
  mesh.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}};
  for (const Vec3f& p : mesh.vertices)
    mesh.normals.push_back((p - Vec3f(shift + size / 4, size / 4, size / 12)).normalized());
  mesh.colors = {{0, 0, 0}, {255, 128, 1}, {2, 3, 254}, {77, 200, 100}};
  return mesh;
}

inline void expect_near(const TriangleMesh& a, const TriangleMesh& b, float tolerance) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    EXPECT_LE((a.vertices[i] - b.vertices[i]).norm(), tolerance) << i;
  EXPECT_EQ(a.triangles, b.triangles);
}

}  // namespace turnscan::testing
