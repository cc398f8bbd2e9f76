#include <gtest/gtest.h>

#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

void turn_some(TriangleMesh& mesh, std::uint64_t seed) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (random_value(seed, t) > 0.0) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  }
}

TEST(Orient, TurnsAShuffledSphereOutward) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    TriangleMesh mesh = sphere(0.1, 3, Vec3d(5, 5, 5));
    TriangleMesh other = torus(0.5, 0.1, 20, 10);
    append(mesh, other);
    turn_some(mesh, seed);
    EXPECT_FALSE(check_mesh(mesh).oriented);
    EXPECT_TRUE(check_mesh(*orient_consistently(mesh)).oriented);
    EXPECT_TRUE(check_mesh(*orient_outward(mesh)).watertight());
  }
}

TEST(Orient, TurnsAnInsideOutMesh) {
  TriangleMesh mesh = cube();
  flip(mesh);
  EXPECT_TRUE(check_mesh(*orient_outward(mesh)).watertight());
}

TEST(Orient, AnOpenBowlFacesAwayFromItsMiddle) {
  TriangleMesh bowl = sphere(1.0, 4);
  std::erase_if(bowl.triangles, [&](const auto& t) { return bowl.vertices[t[0]].z() > 0.2f; });
  const TriangleMesh outward = bowl;
  flip(bowl);
  const auto turned = orient_outward(bowl);
  ASSERT_TRUE(turned);
  const auto normals = vertex_normals(*turned), expected = vertex_normals(outward);
  EXPECT_GT(normals[5].dot(expected[5]), 0.99f);
}

TEST(MakeManifold, LeavesAManifoldAsItIs) {
  for (const TriangleMesh& mesh : {sphere(1.0, 3), torus(1.0, 0.3, 12, 8), plane(5)}) {
    const auto result = make_manifold(mesh);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->vertices, mesh.vertices);
    EXPECT_EQ(result->triangles, mesh.triangles);
  }
}

void expect_manifold(const TriangleMesh& mesh) {
  const MeshReport report = check_mesh(mesh);
  ASSERT_TRUE(report.manifold && report.oriented) << report.text();
}

TEST(MakeManifold, SeparatesSolidsThatTouchAtAVertex) {
  TriangleMesh mesh = tetrahedron();
  TriangleMesh other = tetrahedron();
  move(other, Vec3f(-1, 0, 0));
  append(mesh, other);
  const auto cut = make_manifold(*merge_vertices(mesh));
  ASSERT_TRUE(cut);
  EXPECT_EQ(check_mesh(*cut).components, 2);
  EXPECT_TRUE(check_mesh(*cut).watertight());
}

TEST(MakeManifold, SeparatesBoxesThatTouchAlongAnEdge) {
  TriangleMesh mesh = cube();
  TriangleMesh other = cube();
  move(other, Vec3f(1, 1, 0));
  append(mesh, other);
  const auto merged = merge_vertices(mesh);
  EXPECT_EQ(check_mesh(*merged).non_manifold_edges, 1u);
  const auto cut = make_manifold(*merged);
  ASSERT_TRUE(cut);
  expect_manifold(*cut);
  EXPECT_TRUE(check_mesh(*cut).closed) << "every triangle finds a partner";
  EXPECT_NEAR(check_mesh(*cut).volume_m3, 2.0, 1e-6);
  EXPECT_NEAR(check_mesh(*cut).area_m2, 12.0, 1e-6);
}

TEST(MakeManifold, KeepsTheSmoothestPairOfAFinOnASheet) {
  TriangleMesh mesh = plane(2);  // z = 0; a fin on the edge between vertices 4 and 5
  mesh.vertices.emplace_back(0.75f, 0.5f, 1.0f);
  mesh.triangles.push_back({4, 5, 9});
  const auto cut = make_manifold(mesh);
  ASSERT_TRUE(cut);
  expect_manifold(*cut);
  const auto parts = split_components(*cut);
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ((*parts)[0].triangles.size(), 8u) << "the sheet stays whole";
  EXPECT_EQ((*parts)[1].triangles.size(), 1u);
}

TEST(MakeManifold, MakesDistinctEdgesOfTwoThatShareBothEnds) {
  // Two tubes of three triangles side by side, pinched together along one edge that stays one fan
  // at both of its ends.
  TriangleMesh mesh = torus(1.0, 0.4, 3, 8);
  // Identify two distant parallel edges of the tube's cross sections.
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      if (v == 4) v = 0;
      if (v == 12) v = 8;
    }
  }
  EXPECT_GT(check_mesh(mesh).non_manifold_edges, 0u);
  const auto cut = make_manifold(mesh);
  ASSERT_TRUE(cut);
  expect_manifold(*cut);
  EXPECT_NEAR(check_mesh(*cut).area_m2, check_mesh(mesh).area_m2, 1e-5) << "nothing is dropped";
}

TEST(MakeManifold, CutsAMoebiusStrip) {
  TriangleMesh strip;
  const std::uint32_t n = 12;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n, half = u / 2.0;
    const Vec3d along(std::cos(u), std::sin(u), 0.0);
    const Vec3d across = std::cos(half) * along + std::sin(half) * Vec3d::UnitZ();
    strip.vertices.push_back((along - 0.3 * across).cast<float>());
    strip.vertices.push_back((along + 0.3 * across).cast<float>());
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const std::uint32_t c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  EXPECT_EQ(check_mesh(strip).non_manifold_edges, 0u);
  EXPECT_FALSE(check_mesh(*orient_consistently(strip)).oriented) << "it has one side";
  const auto cut = make_manifold(*orient_consistently(strip));
  ASSERT_TRUE(cut);
  expect_manifold(*cut);
  EXPECT_EQ(cut->triangles.size(), strip.triangles.size());
}

TEST(MakeManifold, EndsOnAnySoup) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::size_t vertices = 3 + seed % 20;
    const TriangleMesh soup = random_soup(vertices, 1 + 7 * (seed % 60), seed);
    const auto cut = make_manifold(soup);
    ASSERT_TRUE(cut);
    expect_manifold(*cut);
    const auto clean = remove_degenerate(soup);
    const auto clean_cut = make_manifold(*orient_consistently(*clean));
    ASSERT_TRUE(clean_cut);
    expect_manifold(*clean_cut);
    EXPECT_NEAR(check_mesh(*clean_cut).area_m2, check_mesh(*clean).area_m2,
                1e-4 * check_mesh(*clean).area_m2)
        << "seed " << seed;
  }
}

TEST(MakeManifold, EndsOnThousandsOfTrianglesAroundOneEdge) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < 5000; ++i) {
    mesh.vertices.emplace_back(std::cos(0.01f * float(i)), std::sin(0.01f * float(i)), 0.5f);
    mesh.triangles.push_back({0, 1, i + 2});
    if (i % 2 != 0) std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);
  }
  const auto cut = make_manifold(mesh);
  ASSERT_TRUE(cut);
  expect_manifold(*cut);
  EXPECT_EQ(cut->triangles.size(), 5000u);
}

}  // namespace
}  // namespace turnscan
