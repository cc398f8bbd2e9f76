#include <gtest/gtest.h>

#include <tests/support/memory_sequence.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/passes/placed_passes.hpp>

namespace turnscan {
namespace {

using testing::MemorySequence;

/// Frames of passes 4 and 7, by turns.
MemorySequence two_passes() {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.T_table_sensor = Pose(Eigen::Translation3d(0.0, 0.2, 1.0));
  sequence.header_value.sensors = {sensor};
  sequence.header_value.turntable = TurntableInfo();
  for (std::uint32_t f = 0; f < 6; ++f) {
    Frame frame;
    frame.info.index = 10 + f;
    frame.info.pass = f % 2 == 0 ? 4 : 7;
    frame.info.angle_rad = 0.1 * f;
    sequence.add(std::move(frame));
  }
  return sequence;
}

TEST(PlacedPasses, ComeOneAfterAnotherWithThePosesOfTheirFrames) {
  const MemorySequence sequence = two_passes();
  const Pose there(Eigen::Translation3d(0.0, 0.0, 0.3));
  const auto placed = place_passes(sequence, {{7, there}}, {});
  ASSERT_TRUE(placed) << placed.error().message;
  ASSERT_EQ(placed->placements.size(), 2u);
  EXPECT_TRUE(placed->placements[0].T_object_table.isApprox(Pose::Identity()));
  EXPECT_TRUE(placed->placements[1].T_object_table.isApprox(there));
  EXPECT_EQ(placed->placements[1].name, "pass 7");
  const auto& frames = placed->frames.frames();
  ASSERT_EQ(frames.size(), 6u);
  std::vector<std::uint32_t> passes, indices;
  for (const FrameInfo& frame : frames) {
    passes.push_back(frame.pass);
    indices.push_back(frame.index);
  }
  EXPECT_EQ(passes, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(indices, (std::vector<std::uint32_t>{10, 12, 14, 11, 13, 15}));
  EXPECT_EQ(placed->frames.read(3)->info.index, 11u);
  EXPECT_TRUE(frames[4].T_table_sensor->isApprox(rotation_about_y(-0.3) *
                                                 *sequence.header().sensors[0].T_table_sensor));
}

TEST(PlacedPasses, EveryPassButTheFirstNeedsAPlace) {
  const MemorySequence sequence = two_passes();
  const Pose pose = Pose::Identity();
  EXPECT_FALSE(place_passes(sequence, {{4, pose}}, {}));
  EXPECT_FALSE(place_passes(sequence, {{7, pose}, {7, pose}}, {}));
  EXPECT_FALSE(place_passes(sequence, {{7, pose}, {1, pose}}, {}));
  ReconstructOptions one;
  one.merge.pass = 4;
  EXPECT_FALSE(place_passes(sequence, {{7, pose}}, one));
}

TEST(JoinedFrames, SeveralSequencesKeepTheirSensorsApart) {
  const MemorySequence first = two_passes(), second = two_passes();
  const auto joined = JoinedFrames::create({{&first, 4}, {&second, 4}, {&first, 7}}, std::nullopt);
  ASSERT_TRUE(joined) << joined.error().message;
  EXPECT_EQ(joined->header().sensors.size(), 2u);
  std::vector<std::uint32_t> sensors, indices;
  for (const FrameInfo& frame : joined->frames()) {
    sensors.push_back(frame.sensor);
    indices.push_back(frame.index);
  }
  EXPECT_EQ(sensors, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

}  // namespace
}  // namespace turnscan
