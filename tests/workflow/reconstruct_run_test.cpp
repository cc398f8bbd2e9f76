#include <gtest/gtest.h>

#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "tests/support/sanitizers.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/workflow/scenes.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

class ReconstructRunOf : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scan = new Simulation(*prepare_simulation(testing::cylinder_scene(30), RunContext()));
  }
  static void TearDownTestSuite() {
    delete scan;
    scan = nullptr;
  }
  ReconstructRunOf() { request.options.surface.method = SurfaceMethod::kVolumetric; }

  Result<ReconstructRun> run_of(const SceneDescription& scene) const {
    TURNSCAN_ASSIGN(const Simulation simulation, prepare_simulation(scene, RunContext()));
    return run_reconstruction(simulation.scan, request, RunContext());
  }

  static Simulation* scan;
  TempFolder folder;
  ReconstructRequest request;
};
Simulation* ReconstructRunOf::scan = nullptr;

TEST_F(ReconstructRunOf, AScanWritesWhatIsAskedFor) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  ReconstructFiles files;
  files.mesh = (folder / "mesh.ply").string();
  files.report = (folder / "report.json").string();
  files.stages["fitted"] = (folder / "fitted.ply").string();
  request.stages = {"fitted"};
  ASSERT_TRUE(check_outputs(files));
  const auto run = run_reconstruction(scan->scan, request, RunContext());
  ASSERT_TRUE(run) << run.error().text();
  EXPECT_TRUE(run->reconstruction.objects.at(0).check.watertight());
  EXPECT_FALSE(run->choice.calibration) << "the recording's own is good";
  const auto written = write_outputs(files, *run, request.options);
  ASSERT_TRUE(written) << written.error().text();
  EXPECT_EQ(*written, (std::vector<std::string>{files.mesh, files.stages["fitted"], files.report}));
  EXPECT_EQ(read_mesh(files.mesh, {}, RunContext())->triangles.size(),
            run->reconstruction.objects[0].mesh.triangles.size());
  EXPECT_EQ(read_cloud(files.stages["fitted"])->cloud.size(), run->stages.at("fitted").size());
  EXPECT_NE(testing::content_of(files.report).find("\"watertight\""), std::string::npos);
}

TEST_F(ReconstructRunOf, AScanKeepsNoStageThatNobodyWants) {
  const auto run = run_reconstruction(scan->scan, request, RunContext());
  ASSERT_TRUE(run) << run.error().text();
  EXPECT_TRUE(run->stages.empty());
}

TEST_F(ReconstructRunOf, ThinLegsOfAFilteringSensorAreNotInsideOut) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  SceneDescription scene;
  scene.object = "builtin:scorpion";
  scene.motion.frames = 36;
  scene.measure.noise = "physics";
  const auto run = run_of(scene);
  ASSERT_TRUE(run) << run.error().text();
  // 236 where rays half a voxel apart look for what crosses; what is left is where handles were
  // cut.
  std::size_t crossing = 0;
  for (const ObjectResult& object : run->reconstruction.objects)
    crossing += self_intersections(object.mesh).edges;
  EXPECT_LT(crossing, 50u);
}

/// A sensor that is knocked after a second.
SceneDescription knocked_scene() {
  SceneDescription scene;
  scene.object = "builtin:doll";
  scene.motion.frames = 60;
  scene.measure.noise = "gaussian:1mm";
  scene.placement.knock.at_s = 1.0;
  scene.placement.knock.shift_m = 0.005;
  scene.placement.knock.pan_rad = 0.5 * kRadiansPerDegree;
  return scene;
}

// What it sees of the platter after the knock says nothing of the calibration.
TEST_F(ReconstructRunOf, AKnockThatWasPutRightIsNotHeldAgainstTheMesh) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const auto run = run_of(knocked_scene());
  ASSERT_TRUE(run) << run.error().text();
  ASSERT_EQ(run->choice.disturbances.size(), 1U);
  EXPECT_EQ(run->choice.disturbances[0].kind, DisturbanceKind::kSensor);
  const ObjectResult& object = run->reconstruction.objects.at(0);
  ASSERT_TRUE(object.verdict);
  EXPECT_EQ(object.verdict->colour(), "green");
}

TEST_F(ReconstructRunOf, AStaleTableThatFramesWereMovedOffIsNotHeldAgainstTheMesh) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  SceneDescription scene = knocked_scene();
  scene.table.tilt_rad = 1.0 * kRadiansPerDegree;
  scene.table.x_m = 0.004;
  scene.record.calibration = RecordedCalibration::kNominal;
  const auto run = run_of(scene);
  ASSERT_TRUE(run) << run.error().text();
  ASSERT_FALSE(run->choice.poses.empty());
  const ObjectResult& object = run->reconstruction.objects.at(0);
  ASSERT_TRUE(object.verdict);
  EXPECT_EQ(object.verdict->colour(), "green");
}

TEST_F(ReconstructRunOf, AnUnknownWayToCalibrateFails) {
  request.calibration = "guess";
  const auto run = run_reconstruction(scan->scan, request, RunContext());
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, ErrorCode::kInvalidOption);
}

class SwappedBytes : public SequenceView {
 public:
  using SequenceView::SequenceView;
  Result<Frame> read(std::size_t position) const override {
    auto frame = SequenceView::read(position);
    for (std::uint16_t& raw : frame->depth.pixels)
      if (raw != kOutsideCrop) raw = std::uint16_t(raw << 8 | raw >> 8);
    return frame;
  }
};

TEST_F(ReconstructRunOf, DataThatCannotBeFailsWithTheCause) {
  const auto run = run_reconstruction(SwappedBytes(scan->scan), request, RunContext());
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().message.find("the bytes of sensor 0's depth are swapped"), 0U)
      << run.error().message;
}

TEST_F(ReconstructRunOf, TimesThatGoBackAreNotGreen) {
  SequenceView view(scan->scan);
  std::vector<FrameInfo> frames = view.frames();
  std::swap(frames[3].time_s, frames[4].time_s);
  view.set_frames(std::move(frames));
  const auto run = run_reconstruction(view, request, RunContext());
  ASSERT_TRUE(run) << run.error().text();
  const Verdict& verdict = *run->reconstruction.objects.at(0).verdict;
  EXPECT_EQ(verdict.level(), Level::kBad);
  EXPECT_NE(verdict.sentences.front().text.find("Times go back at frame 4"), std::string::npos);
}

TEST_F(ReconstructRunOf, ACancelledContextIsCancelled) {
  const RunContext context;
  context.cancel();
  const auto run = run_reconstruction(scan->scan, request, context);
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, ErrorCode::kCancelled);
}

TEST_F(ReconstructRunOf, OutputsAreCheckedBeforeTheWork) {
  ReconstructFiles files;
  files.mesh = (folder / "mesh.doc").string();
  EXPECT_EQ(check_outputs(files).error().code, ErrorCode::kInvalidOption);
  files.mesh = (folder / "mesh.ply").string();
  files.stages["fitted"] = (folder / "fitted.stl").string();
  EXPECT_EQ(check_outputs(files).error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
