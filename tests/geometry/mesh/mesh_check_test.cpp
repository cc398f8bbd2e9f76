#include <gtest/gtest.h>

#include <limits>
#include <turnscan/geometry/mesh/mesh_check.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(MeshCheck, AClosedSurfaceIsWatertightWithItsAreaAndVolume) {
  const MeshReport report = check_mesh(cube());
  EXPECT_TRUE(report.watertight());
  EXPECT_TRUE(report.closed && report.manifold && report.oriented && report.outward);
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_EQ(report.edges, 18u);
  EXPECT_EQ(report.euler, 2);
  EXPECT_EQ(report.components, 1);
  EXPECT_DOUBLE_EQ(report.area_m2, 6.0);
  EXPECT_DOUBLE_EQ(report.volume_m3, 1.0);
}

TEST(MeshCheck, ATorusHasEulerCharacteristicZero) {
  const MeshReport report = check_mesh(torus(1.0, 0.3, 20, 10));
  EXPECT_TRUE(report.watertight());
  EXPECT_EQ(report.euler, 0);
}

TEST(MeshCheck, VolumeKeepsItsDigitsFarFromTheOrigin) {
  TriangleMesh mesh = cube();
  move(mesh, Vec3f(1024, 2048, -4096));
  EXPECT_DOUBLE_EQ(check_mesh(mesh).volume_m3, 1.0);
}

TEST(MeshCheck, AMissingTriangleLeavesThreeBoundaryEdges) {
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.boundary_edges, 3u);
  EXPECT_FALSE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_FALSE(report.watertight());
}

TEST(MeshCheck, AFlippedTriangleDisagreesWithItsThreeNeighbours) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.misoriented_edges, 3u);
  EXPECT_FALSE(report.oriented);
  EXPECT_FALSE(report.watertight());
}

TEST(MeshCheck, InsideOutIsClosedAndOrientedButNotOutward) {
  TriangleMesh mesh = cube();
  flip(mesh);
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.closed && report.manifold && report.oriented);
  EXPECT_FALSE(report.outward);
  EXPECT_DOUBLE_EQ(report.volume_m3, -1.0);
}

TEST(MeshCheck, AnEdgeOfThreeTrianglesIsNotManifold) {
  TriangleMesh mesh = cube();
  mesh.vertices.emplace_back(2.0f, 2.0f, 2.0f);
  mesh.triangles.push_back({0, 1, 8});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.non_manifold_edges, 1u);
  EXPECT_EQ(report.boundary_edges, 2u);
  EXPECT_FALSE(report.manifold);
}

TEST(MeshCheck, TwoSolidsThatTouchAtOneVertexHaveANonManifoldVertex) {
  TriangleMesh mesh = tetrahedron();
  TriangleMesh other = tetrahedron();
  move(other, Vec3f(-1, 0, 0));
  append(mesh, other);
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = v == 5 ? 0 : v;
  }
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.non_manifold_vertices, 1u);
  EXPECT_EQ(report.non_manifold_edges, 0u);
  EXPECT_EQ(report.unreferenced_vertices, 1u);
  EXPECT_EQ(report.components, 1);
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.manifold);
}

TEST(MeshCheck, CountsPiecesThatShareNoVertex) {
  TriangleMesh mesh = cube();
  TriangleMesh other = cube();
  move(other, Vec3f(3, 0, 0));
  append(mesh, other);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.components, 2);
  EXPECT_TRUE(report.watertight());
  flip(other);
  TriangleMesh mixed = cube();
  append(mixed, other);
  EXPECT_FALSE(check_mesh(mixed).outward) << "an inside-out piece beside another one";
}

TEST(MeshCheck, ACavityFacesInward) {
  TriangleMesh mesh = sphere(1.0, 3);
  TriangleMesh cavity = sphere(0.5, 2);
  flip(cavity);
  append(mesh, cavity);
  EXPECT_TRUE(check_mesh(mesh).watertight());
  move(cavity, Vec3f(5, 0, 0));
  TriangleMesh beside = sphere(1.0, 3);
  append(beside, cavity);
  EXPECT_FALSE(check_mesh(beside).watertight());
}

TEST(MeshCheck, CountsDegenerateTriangles) {
  TriangleMesh mesh = cube();
  mesh.vertices.emplace_back(0.5f, 0.0f, 0.0f);  // on edge 0-1
  mesh.triangles.push_back({0, 8, 1});           // no area
  mesh.triangles.push_back({3, 3, 5});           // repeats a vertex
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.degenerate_triangles, 2u);
  EXPECT_EQ(report.repeated_vertices, 1u);
  EXPECT_FALSE(report.manifold);
}

TEST(MeshCheck, CountsUnreferencedVertices) {
  TriangleMesh mesh = cube();
  mesh.vertices.resize(11, Vec3f::Constant(kNan));
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.unreferenced_vertices, 3u);
  EXPECT_TRUE(report.watertight());
}

TEST(MeshCheck, AnEmptyMeshIsNotClosed) {
  const MeshReport report = check_mesh(TriangleMesh());
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.watertight());
  EXPECT_EQ(report.components, 0);
  EXPECT_EQ(report.text(), "empty, 0 pieces, 0 vertices, 0 triangles");
}

TEST(MeshCheck, WrongIndicesAndVerticesThatAreNotFiniteAreCountedAndSkipped) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({0, 1, 0xffffffffu});
  EXPECT_EQ(check_mesh(mesh).invalid_triangles, 2u);
  EXPECT_FALSE(check_mesh(mesh).watertight());
  mesh = cube();
  mesh.vertices[7].y() = kNan;
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.invalid_triangles, 6u);
  EXPECT_FALSE(report.watertight());
}

TEST(MeshCheck, SurvivesTriangleSoup) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const MeshReport report = check_mesh(random_soup(20, 200, seed));
    EXPECT_FALSE(report.watertight());
    EXPECT_GT(report.non_manifold_edges, 0u);
  }
}

TEST(MeshCheck, SaysInWordsWhatIsWrong) {
  TriangleMesh mesh = cube();
  EXPECT_EQ(check_mesh(mesh).text(), "watertight, 1 piece, 8 vertices, 12 triangles");
  mesh.triangles.pop_back();
  EXPECT_EQ(check_mesh(mesh).text(),
            "not watertight, 3 boundary edges, 1 piece, 8 vertices, 11 triangles");
}

TEST(ValidateMesh, NamesWhatDoesNotFit) {
  TriangleMesh mesh = cube();
  EXPECT_TRUE(validate_mesh(mesh));
  EXPECT_TRUE(validate_mesh(TriangleMesh()));
  mesh.colors.resize(3);
  EXPECT_EQ(validate_mesh(mesh).error().code, ErrorCode::kFormat);
  mesh = cube();
  mesh.triangles[2][1] = 8;
  EXPECT_EQ(validate_mesh(mesh, "reference").error().message,
            "reference: triangle 2 names vertex 8, but there are only 8; repair the mesh");
  mesh = cube();
  mesh.vertices[4].x() = kNan;
  EXPECT_EQ(validate_mesh(mesh).error().code, ErrorCode::kFormat);
}

}  // namespace
}  // namespace turnscan
