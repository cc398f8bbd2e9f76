#include <gtest/gtest.h>

#include <turnscan/core/parallel.hpp>
#include <turnscan/turntable/detection/average.hpp>

#include "tests/support/memory_sequence.hpp"

namespace turnscan {
namespace {

/// Frames of 3 x 1 pixels.
testing::MemorySequence sequence_of(const std::vector<std::vector<int>>& frames) {
  testing::MemorySequence out;
  SensorInfo sensor;
  sensor.intrinsics.width = 3;
  sensor.intrinsics.height = 1;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 3.0;
  sensor.depth_unit_m = 0.001;
  sensor.depth_bias_m = 0.01;
  out.header_value.sensors.push_back(sensor);
  for (const auto& values : frames) {
    Frame frame;
    frame.info.index = std::uint32_t(out.infos.size());
    frame.depth = DepthImage(3, 1);
    for (int i = 0; i < 3; ++i) frame.depth.at(i, 0) = std::uint16_t(values[std::size_t(i)]);
    out.add(std::move(frame));
  }
  return out;
}

TEST(AverageFrames, TakesTheMeanOverValidSamplesAndKeepsTheNoise) {
  const auto sequence = sequence_of({{1000, 0, 500}, {1002, 65535, 0}, {1004, 700, 502}});
  AverageOptions half;
  half.min_share = 0.5;
  const auto scan = average_frames(sequence, {0, 1, 2}, half, {});
  ASSERT_TRUE(scan) << scan.error().text();
  EXPECT_NEAR(scan->depth_m.at(0, 0), 1.012, 1e-6);
  EXPECT_NEAR(scan->noise_m.at(0, 0), 0.002, 1e-6);
  EXPECT_EQ(scan->depth_m.at(1, 0), 0.0f);  // one return in three frames is less than half
  EXPECT_EQ(scan->count.at(1, 0), 1);
  EXPECT_NEAR(scan->depth_m.at(2, 0), 0.511, 1e-6);
  EXPECT_NEAR(scan->noise_m.at(2, 0), std::sqrt(2.0) * 1e-3, 1e-6);
  EXPECT_EQ(points_of(*scan).cell, (std::vector<std::int32_t>{0, 2}));
}

TEST(AverageFrames, DoesNotDependOnOrderOrThreads) {
  std::vector<std::vector<int>> frames;
  for (int i = 0; i < 20; ++i) frames.push_back({1000 + i * i, 3 * i, 900 - i});
  const auto sequence = sequence_of(frames);
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < 20; ++i) positions.push_back(i);
  const auto forth = average_frames(sequence, positions, {}, {});
  std::reverse(positions.begin(), positions.end());
  set_thread_count(1);
  const auto back = average_frames(sequence, positions, {}, {});
  set_thread_count(0);
  EXPECT_EQ(forth->depth_m.pixels, back->depth_m.pixels);
  EXPECT_EQ(forth->noise_m.pixels, back->noise_m.pixels);
}

TEST(AverageFrames, RefusesPointsNothingAndCancelling) {
  auto sequence = sequence_of({{0, 0, 0}});
  EXPECT_EQ(average_frames(sequence, {}, {}, {}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(average_frames(sequence, {0}, {}, {}).error().code, ErrorCode::kTooFewPoints);
  AverageOptions options;
  options.min_share = std::nan("");
  EXPECT_EQ(average_frames(sequence, {0}, options, {}).error().code, ErrorCode::kInvalidOption);
  options = {};
  options.frames = 0;
  EXPECT_EQ(average_frames(sequence, {0}, options, {}).error().code, ErrorCode::kInvalidOption);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(average_frames(sequence, {0}, {}, context).error().code, ErrorCode::kCancelled);
  sequence.header_value.sensors[0].kind = SensorKind::kPointScanner;
  EXPECT_EQ(average_frames(sequence, {0}, {}, {}).error().code, ErrorCode::kUnsupported);
}

TEST(SpreadPositions, LeavesOutDroppedFramesAndOtherSensors) {
  auto sequence = sequence_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  sequence.infos[1].status = FrameStatus::kDropped;
  sequence.infos[4].sensor = 1;
  EXPECT_EQ(spread_positions(sequence, 0, 10), (std::vector<std::size_t>{0, 2, 3, 5}));
  EXPECT_EQ(spread_positions(sequence, 0, 2), (std::vector<std::size_t>{0, 3}));
}

}  // namespace
}  // namespace turnscan
