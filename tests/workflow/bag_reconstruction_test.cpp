#include <gtest/gtest.h>

#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/rosbag/reference_bag.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/workflow/scenes.hpp"

namespace turnscan {
namespace {

using namespace testing;

/// Frames with times alone, exact in nanoseconds, as a camera delivers them.
MemorySequence as_a_camera_has_it(const FrameSequence& recording) {
  MemorySequence out;
  out.header_value.sensors = recording.header().sensors;
  out.header_value.sensors[0].T_table_sensor.reset();
  for (std::size_t i = 0; i < recording.frames().size(); ++i) {
    Frame frame = recording.read(i).value();
    frame.info = FrameInfo();
    frame.info.index = std::uint32_t(i);
    frame.info.time_s = double(i) / 16.0;
    out.add(std::move(frame));
  }
  return out;
}

TriangleMesh mesh_of(const FrameSequence& frames, const std::string& turntable, double speed) {
  ReconstructRequest request;
  request.turntable = turntable;
  request.calibration = "recorded";
  request.allow_open = true;
  request.options.merge.speed_rad_s = speed;
  const auto run = run_reconstruction(frames, request, RunContext());
  EXPECT_TRUE(run) << run.error().text();
  return run && !run->reconstruction.objects.empty() ? run->reconstruction.objects[0].mesh
                                                     : TriangleMesh();
}

TEST(BagReconstruction, IsThatOfTheRecordingItWasMadeOf) {
  const TempFolder folder;
  SimulateRequest request;
  request.scene = cylinder_scene(12);
  request.recording = (folder / "rec").string();
  ASSERT_TRUE(simulate(request, RunContext()));
  const auto recording = open_input(folder / "rec");
  ASSERT_TRUE(recording);
  const MemorySequence native = as_a_camera_has_it(*recording->frames);
  const double speed = *recording->frames->frames()[1].angle_rad * 16.0;
  {
    ReferenceBag bag((folder / "take.bag").string(), BagPacking::kLz4);
    put_realsense(bag, native, "Intel RealSense D435", 17.25);
  }
  const auto bag = open_input(folder / "take.bag");
  ASSERT_TRUE(bag) << bag.error().text();
  EXPECT_TRUE(bag->imported);
  EXPECT_EQ(bag->notes, (std::vector<std::string>{"recorded by Intel RealSense D435"}));
  const std::string turntable = (folder / "rec/recording.json").string();
  const TriangleMesh wanted = mesh_of(native, turntable, speed);
  const TriangleMesh got = mesh_of(*bag->frames, turntable, speed);
  ASSERT_FALSE(wanted.triangles.empty());
  EXPECT_EQ(got.triangles, wanted.triangles);
  EXPECT_EQ(got.vertices, wanted.vertices);
}

}  // namespace
}  // namespace turnscan
