#include <gtest/gtest.h>

#include <turnscan/core/mesh_texture.hpp>

namespace turnscan {
namespace {

/// A closed tetrahedron; each triangle has a quarter of the picture of its own, so all its edges
/// are seams.
TriangleMesh textured() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}};
  mesh.colors = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(8, 8);
  for (std::size_t i = 0; i < 64; ++i)
    texture->image.pixels[i] = {std::uint8_t(4 * i), std::uint8_t(255 - i), std::uint8_t(i)};
  for (int t = 0; t < 4; ++t) {
    const Eigen::Vector2f at(0.5f * float(t % 2), 0.5f * float(t / 2));
    texture->corners.push_back(
        {at, at + Eigen::Vector2f(0.4f, 0.0f), at + Eigen::Vector2f(0.0f, 0.4f)});
  }
  mesh.texture = std::move(texture);
  return mesh;
}

TEST(MeshTexture, IsLostWhenTheTrianglesAreOthers) {
  TriangleMesh mesh = textured();
  EXPECT_TRUE(has_texture(mesh));
  mesh.triangles.pop_back();
  EXPECT_FALSE(has_texture(mesh));
  EXPECT_FALSE(has_texture(TriangleMesh()));
}

TEST(MeshTexture, GivesThePixelsAtTheirCentresAndTheirMeansBetween) {
  const TriangleMesh mesh = textured();
  const ColorImage& image = mesh.texture->image;
  const Vec3f middle = texture_at(image, {2.5f / 8, 3.5f / 8});
  EXPECT_NEAR(middle.x(), 4 * 26, 1e-3f);
  EXPECT_NEAR(texture_at(image, {3.0f / 8, 3.5f / 8}).x(), 4 * 26.5f, 1e-3f);
  EXPECT_NEAR(texture_at(image, {2.5f / 8, 4.0f / 8}).z(), 30.0f, 1e-3f);
  EXPECT_LT((texture_at(image, {1.0f + 2.5f / 8, 3.5f / 8 - 2.0f}) - middle).norm(), 1e-2f);
}

TEST(MeshTexture, SplittingItsSeamsAndWeldingThemGivesTheMeshAgain) {
  const TriangleMesh mesh = textured();
  SplitMesh split = split_at_seams(mesh);
  EXPECT_EQ(split.mesh.vertices.size(), 12u);
  ASSERT_EQ(split.uvs.size(), 12u);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(split.uvs[split.mesh.triangles[t][k]], mesh.texture->corners[t][k]);
      EXPECT_EQ(split.mesh.vertices[split.mesh.triangles[t][k]],
                mesh.vertices[mesh.triangles[t][k]]);
    }
  split.mesh.texture = mesh.texture;
  weld_seams(split.mesh);
  EXPECT_EQ(split.mesh.vertices.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = split.mesh.triangles[t][k];
      EXPECT_EQ(split.mesh.vertices[v], mesh.vertices[mesh.triangles[t][k]]);
      EXPECT_EQ(split.mesh.colors[v], mesh.colors[mesh.triangles[t][k]]);
    }
}

}  // namespace
}  // namespace turnscan
