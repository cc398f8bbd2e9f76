#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "tests/io/bytes.hpp"
#include "tests/io/mesh/meshes.hpp"
#include "tests/io/scarcity.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using ::testing::ElementsAre;
using testing::expect_near;
using ::testing::HasSubstr;
using testing::raw;
using testing::TempFolder;
using testing::tetrahedron;
using Triangle = std::array<std::uint32_t, 3>;

/// Reads `content` as a file of that name.
Result<std::vector<TriangleMesh>> read_text(std::string_view name, std::string_view content,
                                            const ReadMeshOptions& options = {}) {
  const TempFolder folder;
  return read_meshes(folder.put(name, content), options);
}

std::string error_of(std::string_view name, std::string_view content) {
  const auto meshes = read_text(name, content);
  if (meshes) return "no error";
  return std::string(name_of(meshes.error().code)) + ": " + meshes.error().text();
}

TEST(MeshPly, KeepsEverything) {
  const TempFolder folder;
  TriangleMesh mesh = tetrahedron();
  mesh.name = "letter A\nwith a second line";
  ASSERT_TRUE(write_mesh(folder / "m.PLY", mesh));
  const auto back = read_mesh(folder / "m.PLY");
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(back->vertices, mesh.vertices);
  EXPECT_EQ(back->triangles, mesh.triangles);
  EXPECT_EQ(back->normals, mesh.normals);
  EXPECT_EQ(back->colors, mesh.colors);
  EXPECT_EQ(back->name, "letter A with a second line");
}

TEST(MeshPly, SeveralMeshesAreJoined) {
  const TempFolder folder;
  std::vector<TriangleMesh> meshes{tetrahedron(), tetrahedron(0.2F, 1.0F)};
  meshes[1].normals.clear();
  ASSERT_TRUE(write_meshes(folder / "m.ply", meshes));
  const auto back = read_mesh(folder / "m.ply");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->vertices.size(), 8U);
  EXPECT_EQ(back->triangles[4], (Triangle{4, 6, 5}));
  EXPECT_EQ(back->colors.size(), 8U);
  EXPECT_TRUE(back->normals.empty());
}

const std::string kPlyStart =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 2\nproperty uchar flags\nproperty list uchar int vertex_index\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 2 0\n";

TEST(MeshPly, PolygonsBecomeFans) {
  const auto meshes = read_text("m.ply", kPlyStart + "9 5 0 1 2 3 4\n9 3 4 3 2\n");
  ASSERT_TRUE(meshes) << meshes.error().text();
  EXPECT_THAT(meshes->front().triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3},
                                                     Triangle{0, 3, 4}, Triangle{4, 3, 2}));
}

TEST(MeshPly, IndicesOutOfRangeAreRefused) {
  EXPECT_THAT(error_of("m.ply", kPlyStart + "9 3 0 1 5\n9 3 0 1 2\n"), HasSubstr("out of range"));
  EXPECT_THAT(error_of("m.ply", kPlyStart + "9 3 0 1 -1\n9 3 0 1 2\n"), HasSubstr("out of range"));
  EXPECT_THAT(error_of("m.ply", kPlyStart + "9 3 0 1 4294967296\n9 3 0 1 2\n"),
              HasSubstr("out of range"));
}

TEST(MeshPly, CloudIsNoMesh) {
  EXPECT_THAT(error_of("m.ply", kPlyStart + "9 0\n9 2 0 1\n"), HasSubstr("too-few-points: "));
}

TEST(MeshPly, CoordinatesThatAreNotFiniteAreRefused) {
  std::string text = kPlyStart + "9 3 0 1 2\n9 3 0 1 2\n";
  text.replace(text.find("1 1 0"), 5, "1 nan 0");
  EXPECT_THAT(error_of("m.ply", text), HasSubstr("coordinates of vertex 2 are not finite"));
}

TEST(MeshStl, KeepsTheMeshInMillimetres) {
  const TempFolder folder;
  const TriangleMesh mesh = tetrahedron();
  ASSERT_TRUE(write_mesh(folder / "m.stl", mesh));
  EXPECT_EQ(std::filesystem::file_size(folder / "m.stl"), 84U + 4 * 50);
  const auto back = read_mesh(folder / "m.stl");
  ASSERT_TRUE(back) << back.error().text();
  // Vertices are numbered in the order of their appearance.
  EXPECT_EQ(back->vertices.size(), 4U);
  EXPECT_THAT(back->triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{2, 1, 3},
                                           Triangle{0, 3, 1}));
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE(
          (back->vertices[back->triangles[t][k]] - mesh.vertices[mesh.triangles[t][k]]).norm(),
          1e-8F);
  const ReadMeshOptions metres{1.0};
  EXPECT_NEAR(read_mesh(folder / "m.stl", metres)->vertices[2].x(), 100.0F, 1e-4F);
}

TEST(MeshStl, ManyVerticesAreMergedExactly) {
  const TempFolder folder;
  TriangleMesh mesh;
  constexpr int kSide = 60;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      mesh.vertices.emplace_back(static_cast<float>(x) * 0.1F, static_cast<float>(y) * 0.1F, -0.0F);
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t i = y * kSide + x;
      mesh.triangles.push_back({i, i + 1, i + kSide});
      mesh.triangles.push_back({i + 1, i + kSide + 1, i + kSide});
    }
  ASSERT_TRUE(write_mesh(folder / "m.stl", mesh));
  const auto back = read_mesh(folder / "m.stl");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->vertices.size(), mesh.vertices.size());
  EXPECT_EQ(back->triangles.size(), mesh.triangles.size());
}

std::string text_solid(std::string_view name) {
  return fmt::format(
      "solid {}\n  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1e3 0 0\n"
      "      vertex 0 1e3 0\n    endloop\n  endfacet\nendsolid {}\n",
      name, name);
}

TEST(MeshStl, ReadsTextWithSeveralSolids) {
  const auto meshes = read_text("m.stl", text_solid("one two") + text_solid(""));
  ASSERT_TRUE(meshes) << meshes.error().text();
  ASSERT_EQ(meshes->size(), 2U);
  EXPECT_EQ(meshes->at(0).name, "one two");
  EXPECT_THAT(meshes->at(1).vertices, ElementsAre(Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)));
}

TEST(MeshStl, SolidsWithoutAFacetTakeNoMemory) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "solid empty\nendsolid\n";
  text += "solid full\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid\n";
  const auto meshes = mesh_io::decode_stl(text + "solid\nendsolid\n");
  ASSERT_TRUE(meshes) << meshes.error().text();
  EXPECT_LE(meshes->size(), 2u);
  EXPECT_EQ(meshes->front().name, "full");
}

TEST(MeshStl, BinaryFileMayBeginWithSolid) {
  const TempFolder folder;
  ASSERT_TRUE(write_mesh(folder / "m.stl", tetrahedron()));
  std::string bytes = testing::content_of(folder / "m.stl");
  bytes.replace(0, 20, "solid x\nfacet normal");
  const auto meshes = read_text("b.stl", bytes);
  ASSERT_TRUE(meshes) << meshes.error().text();
  EXPECT_EQ(meshes->front().triangles.size(), 4U);
}

TEST(MeshStl, AFacetDoesNotEndInAnotherSolid) {
  const TempFolder folder;
  const auto path =
      folder.put("m.stl",
                 "solid a\nfacet normal 0 0 1\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                 "0\nendsolid a\nsolid b\nendfacet\nendsolid b\n");
  const auto meshes = read_meshes(path);
  ASSERT_FALSE(meshes);  // its corners are vertices of a, and b has none
  EXPECT_EQ(meshes.error().code, ErrorCode::kFormat);
}

TEST(MeshStl, DamagedFilesAreRefused) {
  const TempFolder folder;
  ASSERT_TRUE(write_mesh(folder / "m.stl", tetrahedron()));
  const std::string bytes = testing::content_of(folder / "m.stl");
  for (const std::size_t length : {0U, 1U, 83U, 84U, 85U, 134U, 283U})
    EXPECT_THAT(error_of("m.stl", bytes.substr(0, length)), HasSubstr("format: ")) << length;
  std::string huge = bytes;
  huge.replace(80, 4, raw(0x80000000U));
  EXPECT_THAT(error_of("m.stl", huge), HasSubstr("do not fit"));
  const std::string text = text_solid("t");
  for (const std::string_view end : {"vertex 0 1e3", "endloop", "endfacet", "endsolid"})
    EXPECT_THAT(error_of("m.stl", text.substr(0, text.rfind(end))), HasSubstr("format: ")) << end;
  std::string wrong = text;
  wrong.replace(wrong.find("1e3"), 3, "1,3");
  EXPECT_THAT(error_of("m.stl", wrong), HasSubstr("damaged at line 5: not a number"));
  wrong = text;
  wrong.replace(wrong.find("1e3"), 3, "nan");
  EXPECT_THAT(error_of("m.stl", wrong), HasSubstr("not finite"));
}

TEST(MeshObj, KeepsEverythingOfOneMesh) {
  const TempFolder folder;
  const TriangleMesh mesh = tetrahedron();
  ASSERT_TRUE(write_mesh(folder / "m.obj", mesh));
  const auto back = read_mesh(folder / "m.obj");
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(back->vertices, mesh.vertices);
  EXPECT_EQ(back->triangles, mesh.triangles);
  EXPECT_EQ(back->normals, mesh.normals);
  EXPECT_EQ(back->colors, mesh.colors);
}

TEST(MeshObj, KeepsEveryColour) {
  const TempFolder folder;
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.resize(256, Vec3f::Zero());
  mesh.normals.clear();
  mesh.colors.clear();
  for (int i = 0; i < 256; ++i)
    mesh.colors.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 0});
  ASSERT_TRUE(write_mesh(folder / "m.obj", mesh));
  EXPECT_EQ(read_mesh(folder / "m.obj")->colors, mesh.colors);
}

TEST(MeshObj, KeepsObjectsApart) {
  const TempFolder folder;
  std::vector<TriangleMesh> meshes{tetrahedron(), tetrahedron(0.2F, 1.0F), tetrahedron(3.0F)};
  meshes[0].name = "first";
  meshes[2].name = "third one";
  ASSERT_TRUE(write_meshes(folder / "m.obj", meshes));
  const auto back = read_meshes(folder / "m.obj");
  ASSERT_TRUE(back) << back.error().text();
  ASSERT_EQ(back->size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back->at(i).name, meshes[i].name);
    EXPECT_EQ(back->at(i).vertices, meshes[i].vertices);
    EXPECT_EQ(back->at(i).triangles, meshes[i].triangles);
    EXPECT_EQ(back->at(i).normals, meshes[i].normals);
    EXPECT_EQ(back->at(i).colors, meshes[i].colors);
  }
  EXPECT_EQ(read_mesh(folder / "m.obj")->vertices.size(), 12U);
}

TEST(MeshObj, ObjectsWithoutNumberAreRefused) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 100000; ++i) text += "o a\nf 1 2 3\n";
  EXPECT_THAT(error_of("m.obj", text), HasSubstr("out of all proportion"));
  // Where each has vertices of its own they are what they are.
  text.clear();
  for (int i = 0; i < 50000; ++i)
    text += "o part_of_it\nv 0.125 0.25 0.5\nv 1.125 0.25 0.5\nv 0.125 1.25 0.5\nf -3 -2 -1\n";
  EXPECT_EQ(read_text("m.obj", text).value().size(), 50000u);
}

TEST(MeshObj, ReadsEveryKindOfCorner) {
  const auto meshes = read_text("m.obj",
                                "# comment\r\nmtllib x.mtl\r\nv 0 0 0\r\nv 1 0 0 1.0\r\n"
                                "v 1 1 0\r\nv 0 1 0\r\nvt 0 0\r\nvn 0 0 1\r\ns off\r\n"
                                "f 1 2 3 4\r\nf 1/1 2/1 3/1\r\nf 1//1 2//1 3//1\r\n"
                                "f -4/-1/-1 -3/1/1 \\\r\n -1/1/1\r\nl 1 2\r\n");
  ASSERT_TRUE(meshes) << meshes.error().text();
  EXPECT_THAT(meshes->front().triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 1, 2},
                          Triangle{0, 1, 2}, Triangle{0, 1, 3}));
  EXPECT_TRUE(meshes->front().colors.empty());
  EXPECT_EQ(meshes->front().normals.size(), 4U);
}

TEST(MeshObj, NormalsThatDifferBetweenFacesAreLeftOut) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nvn 0 0 1\n";
  EXPECT_TRUE(
      read_text("m.obj", start + "f 1//1 2//1 3//1\nf 1//2 2//2 3//2\n")->front().normals.empty());
  EXPECT_EQ(
      read_text("m.obj", start + "f 1//1 2//1 3//1\nf 1//3 2//3 3//3\n")->front().normals.size(),
      3U);
}

TEST(MeshObj, DamagedFilesAreRefused) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
  for (const std::string_view face :
       {"f 1 2 4", "f 0 1 2", "f 1 2 -4", "f 1 2 2147483648", "f 1 2 9999999999999999999",
        "f 1 2 x", "f 1//2 2//1 3//1", "f 1// 2// 3//", "f 1 2", "f", "v 1 2", "v 1 2 x", "vn 1"})
    EXPECT_THAT(error_of("m.obj", start + std::string(face)), HasSubstr("damaged at line 5"))
        << face;
  EXPECT_THAT(error_of("m.obj", ""), HasSubstr("too-few-points"));
  EXPECT_THAT(error_of("m.obj", "v 0 0 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3"), HasSubstr("not finite"));
  EXPECT_THAT(error_of("m.obj", "v 0 0 1e300\nv 1 0 0\nv 0 1 0\nf 1 2 3"), HasSubstr("not finite"));
}

TEST(MeshOff, ReadsPolygonsCommentsAndColours) {
  const auto meshes = read_text("m.off",
                                "# made by hand\nCOFF\n4 2 0\n# vertices\n0 0 0 255 0 0 255\n"
                                "1 0 0 0 0 0 0\n1 1 0 0 0 0 0\n0 1 0 0 0 0 0\n\n4 0 1 2 3 7 7 7\n"
                                "3 3 2 1");
  ASSERT_TRUE(meshes) << meshes.error().text();
  EXPECT_THAT(meshes->front().triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{3, 2, 1}));
  EXPECT_EQ(meshes->front().vertices[2], Vec3f(1, 1, 0));
}

TEST(MeshOff, DamagedFilesAreRefused) {
  const std::string good = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(error_of("m.off", good), "no error");
  for (std::size_t length = 0; length + 1 < good.size(); ++length)
    EXPECT_NE(error_of("m.off", good.substr(0, length)), "no error") << length;
  for (const std::string_view counts : {"2147483648 1 0", "3 2147483648 0", "-3 1 0", "3 -1 0",
                                        "9223372036854775807 9223372036854775807 0"}) {
    std::string text = good;
    text.replace(4, 5, counts);
    EXPECT_THAT(error_of("m.off", text), HasSubstr("too short")) << counts;
  }
  for (const std::string_view face :
       {"3 0 1 3", "3 0 1 -1", "4 0 1 2", "99999999999 0 1 2", "-1"}) {
    std::string text = good;
    text.replace(text.rfind("3 0 1 2"), 7, face);
    EXPECT_THAT(error_of("m.off", text), HasSubstr("damaged at line 6")) << face;
  }
  EXPECT_THAT(error_of("m.off", "OFF BINARY\n3 1 0\n"), HasSubstr("unsupported"));
  EXPECT_THAT(error_of("m.off", "4OFF\n3 1 0\n"), HasSubstr("unsupported"));
}

class EveryWriter : public ::testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path file() const { return folder_ / (std::string("m.") + GetParam()); }
  TempFolder folder_;
};

TEST_P(EveryWriter, FullDiskIsAnIoErrorAndLeavesTheOldFile) {
  std::ofstream(file()) << "old";
  const std::vector<TriangleMesh> meshes(200, tetrahedron());
  Result<> result;
  {
    const testing::FullDisk full(1000);
    result = write_meshes(file(), meshes);
  }
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kIo);
  EXPECT_THAT(result.error().text(), HasSubstr("File too large"));
  EXPECT_EQ(testing::content_of(file()), "old");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_P(EveryWriter, DeviceWithoutSpaceIsAnIoError) {
  std::filesystem::create_symlink("/dev/full", file());
  const auto result = write_mesh(file(), tetrahedron());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kIo);
  EXPECT_THAT(result.error().text(), HasSubstr("No space left on device"));
}

TEST_P(EveryWriter, MissingFolderFolderAsFileAndPermissionAreErrors) {
  const auto missing = folder_ / "none" / file().filename();
  EXPECT_EQ(write_mesh(missing, tetrahedron()).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(check_mesh_output(missing).error().code, ErrorCode::kNotFound);
  std::filesystem::create_directory(file());
  EXPECT_EQ(write_mesh(file(), tetrahedron()).error().code, ErrorCode::kIo);
  EXPECT_EQ(check_mesh_output(file()).error().code, ErrorCode::kIo);
  std::filesystem::remove(file());
  EXPECT_TRUE(check_mesh_output(file()));
  ::chmod(folder_.path().c_str(), 0555);
  {
    const testing::NoPrivileges nobody;
    EXPECT_EQ(write_mesh(file(), tetrahedron()).error().code, ErrorCode::kIo);
  }
  ::chmod(folder_.path().c_str(), 0755);
  EXPECT_EQ(folder_.count(), 0U);
}

TEST_P(EveryWriter, RefusesMeshesThatAreNotOne) {
  EXPECT_EQ(write_meshes(file(), {}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(write_mesh(file(), TriangleMesh()).error().code, ErrorCode::kTooFewPoints);
  TriangleMesh mesh = tetrahedron();
  mesh.vertices[1].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(write_mesh(file(), mesh).error().code, ErrorCode::kFormat);
  mesh = tetrahedron();
  mesh.triangles[0][0] = 4;
  EXPECT_THROW((void)write_mesh(file(), mesh), std::invalid_argument);
  mesh = tetrahedron();
  mesh.colors.pop_back();
  EXPECT_THROW((void)write_mesh(file(), mesh), std::invalid_argument);
  EXPECT_EQ(folder_.count(), 0U);
}

TEST_P(EveryWriter, SameMeshGivesTheSameBytes) {
  ASSERT_TRUE(write_mesh(file(), tetrahedron()));
  const std::string first = testing::content_of(file());
  ASSERT_TRUE(write_mesh(file(), tetrahedron()));
  EXPECT_EQ(testing::content_of(file()), first);
}

TEST_P(EveryWriter, EmptyOrTruncatedFileIsRefused) {
  ASSERT_TRUE(write_mesh(file(), tetrahedron()));
  const std::string bytes = testing::content_of(file());
  for (const std::size_t length : {std::size_t(0), std::size_t(1), bytes.size() / 2}) {
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << bytes.substr(0, length);
    EXPECT_FALSE(read_meshes(file())) << length;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryWriter, ::testing::Values("ply", "obj", "stl", "3mf", "glb"),
                         [](const auto& format) { return std::string(format.param); });

TEST(Mesh, UnknownNamesAndMissingFilesAreErrors) {
  EXPECT_EQ(write_mesh("m.xyz", tetrahedron()).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(write_mesh("m", tetrahedron()).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(check_mesh_output("m.xyz").error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(read_meshes("/no/such.ply").error().code, ErrorCode::kNotFound);
  EXPECT_THROW((void)read_meshes("m.ply", {0.0}), std::invalid_argument);
  EXPECT_THROW((void)read_meshes("m.ply", {std::nan("")}), std::invalid_argument);
}

TEST(Mesh, CancelledBeforeTheStartIsCancelled) {
  const RunContext ctx;
  ctx.cancel();
  EXPECT_EQ(read_meshes("m.ply", {}, ctx).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
