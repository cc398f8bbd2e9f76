// Textures through the formats that hold them.
#include <gtest/gtest.h>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <fstream>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/io/mesh/texture_block.hpp>

#include "tests/io/mesh/meshes.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;
using testing::tetrahedron;

TriangleMesh textured(float shift = 0.0F) {
  TriangleMesh mesh = tetrahedron(0.1F, shift);
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(20, 12);
  for (std::size_t i = 0; i < texture->image.pixels.size(); ++i)
    texture->image.pixels[i] = {std::uint8_t(i), std::uint8_t(3 * i), std::uint8_t(200 - i)};
  for (int t = 0; t < 4; ++t) {
    const Eigen::Vector2f at(0.25F + 0.25F * float(t % 2), 0.125F + 0.5F * float(t / 2));
    texture->corners.push_back(
        {at, at + Eigen::Vector2f(0.25F, 0.0F), at + Eigen::Vector2f(0.125F, 0.25F)});
  }
  mesh.texture = std::move(texture);
  return mesh;
}

/// Vertices may have been renumbered.
void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_TRUE(has_texture(a));
  EXPECT_EQ(a.texture->image.pixels, b.texture->image.pixels);
  EXPECT_EQ(a.vertices.size(), b.vertices.size()) << "seams are open";
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT((a.vertices[a.triangles[t][k]] - b.vertices[b.triangles[t][k]]).norm(), 1e-6F);
      EXPECT_LT((a.texture->corners[t][k] - b.texture->corners[t][k]).norm(), 1e-5F);
    }
}

TEST(MeshTextures, ComeBackFromGlbObjAnd3mf) {
  for (const std::string ending : {"glb", "obj", "3mf"}) {
    const TempFolder folder;
    const TriangleMesh mesh = textured();
    ASSERT_TRUE(write_mesh(folder / ("m." + ending), mesh));
    const auto back = read_meshes(folder / ("m." + ending));
    ASSERT_TRUE(back) << back.error().text();
    ASSERT_EQ(back->size(), 1U) << ending;
    expect_same(back->front(), mesh);
  }
}

TEST(MeshTextures, EachObjectHasItsOwn) {
  for (const std::string ending : {"glb", "obj", "3mf"}) {
    const TempFolder folder;
    const std::vector<TriangleMesh> meshes{textured(), tetrahedron(0.2F, 1.0F), textured(2.0F)};
    ASSERT_TRUE(write_meshes(folder / ("m." + ending), meshes));
    const auto back = read_meshes(folder / ("m." + ending));
    ASSERT_TRUE(back) << back.error().text();
    ASSERT_EQ(back->size(), 3U);
    EXPECT_TRUE(has_texture(back->at(0))) << ending;
    EXPECT_FALSE(has_texture(back->at(1)));
    EXPECT_TRUE(has_texture(back->at(2)));
  }
}

TEST(MeshTextures, AreSeenByAssimp) {
  const TempFolder folder;
  const TriangleMesh mesh = textured();
  for (const std::string ending : {"glb", "obj"}) {
    const auto path = folder / ("m." + ending);
    ASSERT_TRUE(write_mesh(path, mesh));
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path.string(), aiProcess_ValidateDataStructure);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    EXPECT_EQ(scene->mFlags & AI_SCENE_FLAGS_VALIDATION_WARNING, 0U);
    ASSERT_EQ(scene->mNumMeshes, 1U);
    const aiMesh& read = *scene->mMeshes[0];
    ASSERT_TRUE(read.HasTextureCoords(0)) << ending;
    const aiMaterial& material = *scene->mMaterials[read.mMaterialIndex];
    EXPECT_EQ(material.GetTextureCount(aiTextureType_DIFFUSE), 1U) << ending;
    // assimp counts from the lower edge.
    for (unsigned t = 0; t < read.mNumFaces; ++t)
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& uv = read.mTextureCoords[0][read.mFaces[t].mIndices[k]];
        EXPECT_NEAR(uv.x, mesh.texture->corners[t][k].x(), 1e-5F);
        EXPECT_NEAR(uv.y, 1.0F - mesh.texture->corners[t][k].y(), 1e-5F) << ending;
      }
  }
}

TEST(MeshTextures, StlAndPlyHaveNone) {
  EXPECT_FALSE(holds_textures("m.stl"));
  EXPECT_FALSE(holds_textures("m.ply"));
  EXPECT_TRUE(holds_textures("M.GLB"));
}

TEST(MeshTextures, AShapeIsWholeWithoutItsPicture) {
  const TempFolder folder;
  ASSERT_TRUE(write_mesh(folder / "m.obj", textured()));
  EXPECT_EQ(texture_files(folder / "m.obj", std::vector{textured()}).size(), 2U);
  { std::ofstream(folder / "m.png") << "not a picture"; }
  const auto damaged = read_mesh(folder / "m.obj");
  ASSERT_TRUE(damaged) << damaged.error().text();
  EXPECT_EQ(damaged->texture, nullptr);
  std::filesystem::remove(folder / "m.mtl");
  const auto without = read_mesh(folder / "m.obj");
  ASSERT_TRUE(without);
  EXPECT_EQ(without->triangles.size(), 4U);
}

TEST(MeshTextures, PicturesElsewhereAreNotLookedAt) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "in");
  ASSERT_TRUE(write_mesh(folder / "m.obj", textured()));
  ASSERT_TRUE(write_mesh(folder / "in" / "m.obj", textured()));
  { std::ofstream(folder / "in" / "m.mtl") << "newmtl texture1\nmap_Kd ../m.png\n"; }
  EXPECT_EQ(read_mesh(folder / "in" / "m.obj")->texture, nullptr);
  {
    std::ofstream(folder / "in" / "m.mtl")
        << "newmtl texture1\nmap_Kd " << (folder / "m.png").string();
  }
  EXPECT_EQ(read_mesh(folder / "in" / "m.obj")->texture, nullptr);
}

TEST(MeshTextures, ABlockThatIsCutShortIsRefused) {
  TriangleMesh mesh = tetrahedron();
  for (const std::string text : {"texture ", "texture 9 \n", "texture 65535 65535\n",
                                 "texture 1 1\nabc", "texture -1 4\n", "texture 4 4"}) {
    std::string_view bytes = text;
    EXPECT_FALSE(mesh_io::take_texture_block(bytes, mesh)) << text;
  }
  std::string_view other = "ply\n";
  EXPECT_TRUE(mesh_io::take_texture_block(other, mesh));
  EXPECT_EQ(other, "ply\n");
}

}  // namespace
}  // namespace turnscan
