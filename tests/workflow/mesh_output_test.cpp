#include <gtest/gtest.h>

#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/workflow/mesh_output.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

Reconstruction two_objects() {
  Reconstruction out;
  for (const char* name : {"cylinder", "letter-a"}) {
    ObjectResult object;
    object.mesh = *builtin_object(name);
    object.check = check_mesh(object.mesh);
    out.objects.push_back(std::move(object));
  }
  return out;
}

TEST(MeshOutput, NumbersTheFilesOfSeveralObjects) {
  const TempFolder folder;
  const auto files = write_objects((folder / "out.stl").string(), two_objects());
  ASSERT_TRUE(files);
  EXPECT_EQ(*files, (std::vector<std::string>{(folder / "out-1.stl").string(),
                                              (folder / "out-2.stl").string()}));
  EXPECT_EQ(folder.count(), 2u);
}

TEST(MeshOutput, PutsSeveralObjectsIntoOneFileWhereTheFormatCan) {
  for (const char* name : {"out.3mf", "out.GLB"}) {
    const TempFolder folder;
    const std::string path = (folder / name).string();
    const auto files = write_objects(path, two_objects());
    ASSERT_TRUE(files) << files.error().text();
    EXPECT_EQ(*files, std::vector<std::string>{path});
    const auto meshes = read_meshes(path, {}, RunContext());
    ASSERT_TRUE(meshes);
    EXPECT_EQ(meshes->size(), 2u);
  }
}

TEST(MeshOutput, DoesNotNumberTheFileOfOneObject) {
  const TempFolder folder;
  Reconstruction one = two_objects();
  one.objects.pop_back();
  const std::string path = (folder / "out.ply").string();
  EXPECT_EQ(*write_objects(path, one), std::vector<std::string>{path});
}

TEST(MeshOutput, NamesTheObjectThatIsNotWatertight) {
  Reconstruction result = two_objects();
  EXPECT_TRUE(check_watertight(result));
  result.objects[1].mesh.triangles.pop_back();
  result.objects[1].check = check_mesh(result.objects[1].mesh);
  const auto good = check_watertight(result);
  ASSERT_FALSE(good);
  EXPECT_EQ(good.error().message.find("object 2: the mesh is not watertight"), 0u);
}

TEST(MeshOutput, OfAnUnknownFormatIsAWrongOption) {
  const TempFolder folder;
  const auto good = check_mesh_file((folder / "out.txt").string());
  ASSERT_FALSE(good);
  EXPECT_EQ(good.error().code, ErrorCode::kInvalidOption);
  EXPECT_TRUE(check_mesh_file((folder / "out.ply").string()));
}

}  // namespace
}  // namespace turnscan
