#include <gtest/gtest.h>

#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "tests/support/temp_folder.hpp"
#include "tests/workflow/scenes.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

TEST(Input, IsARecordingByItsFolderOrItsFile) {
  const TempFolder folder;
  SimulateRequest request;
  request.scene = testing::cylinder_scene(2);
  request.recording = (folder / "rec").string();
  ASSERT_TRUE(simulate(request, RunContext()));
  for (const char* name : {"rec", "rec/recording.json"}) {
    const auto input = open_input(folder / name);
    ASSERT_TRUE(input) << input.error().text();
    EXPECT_EQ(input->frames->frames().size(), 2u);
    EXPECT_TRUE(input->notes.empty());
  }
}

TEST(Input, TellsWhatIsMissingInARecording) {
  const TempFolder folder;
  SimulateRequest request;
  request.scene = testing::cylinder_scene(2);
  request.recording = (folder / "rec").string();
  ASSERT_TRUE(simulate(request, RunContext()));
  std::filesystem::remove(folder / "rec/depth/000001.png");
  const auto input = open_input(folder / "rec");
  ASSERT_TRUE(input);
  EXPECT_EQ(input->notes.size(), 1u);
}

TEST(Input, OfAnotherProgramIsImported) {
  const TempFolder folder;
  folder.put("bunny.conf", "bmesh scan.ply 0 0 0 0 0 0 1\n");
  folder.put("scan.ply",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n0 0 1\n");
  ImportOptions options;
  options.point_unit = LengthUnit::kMetre;
  const auto input = open_input(folder / "bunny.conf", options);
  ASSERT_TRUE(input) << input.error().text();
  EXPECT_EQ(input->frames->frames().size(), 1u);
}

TEST(Input, OfAnotherProgramAsksForWhatCannotBeAsAssumed) {
  const TempFolder folder;
  folder.put("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n-1 -1 -1\n1 1 1\n");
  folder.put("angles.csv", "file,angle_deg\na.ply,0\n");
  ImportOptions options;
  options.point_unit = LengthUnit::kMetre;
  const auto inside = open_input(folder.path(), options);
  ASSERT_FALSE(inside);
  EXPECT_EQ(inside.error().code, ErrorCode::kMissingData);
  EXPECT_NE(inside.error().message.find("--sensor-position"), std::string::npos);
  options.sensor_position = "0m,0m,3m";
  EXPECT_TRUE(open_input(folder.path(), options));
  options.sensor_position = "0m,0m,0.1m";
  EXPECT_TRUE(open_input(folder.path(), options)) << "what is stated is not refused";
}

TEST(Input, MustExist) {
  const TempFolder folder;
  const auto input = open_input(folder / "nothing");
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace turnscan
