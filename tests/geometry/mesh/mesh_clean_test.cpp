#include <gtest/gtest.h>

#include <limits>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

TriangleMesh colored(TriangleMesh mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    mesh.colors.push_back({std::uint8_t(v), std::uint8_t(2 * v), 7});
    mesh.normals.push_back(Vec3f::UnitZ());
  }
  return mesh;
}

TEST(MergeVertices, ClosesAnStlSoup) {
  const TriangleMesh soup = as_soup(sphere(0.1, 4));
  EXPECT_FALSE(check_mesh(soup).watertight());
  const auto mesh = merge_vertices(soup);
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(check_mesh(*mesh).watertight());
  EXPECT_EQ(mesh->vertices.size(), sphere(0.1, 4).vertices.size());
}

TEST(MergeVertices, MinusZeroIsZero) {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.emplace_back(-0.0f, 0.0f, -0.0f);
  mesh.triangles[1][0] = 4;
  EXPECT_EQ(merge_vertices(mesh)->vertices.size(), 4u);
}

TEST(MergeVertices, ToleranceJoinsWhatIsNearAndDropsWhatCollapses) {
  TriangleMesh soup = as_soup(cube());
  for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
    soup.vertices[v].x() += float(1e-4 * random_value(3, v));
  }
  soup.vertices.emplace_back(0.5f, 0.5f, 0.0f);
  soup.vertices.emplace_back(0.5f, 0.5001f, 0.0f);
  soup.triangles.push_back({0, 36, 37});
  EXPECT_GT(merge_vertices(soup)->vertices.size(), 8u);
  const auto mesh = merge_vertices(soup, 1e-3);
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(check_mesh(*mesh).watertight()) << check_mesh(*mesh).text();
  EXPECT_EQ(mesh->triangles.size(), 12u);
  EXPECT_EQ(merge_vertices(soup, -1.0).error().code, ErrorCode::kInvalidOption);
}

TEST(RemoveDegenerate, DropsRepeatsCopiesAndTrianglesWithoutArea) {
  TriangleMesh mesh = colored(cube());
  const auto clean = mesh;
  mesh.triangles.push_back({1, 1, 2});
  mesh.triangles.push_back({5, 1, 0});  // a copy
  mesh.triangles.push_back({1, 5, 0});  // a copy, turned
  mesh.vertices.emplace_back(2.0f, 0.0f, 0.0f);
  mesh.colors.emplace_back();
  mesh.normals.emplace_back();
  mesh.triangles.push_back({0, 1, 8});  // on one line
  const auto rest = remove_degenerate(mesh);
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->triangles, clean.triangles);
  EXPECT_EQ(rest->vertices, clean.vertices);
  EXPECT_EQ(rest->colors, clean.colors);
  EXPECT_EQ(rest->normals, clean.normals);
}

TEST(CompactVertices, KeepsOrderAndAttributes) {
  TriangleMesh mesh = colored(plane(3));
  mesh.triangles = {{9, 4, 5}};
  mesh.vertices[0] = Vec3f::Constant(std::numeric_limits<float>::quiet_NaN());
  TriangleMesh rest = mesh;
  mesh::compact_vertices(rest);
  EXPECT_EQ(rest.vertices,
            (std::vector<Vec3f>{mesh.vertices[4], mesh.vertices[5], mesh.vertices[9]}));
  EXPECT_EQ(rest.colors, (std::vector<Rgb>{mesh.colors[4], mesh.colors[5], mesh.colors[9]}));
  EXPECT_EQ(rest.triangles, (std::vector<std::array<std::uint32_t, 3>>{{2, 0, 1}}));
}

TEST(SplitComponents, GivesThePiecesLargestFirst) {
  TriangleMesh mesh = tetrahedron();
  TriangleMesh far = sphere(1.0, 2);
  move(far, Vec3f(5, 0, 0));
  append(mesh, far);
  mesh = colored(mesh);
  mesh.name = "two";
  const auto parts = split_components(mesh);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ((*parts)[0].triangles.size(), far.triangles.size());
  EXPECT_EQ((*parts)[1].vertices, tetrahedron().vertices);
  EXPECT_EQ((*parts)[1].triangles, tetrahedron().triangles);
  EXPECT_EQ((*parts)[0].colors[0], mesh.colors[4]);
  EXPECT_EQ((*parts)[1].name, "two");
  for (const TriangleMesh& part : *parts) EXPECT_TRUE(check_mesh(part).watertight());
  EXPECT_TRUE(split_components(TriangleMesh())->empty());
}

TEST(JoinMeshes, IsTheInverseOfSplit) {
  TriangleMesh far = sphere(1.0, 2);
  move(far, Vec3f(5, 0, 0));
  const TriangleMesh joined = join_meshes({colored(far), TriangleMesh(), colored(cube())});
  EXPECT_EQ(joined.vertices.size(), far.vertices.size() + 8);
  EXPECT_EQ(joined.colors.size(), joined.vertices.size());
  const auto parts = split_components(joined);
  ASSERT_TRUE(parts);
  EXPECT_EQ((*parts)[1].triangles, cube().triangles);
  EXPECT_TRUE(join_meshes({colored(far), cube()}).colors.empty());
}

TEST(VertexNormals, OfASpherePointOutward) {
  TriangleMesh mesh = sphere(2.0, 4);
  mesh.vertices.emplace_back(0.0f, 0.0f, 0.0f);
  const auto normals = vertex_normals(mesh);
  for (std::size_t v = 0; v + 1 < normals.size(); ++v) {
    ASSERT_GT(normals[v].dot(mesh.vertices[v].normalized()), 0.999f);
  }
  EXPECT_EQ(normals.back(), Vec3f::Zero());
}

TEST(MeshRepair, EveryStepRefusesBrokenMeshesAndPassesEmptyOnes) {
  TriangleMesh wrong_index = cube(), not_finite = cube();
  wrong_index.triangles[3][2] = 8;
  not_finite.vertices[3].x() = std::numeric_limits<float>::quiet_NaN();
  const auto code = [](const auto& result) {
    return result ? std::string("success") : std::string(name_of(result.error().code));
  };
  const RunContext context;
  for (const TriangleMesh& mesh : {wrong_index, not_finite}) {
    EXPECT_EQ(code(merge_vertices(mesh)), "format");
    EXPECT_EQ(code(remove_degenerate(mesh)), "format");
    EXPECT_EQ(code(split_components(mesh)), "format");
    EXPECT_EQ(code(orient_consistently(mesh)), "format");
    EXPECT_EQ(code(orient_outward(mesh)), "format");
    EXPECT_EQ(code(make_manifold(mesh)), "format");
    EXPECT_EQ(code(relax(mesh, {}, {}, context)), "format");
  }
  const TriangleMesh empty;
  EXPECT_EQ(code(merge_vertices(empty)), "success");
  EXPECT_EQ(code(remove_degenerate(empty)), "success");
  EXPECT_EQ(code(orient_outward(empty)), "success");
  EXPECT_EQ(code(make_manifold(empty)), "success");
  EXPECT_EQ(code(relax(empty, {}, {}, context)), "success");
}

}  // namespace
}  // namespace turnscan
