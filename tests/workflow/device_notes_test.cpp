#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/workflow/device_notes.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Frames as a device of this model hands them over, perhaps with holes filled from the left.
class AsDevice : public FrameSequence {
 public:
  AsDevice(const FrameSequence& source, const char* model, bool filled)
      : source_(source), header_(source.header()), filled_(filled) {
    header_.sensors[0].model = model;
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return source_.frames(); }
  Result<Frame> read(std::size_t position) const override {
    TURNSCAN_ASSIGN(Frame frame, source_.read(position));
    DepthImage& depth = frame.depth;
    for (int y = 0; filled_ && y < depth.height; ++y)
      for (int x = 1; x < depth.width; ++x)
        if (depth.at(x, y) == kNoReturn) depth.at(x, y) = depth.at(x - 1, y);
    return frame;
  }

 private:
  const FrameSequence& source_;
  SequenceHeader header_;
  bool filled_;
};

Simulation doll_in_a_room() {
  SceneDescription scene;
  scene.object = "builtin:doll";
  scene.scanners = {{"kinect-v1", {}}};
  scene.placement.distance_m = 0.7;
  scene.motion.frames = 2;
  scene.measure.noise = "none";
  scene.room.kind = RoomKind::kClutter;
  auto made = prepare_simulation(scene, RunContext());
  EXPECT_TRUE(made) << made.error().text();
  return std::move(made).value();
}

std::vector<std::string> notes_of(const Simulation& simulation, const char* model, bool filled) {
  const auto notes = device_notes(AsDevice(simulation.scan, model, filled), RunContext());
  EXPECT_TRUE(notes);
  return notes.value_or(std::vector<std::string>{"failed"});
}

TEST(DeviceNotes, FilledGapsAreToldOfSensorsThatTriangulate) {
  const Simulation simulation = doll_in_a_room();
  EXPECT_THAT(notes_of(simulation, "kinect-v1", false), IsEmpty());
  EXPECT_THAT(notes_of(simulation, "kinect-v1", true), ElementsAre(HasSubstr("fills holes")));
  for (const char* other : {"kinect-v2", "", "no-such-model", "a/kinect-v1.toml"})
    EXPECT_THAT(notes_of(simulation, other, true), IsEmpty()) << other;
}

}  // namespace
}  // namespace turnscan
