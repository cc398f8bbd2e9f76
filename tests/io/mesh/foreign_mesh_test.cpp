// Meshes that are read in a child process: 3MF, GLB, and whatever assimp knows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>
#include <turnscan/io/mesh/mesh_convert.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "tests/io/bytes.hpp"
#include "tests/io/mesh/meshes.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::content_of;
using testing::expect_near;
using ::testing::HasSubstr;
using testing::raw;
using testing::TempFolder;
using testing::tetrahedron;

std::vector<TriangleMesh> three_meshes() {
  std::vector<TriangleMesh> meshes{tetrahedron(), tetrahedron(0.2F, 1.0F), tetrahedron(3.0F)};
  meshes[0].name = "a <&\"'> b";
  meshes[1].colors.clear();
  meshes[2].normals.clear();
  meshes[2].name = "M\xc3\xbcnze\xff";
  return meshes;
}

TEST(Mesh3mf, KeepsObjectsNamesAndColours) {
  const TempFolder folder;
  const auto meshes = three_meshes();
  ASSERT_TRUE(write_meshes(folder / "m.3mf", meshes));
  const auto back = read_meshes(folder / "m.3mf");
  ASSERT_TRUE(back) << back.error().text();
  ASSERT_EQ(back->size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_near(back->at(i), meshes[i], 1e-6F);  // the file has 6 decimals of a millimetre
    EXPECT_EQ(back->at(i).colors, meshes[i].colors) << i;
  }
  EXPECT_EQ(back->at(0).name, "a <&\"'> b");
  EXPECT_EQ(back->at(1).name, "");
  EXPECT_EQ(back->at(2).name, "M\xc3\xbcnze?");
}

TEST(Mesh3mf, UnitMayBeOverruled) {
  const TempFolder folder;
  ASSERT_TRUE(write_mesh(folder / "m.3mf", tetrahedron()));
  EXPECT_NEAR(read_mesh(folder / "m.3mf")->vertices[1].x(), 0.1F, 1e-6F);
  EXPECT_NEAR(read_mesh(folder / "m.3mf", {1.0})->vertices[1].x(), 100.0F, 1e-4F);
}

TEST(Mesh3mf, DegenerateTrianglesAreLeftOut) {
  const TempFolder folder;
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.insert(mesh.triangles.begin() + 1, {2, 2, 3});
  ASSERT_TRUE(write_mesh(folder / "m.3mf", mesh));
  const auto back = read_mesh(folder / "m.3mf");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->triangles, tetrahedron().triangles);
  EXPECT_EQ(back->colors, mesh.colors);
  mesh.triangles = {{{2, 2, 3}}};
  EXPECT_EQ(write_mesh(folder / "n.3mf", mesh).error().code, ErrorCode::kLibrary);
  EXPECT_EQ(folder.count(), 1U);
}

TEST(MeshGlb, KeepsEverything) {
  const TempFolder folder;
  const auto meshes = three_meshes();
  ASSERT_TRUE(write_meshes(folder / "m.glb", meshes));
  const auto back = read_meshes(folder / "m.glb");
  ASSERT_TRUE(back) << back.error().text();
  ASSERT_EQ(back->size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back->at(i).vertices, meshes[i].vertices) << i;
    EXPECT_EQ(back->at(i).triangles, meshes[i].triangles) << i;
    EXPECT_EQ(back->at(i).normals, meshes[i].normals) << i;
    EXPECT_EQ(back->at(i).colors, meshes[i].colors) << i;
  }
  EXPECT_EQ(back->at(0).name, "a <&\"'> b");
  EXPECT_EQ(back->at(2).name, "M\xc3\xbcnze?");
}

/// A GLB file of this JSON and binary part.
std::string glb(const nlohmann::json& json, std::string binary) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string chunks = raw(static_cast<std::uint32_t>(text.size())) + "JSON" + text;
  if (!binary.empty())
    chunks += raw(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
  return "glTF" + raw(2U) + raw(static_cast<std::uint32_t>(chunks.size() + 12)) + chunks;
}

/// One triangle (0 0 0, 1 0 0, 0 1 0) with indices 0 1 2 of 16 bits.
nlohmann::json triangle_json() {
  return nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "n"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36, "byteOffset": 0},
                    {"buffer": 0, "byteLength": 6, "byteOffset": 36}],
    "buffers": [{"byteLength": 44}]})");
}

std::string triangle_bytes() {
  std::string bytes;
  for (const float v : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) bytes += raw(v);
  for (const std::uint16_t i : {0, 1, 2}) bytes += raw(i);
  return bytes + std::string(2, '\0');
}

Result<TriangleMesh> read_glb(const nlohmann::json& json) {
  TURNSCAN_ASSIGN(auto meshes, mesh_io::decode_glb(glb(json, triangle_bytes())));
  if (meshes.size() != 1) return fail(ErrorCode::kFormat, "{} meshes", meshes.size());
  return meshes.front();
}

std::string glb_error(const nlohmann::json& json) {
  const auto mesh = read_glb(json);
  return mesh ? "no error" : mesh.error().message;
}

TEST(MeshGlb, NodesMoveTheirMeshes) {
  auto json = triangle_json();
  ASSERT_TRUE(read_glb(json)) << glb_error(json);
  json["nodes"][0]["translation"] = {10, 20, 30};
  json["nodes"][0]["rotation"] = {0, 0, 0.7071067811865476, 0.7071067811865476};  // 90 deg about z
  json["nodes"][0]["scale"] = {2, 3, 4};
  auto mesh = read_glb(json);
  ASSERT_TRUE(mesh);
  EXPECT_LT((mesh->vertices[1] - Vec3f(10, 22, 30)).norm(), 1e-5F);
  EXPECT_LT((mesh->vertices[2] - Vec3f(7, 20, 30)).norm(), 1e-5F);
  json = triangle_json();
  json["nodes"].push_back(json["nodes"][0]);
  json["nodes"][0] = {{"children", {1}},
                      {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}};
  json["nodes"][1]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  mesh = read_glb(json);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertices[1], Vec3f(5, 7, 7));
}

TEST(MeshGlb, MirroredMeshesAreTurnedInsideOut) {
  auto json = triangle_json();
  json["nodes"][0]["scale"] = {-1, 1, 1};
  const auto mesh = read_glb(json);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles[0], (std::array<std::uint32_t, 3>{0, 2, 1}));
}

TEST(MeshGlb, MissingIndicesStripsAndFansAreRead) {
  auto json = triangle_json();
  auto& primitive = json["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  for (const int mode : {4, 5, 6}) {
    primitive["mode"] = mode;
    EXPECT_EQ(read_glb(json)->triangles.size(), 1U) << mode;
  }
  primitive["mode"] = 1;  // lines
  EXPECT_TRUE(read_glb(json)->triangles.empty());
}

TEST(MeshGlb, DamagedFilesAreRefused) {
  const auto with = [](const std::string& pointer, const nlohmann::json& value) {
    auto json = triangle_json();
    json[nlohmann::json::json_pointer(pointer)] = value;
    return glb_error(json);
  };
  EXPECT_THAT(with("/accessors/0/count", 4), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/accessors/0/count", 0x80000000U), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/accessors/0/byteOffset", 4), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/accessors/0/byteOffset", 0xfffffffffffffffcU), HasSubstr("no valid"));
  EXPECT_THAT(with("/accessors/0/type", "VEC2"), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/accessors/1/componentType", 5122), HasSubstr("no valid indices"));
  EXPECT_THAT(with("/accessors/1/componentType", 5125), HasSubstr("no valid indices"));
  EXPECT_THAT(with("/accessors/0/bufferView", 9), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/bufferViews/0/byteLength", 1000), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/bufferViews/0/byteOffset", 44), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/bufferViews/0/byteStride", 200), HasSubstr("no valid positions"));
  EXPECT_THAT(with("/nodes/0/mesh", 5), HasSubstr("does not exist"));
  EXPECT_THAT(with("/scenes/0/nodes/0", 5), HasSubstr("does not exist"));
  EXPECT_THAT(with("/scenes/0/nodes", {0, 0}), HasSubstr("two parents"));
  EXPECT_THAT(with("/nodes/0/children", {0}), HasSubstr("two parents"));
  EXPECT_THAT(with("/buffers/0/byteLength", 4000), HasSubstr("damaged"));
  EXPECT_THAT(with("/buffers/0/uri", "/etc/passwd"), HasSubstr("damaged"));
  nlohmann::json deep = 1;
  for (int i = 0; i < 100; ++i) deep = nlohmann::json::array({deep});
  EXPECT_THAT(with("/asset/extras", deep), HasSubstr("too deeply nested"));
  const std::string good = glb(triangle_json(), triangle_bytes());
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_FALSE(mesh_io::decode_glb(good.substr(0, length))) << length;
}

TEST(MeshGlb, IndexOutOfRangeIsRefused) {
  std::string bytes = triangle_bytes();
  bytes[40] = 3;
  const auto meshes = mesh_io::decode_glb(glb(triangle_json(), bytes));
  ASSERT_FALSE(meshes);
  EXPECT_THAT(meshes.error().message, HasSubstr("out of range"));
}

const std::string_view kCollada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.01" name="centimeter"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 100 0 0 0 100 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="part"><translate>0 0 50</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

TEST(ForeignMesh, ColladaTellsItsUnit) {
  const TempFolder folder;
  const auto mesh = read_mesh(folder.put("m.dae", kCollada));
  ASSERT_TRUE(mesh) << mesh.error().text();
  ASSERT_EQ(mesh->vertices.size(), 3U);
  EXPECT_LT((mesh->vertices[1] - Vec3f(1, 0, 0.5F)).norm(), 1e-6F);
  EXPECT_EQ(mesh->triangles.size(), 1U);
}

TEST(ForeignMesh, DamagedUnknownAndMissingFilesAreErrors) {
  const TempFolder folder;
  EXPECT_EQ(read_meshes(folder / "none.3mf").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_meshes(folder / "none.dae").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_meshes(folder.put("m.xyzzy", "something")).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(read_meshes(folder.put("m.dae", "<COLLADA")).error().code, ErrorCode::kFormat);
  EXPECT_EQ(read_meshes(folder.put("m.glb", "glTF")).error().code, ErrorCode::kFormat);
  EXPECT_EQ(read_meshes(folder.put("m.3mf", "PK")).error().code, ErrorCode::kFormat);
  std::filesystem::create_directory(folder / "d.3mf");
  EXPECT_EQ(read_meshes(folder / "d.3mf").error().code, ErrorCode::kIo);
}

TEST(ForeignMesh, ErrorNamesTheFile) {
  const TempFolder folder;
  const auto path = folder.put("m.glb", "glTF");
  EXPECT_THAT(read_meshes(path).error().text(), ::testing::StartsWith(path.string() + ": "));
}

TEST(ForeignMesh, HeaderThatMakesAssimpTakeGigabytesHitsTheLimit) {
  // assimp 5.2.5 allocates what the header of a PLY promises; this name sends it there.
  if (testing::kSanitized)
    GTEST_SKIP() << "a sanitizer's shadow memory leaves no room for the limit";
  const TempFolder folder;
  std::string text = "ply\nformat ascii 1.0\nelement vertex 300000000\n";
  text += "property float x\nproperty float y\nproperty float z\nelement face 300000000\n";
  text += "property list uchar int vertex_indices\nend_header\n0 0 0\n";
  const auto meshes = read_meshes(folder.put("m.plyx", text));
  ASSERT_FALSE(meshes);
  EXPECT_EQ(meshes.error().code, ErrorCode::kResourceLimit) << meshes.error().text();
}

TEST(ForeignMesh, CancelledReaderIsCancelled) {
  const TempFolder folder;
  const auto path = folder.put("m.dae", kCollada);
  const RunContext ctx;
  ctx.cancel();
  EXPECT_EQ(mesh_io::read_in_child(path, std::nullopt, ctx).error().code, ErrorCode::kCancelled);
}

TEST(ForeignMesh, ReaderThatTakesTooLongHitsTheLimit) {
  const TempFolder folder;
  const auto path = folder.put("m.dae", kCollada);
  const auto program = folder.put("turnscan-mesh-convert", "#!/bin/sh\nsleep 600\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  ::setenv("TURNSCAN_LIBEXEC", folder.path().c_str(), 1);
  const auto meshes = mesh_io::read_in_child(path, std::nullopt, {}, 0.05);
  ::unsetenv("TURNSCAN_LIBEXEC");
  ASSERT_FALSE(meshes);
  EXPECT_EQ(meshes.error().code, ErrorCode::kResourceLimit);
}

TEST(ForeignMesh, ReaderThatCrashesMeansADamagedFile) {
  const TempFolder folder;
  const auto path = folder.put("m.dae", kCollada);
  const auto program = folder.put("turnscan-mesh-convert", "#!/bin/sh\nkill -SEGV $$\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  ::setenv("TURNSCAN_LIBEXEC", folder.path().c_str(), 1);
  const auto meshes = read_meshes(path);
  ::unsetenv("TURNSCAN_LIBEXEC");
  ASSERT_FALSE(meshes);
  EXPECT_EQ(meshes.error().code, ErrorCode::kFormat);
  EXPECT_THAT(meshes.error().text(), HasSubstr("crashed (signal 11)"));
}

TEST(ForeignMesh, MissingReaderIsToldApartFromADamagedFile) {
  const TempFolder folder;
  const auto path = folder.put("m.dae", kCollada);
  ::setenv("TURNSCAN_LIBEXEC", folder.path().c_str(), 1);
  const auto meshes = read_meshes(path);
  ::unsetenv("TURNSCAN_LIBEXEC");
  ASSERT_FALSE(meshes);
  EXPECT_EQ(meshes.error().code, ErrorCode::kMissingData);
  EXPECT_THAT(meshes.error().message, HasSubstr("TURNSCAN_LIBEXEC"));
}

}  // namespace
}  // namespace turnscan
