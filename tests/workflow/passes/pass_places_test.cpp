#include <gtest/gtest.h>

#include <tests/support/memory_sequence.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/passes/pass_places.hpp>

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

TEST(JoinPasses, ComePassAfterPassWithThePosesOfTheirFrames) {
  const MemorySequence sequence = two_passes();
  const auto joined = join_passes({{&sequence, 4, {}}, {&sequence, 7, {}}});
  ASSERT_TRUE(joined) << joined.error().message;
  const auto& frames = joined->frames();
  ASSERT_EQ(frames.size(), 6u);
  std::vector<std::uint32_t> passes, indices;
  for (const FrameInfo& frame : frames) {
    passes.push_back(frame.pass);
    indices.push_back(frame.index);
  }
  EXPECT_EQ(passes, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(indices, (std::vector<std::uint32_t>{10, 12, 14, 11, 13, 15}));
  EXPECT_EQ(joined->read(3)->info.index, 11u);
  EXPECT_TRUE(frames[4].T_table_sensor->isApprox(rotation_about_y(-0.3) *
                                                 *sequence.header().sensors[0].T_table_sensor));
}

TEST(JoinPasses, SeveralSequencesKeepTheirSensorsApart) {
  const MemorySequence first = two_passes(), second = two_passes();
  const auto joined = join_passes({{&first, 4, {}}, {&second, 4, {}}, {&first, 7, {}}});
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

TEST(PassPlaces, PassesOfSeveralRecordingsAreCountedThrough) {
  MemorySequence first = two_passes(), second = two_passes();
  for (FrameInfo& frame : second.infos)
    if (frame.pass == 7) frame.status = FrameStatus::kDropped;
  const auto one = list_passes({{"a", &first, {}}}, {});
  ASSERT_EQ(one->size(), 2u);
  EXPECT_EQ((*one)[1].number, 7u);
  EXPECT_EQ((*one)[1].name, "pass 7");
  const auto both = list_passes({{"a", &first, {}}, {"b", &second, {}}}, {});
  ASSERT_EQ(both->size(), 3u);
  EXPECT_EQ((*both)[2].number, 2u);
  EXPECT_EQ((*both)[2].name, "pass 2 (b)");
  EXPECT_EQ((*both)[2].frames.pass, 4u);
}

TEST(PassPlaces, WhatIsStatedIsTaken) {
  const MemorySequence sequence = two_passes();
  const Pose there(Eigen::Translation3d(0.0, 0.0, 0.3));
  const auto passes = list_passes({{"", &sequence, {}}}, {{7, there}});
  ASSERT_TRUE(passes) << passes.error().message;
  const auto places = place_passes(*passes, {}, RunContext());
  ASSERT_TRUE(places) << places.error().message;
  ASSERT_EQ(places->objects.size(), 1u);
  const auto& of_pass = places->objects[0].of_pass;
  ASSERT_EQ(of_pass.size(), 2u);
  EXPECT_TRUE(of_pass[0]->T_object_table.isApprox(Pose::Identity()));
  EXPECT_TRUE(of_pass[1]->T_object_table.isApprox(there));
  EXPECT_FALSE(of_pass[1]->found);
  EXPECT_EQ(places->reasons, (std::vector<std::string>{"", ""}));
}

TEST(PassPlaces, WhatIsStatedOfNoPassOrTwiceIsRefused) {
  const MemorySequence sequence = two_passes();
  const Pose pose = Pose::Identity();
  EXPECT_FALSE(list_passes({{"", &sequence, {}}}, {{7, pose}, {7, pose}}));
  EXPECT_FALSE(list_passes({{"", &sequence, {}}}, {{7, pose}, {1, pose}}));
}

}  // namespace
}  // namespace turnscan
