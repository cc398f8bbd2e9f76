// Which axis is up in a mesh file, and that what was written comes back where it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <regex>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/random_access_file.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/io/text/number_text.hpp>
#include <turnscan/io/zip/zip_file.hpp>

#include "tests/io/mesh/meshes.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::content_of;
using testing::expect_near;
using ::testing::HasSubstr;
using testing::TempFolder;
using testing::tetrahedron;

/// 0.1 m wide and high and a third of it deep; its lowest point at this height.
TriangleMesh at_height(float height_m, float shift_m = 0.0F) {
  TriangleMesh mesh = tetrahedron(0.1F, shift_m);
  for (Vec3f& p : mesh.vertices) p.y() += height_m;
  return mesh;
}

/// The vertices of a 3MF whose items lie as its objects do. (assimp 5.2 finds no mesh in it.)
Box box_in_3mf(const std::filesystem::path& path) {
  const auto file = file::RandomAccessFile::open(path);
  const auto directory = zip::read_directory(*file, file::ReadBudget(file->size()));
  std::vector<Vec3f> points;
  for (const zip::NamedEntry& entry : directory->entries) {
    if (!entry.name.ends_with(".model")) continue;
    const std::string xml = *zip::read_entry(*file, entry.entry, 1 << 20);
    EXPECT_EQ(xml.find("transform="), std::string::npos);
    const std::regex vertex(R"re(<vertex x="([^"]*)" y="([^"]*)" z="([^"]*)")re");
    for (std::sregex_iterator at(xml.begin(), xml.end(), vertex), end; at != end; ++at) {
      Vec3f& p = points.emplace_back();
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(text::TextCursor((*at)[std::size_t(k) + 1].str()).floating(p[k]));
    }
  }
  return bounds(points);
}

/// What another program takes the file for: its box, in the file's own unit and axes.
Box box_for_others(const std::filesystem::path& path) {
  if (path.extension() == ".3mf") return box_in_3mf(path);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  EXPECT_NE(scene, nullptr) << importer.GetErrorString();
  std::vector<Vec3f> points;
  for (unsigned m = 0; scene != nullptr && m < scene->mNumMeshes; ++m)
    for (unsigned i = 0; i < scene->mMeshes[m]->mNumVertices; ++i) {
      const aiVector3D& v = scene->mMeshes[m]->mVertices[i];
      points.emplace_back(v.x, v.y, v.z);
    }
  return bounds(points);
}

TEST(WayUp, IsZInFilesForPrintersWhereTheObjectStandsOnZero) {
  const TempFolder folder;
  for (const std::string name : {"m.stl", "m.3mf"}) {
    for (const float height_m : {0.0371F, -0.25F}) {
      ASSERT_TRUE(write_mesh(folder / name, at_height(height_m, 0.02F)));
      const Box box = box_for_others(folder / name);
      EXPECT_EQ(box.min.z(), 0.0) << name;
      EXPECT_NEAR(box.max.z(), 100.0, 1e-4) << name;
      // Neither x nor the depth, which is -y now, is moved.
      EXPECT_NEAR(box.min.x(), 20.0, 1e-4) << name;
      EXPECT_NEAR(box.min.y(), -100.0 / 3.0, 1e-4) << name;
      EXPECT_NEAR(box.max.y(), 0.0, 1e-4) << name;
    }
  }
}

TEST(WayUp, PointsOfNoTriangleDoNotCount) {
  const TempFolder folder;
  TriangleMesh mesh = at_height(0.2F);
  mesh.vertices.emplace_back(0.0F, -1.0F, 0.0F);
  mesh.normals.clear();
  mesh.colors.clear();
  ASSERT_TRUE(write_mesh(folder / "m.stl", mesh));
  EXPECT_EQ(box_for_others(folder / "m.stl").min.z(), 0.0);
}

TEST(WayUp, IsYInOtherFilesUnlessZIsAskedFor) {
  const TempFolder folder;
  for (const std::string name : {"m.ply", "m.obj"}) {
    ASSERT_TRUE(write_mesh(folder / name, at_height(0.5F)));
    Box box = box_for_others(folder / name);
    EXPECT_NEAR(box.min.y(), 0.5, 1e-6) << name;
    ASSERT_TRUE(write_mesh(folder / name, at_height(0.5F), {UpAxis::kZ}));
    box = box_for_others(folder / name);
    EXPECT_NEAR(box.min.z(), 0.5, 1e-6) << name;
    EXPECT_NEAR(box.max.z(), 0.6, 1e-6) << name;
    EXPECT_NEAR(box.min.y(), -0.1 / 3.0, 1e-6) << name;
  }
  ASSERT_TRUE(write_mesh(folder / "m.stl", at_height(0.5F), {UpAxis::kY}));
  EXPECT_NEAR(box_for_others(folder / "m.stl").min.y(), 500.0, 1e-4);
}

TEST(WayUp, DoesNotChangeWhatIsReadBack) {
  const TempFolder folder;
  for (const std::string ending : {"ply", "obj", "stl", "3mf", "glb"}) {
    for (const UpAxis up : {UpAxis::kFormat, UpAxis::kY, UpAxis::kZ}) {
      if (ending == "glb" && up == UpAxis::kZ) continue;
      TriangleMesh mesh = at_height(0.0371F, 0.02F);
      const auto path = folder / ("m." + ending);
      ASSERT_TRUE(write_mesh(path, mesh, {up}));
      const auto back = read_mesh(path);
      ASSERT_TRUE(back) << ending << ": " << back.error().text();
      ASSERT_EQ(back->triangles.size(), mesh.triangles.size());
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3f& was = mesh.vertices[mesh.triangles[t][k]];
          EXPECT_LE((back->vertices[back->triangles[t][k]] - was).norm(), 2e-8F) << ending;
        }
      for (std::size_t i = 0; i < back->normals.size(); ++i)
        EXPECT_LE((back->normals[i] - mesh.normals[i]).norm(), 1e-6F) << ending;
    }
  }
}

TEST(WayUp, KeepsTheConfidenceOfVertices) {
  const TempFolder folder;
  const std::vector<float> confidence{1.0F, 2.0F, 3.0F, 4.0F};
  ASSERT_TRUE(write_mesh(folder / "m.ply", at_height(0.2F), confidence, {UpAxis::kZ}));
  EXPECT_THAT(content_of(folder / "m.ply"), HasSubstr("property float confidence"));
  EXPECT_NEAR(box_for_others(folder / "m.ply").min.z(), 0.2, 1e-6);
  expect_near(*read_mesh(folder / "m.ply"), at_height(0.2F), 1e-8F);
}

TEST(WayUp, ObjectsOfAFileForPrintersKeepTheirPlaceToEachOther) {
  const TempFolder folder;
  const std::vector<TriangleMesh> meshes{at_height(0.3F), at_height(0.1F, 0.4F)};
  ASSERT_TRUE(write_meshes(folder / "m.3mf", meshes));
  const Box box = box_for_others(folder / "m.3mf");
  EXPECT_EQ(box.min.z(), 0.0);
  EXPECT_NEAR(box.max.z(), 300.0, 1e-4);
  const auto back = read_meshes(folder / "m.3mf");
  ASSERT_TRUE(back) << back.error().text();
  for (std::size_t i = 0; i < 2; ++i) expect_near(back->at(i), meshes[i], 5e-8F);
}

TEST(WayUp, IsAlwaysYInGlb) {
  const TempFolder folder;
  const auto path = folder / "m.glb";
  for (const auto& result :
       {write_mesh(path, tetrahedron(), {UpAxis::kZ}), check_mesh_output(path, {UpAxis::kZ})}) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidOption);
    EXPECT_THAT(result.error().message, HasSubstr("y up by its standard"));
  }
  EXPECT_EQ(folder.count(), 0U);
  EXPECT_TRUE(check_mesh_output(path, {UpAxis::kY}));
}

TEST(WayUp, OfAFileFromElsewhereIsY) {
  const TempFolder folder;
  ASSERT_TRUE(write_mesh(folder / "m.stl", at_height(0.2F)));
  std::string bytes = content_of(folder / "m.stl");
  bytes.replace(0, 6, "BINARY");
  const auto back = read_mesh(folder.put("other.stl", bytes));
  ASSERT_TRUE(back);
  EXPECT_NEAR(bounds(back->vertices).min.z(), 0.0, 1e-8);
  EXPECT_NEAR(bounds(back->vertices).max.z(), 0.1, 1e-7);
}

TEST(WayUp, MarkThatIsNoneIsLeftOut) {
  const TempFolder folder;
  ASSERT_TRUE(write_mesh(folder / "m.stl", at_height(0.2F)));
  const std::string bytes = content_of(folder / "m.stl");
  const auto at = bytes.find("base at ") + 8;
  for (const char* base : {"x             ", "              ", "1,5           "}) {
    std::string damaged = bytes;
    damaged.replace(at, 14, base);
    const auto back = read_mesh(folder.put("m.stl", damaged));
    ASSERT_TRUE(back) << base;
    EXPECT_NEAR(bounds(back->vertices).max.z(), 0.1, 1e-7) << base;
  }
  for (const char* base : {"nan           ", "-inf          ", "1e300         "}) {
    std::string damaged = bytes;
    damaged.replace(at, 14, base);
    EXPECT_EQ(read_mesh(folder.put("m.stl", damaged)).error().code, ErrorCode::kFormat) << base;
  }
}

TEST(WayUp, OfACloudIsReadBackToo) {
  const TempFolder folder;
  PointCloud cloud;
  cloud.points = {{0.1F, 0.2F, 0.3F}, {-1.0F, 2.0F, -3.0F}};
  cloud.normals = {{0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, -1.0F}};
  ASSERT_TRUE(write_cloud(folder / "c.ply", cloud, UpAxis::kZ));
  EXPECT_THAT(content_of(folder / "c.ply"), HasSubstr("obj_info frame z up, base at 0\n"));
  const auto back = read_cloud(folder / "c.ply");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->cloud.points, cloud.points);
  EXPECT_EQ(back->cloud.normals, cloud.normals);
  ASSERT_TRUE(write_cloud(folder / "c.ply", cloud));
  EXPECT_EQ(content_of(folder / "c.ply").find("obj_info"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
