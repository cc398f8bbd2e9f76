#include <gtest/gtest.h>

#include <atomic>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "tests/support/temp_folder.hpp"
#include "tests/workflow/scenes.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using testing::content_of;
using testing::TempFolder;

/// Every file below, by its path, with its content.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      out[fs::relative(entry.path(), folder).string()] = content_of(entry.path());
  return out;
}

TEST(Simulate, RecordsWithTheTruthBesideIt) {
  const TempFolder folder;
  SimulateRequest request;
  request.scene = testing::cylinder_scene(3);
  request.recording = (folder / "rec").string();
  request.samples = true;
  request.coverage = (folder / "coverage.ply").string();
  request.report = (folder / "report.json").string();
  const auto made = simulate(request, RunContext());
  ASSERT_TRUE(made) << made.error().text();
  const auto files = files_of(folder.path());
  for (const char* name :
       {"rec/recording.json", "rec/frames.csv", "rec/depth/000002.png", "rec/truth/object.ply",
        "rec/truth/poses.csv", "rec/truth/calibration.json", "rec/truth/truth.json",
        "rec/truth/scene.toml", "rec/truth/samples/000002.ply", "coverage.ply", "coverage.json",
        "report.json"})
    EXPECT_EQ(files.count(name), 1u) << name;
  EXPECT_TRUE(made->coverage);
  EXPECT_EQ(made->scan.frames().size(), 3u);
}

TEST(Simulate, MakesTheSameBytesWhenItIsWatched) {
  const TempFolder folder;
  SimulateRequest request;
  request.scene = testing::cylinder_scene(5);
  request.scene.measure.noise = "gaussian:1mm";
  request.recording = (folder / "plain").string();
  ASSERT_TRUE(simulate(request, RunContext()));
  const auto simulation = prepare_simulation(request.scene, RunContext());
  ASSERT_TRUE(simulation);
  std::array<std::atomic<int>, 5> seen{};
  const auto watcher = [&](const Frame&, std::size_t position) { ++seen.at(position); };
  ASSERT_TRUE(
      record_simulation(*simulation, (folder / "watched").string(), false, watcher, RunContext()));
  EXPECT_EQ(files_of(folder / "plain"), files_of(folder / "watched"));
  for (const auto& count : seen) EXPECT_EQ(count, 1);
}

TEST(Simulate, LeavesNothingWhenItIsCancelled) {
  const TempFolder folder;
  const auto simulation = prepare_simulation(testing::cylinder_scene(5), RunContext());
  ASSERT_TRUE(simulation);
  const RunContext context;
  const auto cancel = [&](const Frame&, std::size_t) { context.cancel(); };
  const auto done =
      record_simulation(*simulation, (folder / "rec").string(), false, cancel, context);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Simulate, ChecksItsOutputsFirst) {
  const TempFolder folder;
  SimulateRequest request;
  request.scene = testing::cylinder_scene(2);
  request.samples = true;
  EXPECT_EQ(simulate(request, RunContext()).error().code, ErrorCode::kInvalidOption);
  request.recording = folder.path().string();
  folder.put("file", "");
  EXPECT_EQ(simulate(request, RunContext()).error().code, ErrorCode::kAlreadyExists);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(Simulate, TheObjectLiesAsEachPassSays) {
  SceneDescription scene = testing::cylinder_scene(2);
  scene.next_passes = {{{"tip", "90deg"}}};
  const auto placed = load_objects(scene, RunContext());
  ASSERT_TRUE(placed) << placed.error().text();
  ASSERT_EQ(placed->size(), 2u);
  EXPECT_GT(bounds((*placed)[0].mesh.vertices).size().y(),
            bounds((*placed)[1].mesh.vertices).size().y());
}

TEST(Simulate, AScannerThatIsKnockedStaysSoInLaterPasses) {
  SceneDescription scene = testing::cylinder_scene(4);
  scene.motion.fps = 1.0;
  scene.next_passes = {{{"yaw", "0deg"}}};
  const auto still = prepare_simulation(scene, RunContext());
  scene.placement.knock.at_s = 2.0;
  scene.placement.knock.shift_m = 0.01;
  const auto knocked = prepare_simulation(scene, RunContext());
  ASSERT_TRUE(still && knocked);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto eye = [&](const Simulation& made) {
      const auto [pass, there] = made.scan.place_of(i);
      return Vec3d(made.scan.pass(pass).T_table_sensor(there).translation());
    };
    EXPECT_NEAR((eye(*still) - eye(*knocked)).norm(), i < 2 ? 0.0 : 0.01, 1e-12) << i;
  }
}

TEST(Simulate, AnEmptyTableHasNoObject) {
  SceneDescription scene = testing::cylinder_scene(2);
  scene.object = "builtin:empty";
  const auto simulation = prepare_simulation(scene, RunContext());
  ASSERT_TRUE(simulation);
  EXPECT_TRUE(simulation->placed.empty());
  EXPECT_EQ(simulation->scan.count(), 1u);
}

TEST(Simulate, AnObjectThatIsNoFileFailsWithItsPath) {
  SceneDescription scene = testing::cylinder_scene(2);
  scene.object = "/nowhere/object.ply";
  const auto placed = load_objects(scene, RunContext());
  ASSERT_FALSE(placed);
  EXPECT_EQ(placed.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace turnscan
