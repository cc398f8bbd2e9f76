#include <gtest/gtest.h>

#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/sequence_views.hpp>

namespace turnscan {
namespace {

using Positions = std::vector<std::size_t>;

/// Frames 0, 1, 2, ... of two sensors in turn and of passes of three frames; every fifth is dropped
/// and cannot be read.
MemoryFrames some_frames(std::uint32_t count) {
  MemoryFrames out(SequenceHeader{});
  for (std::uint32_t i = 0; i < count; ++i) {
    Frame frame;
    frame.info.index = i;
    frame.info.sensor = i % 2;
    frame.info.pass = i / 3;
    if (i % 5 == 4) frame.info.status = FrameStatus::kDropped;
    out.add(std::move(frame));
  }
  return out;
}

TEST(UsableFrames, AreThoseOfTheSensorAndThePassThatWereNotDropped) {
  const MemoryFrames frames = some_frames(9);
  EXPECT_EQ(usable_frames(frames), (Positions{0, 1, 2, 3, 5, 6, 7, 8}));
  EXPECT_EQ(usable_frames(frames, {.sensor = 1}), (Positions{1, 3, 5, 7}));
  EXPECT_EQ(usable_frames(frames, {.pass = 1}), (Positions{3, 5}));
  EXPECT_EQ(usable_frames(frames, {.sensor = 0, .pass = 2}), (Positions{6, 8}));
  EXPECT_TRUE(usable_frames(frames, {.pass = 3}).empty());
}

TEST(ReadFrames, GivesEachFrameWithItsPlaceAmongThePositions) {
  const MemoryFrames frames = some_frames(100);
  const Positions positions{97, 3, 50, 3};
  std::vector<std::uint32_t> index(positions.size(), 0);
  const auto keep = [&](std::size_t k, const Frame& frame) -> Result<> {
    index[k] = frame.info.index;
    return {};
  };
  ASSERT_TRUE(read_frames(frames, positions, {}, keep));
  EXPECT_EQ(index, (std::vector<std::uint32_t>{97, 3, 50, 3}));
}

TEST(ReadFrames, FailsAtTheFirstOneThatCannotBeReadOrUsed) {
  const MemoryFrames frames = some_frames(30);
  const auto use = [&](std::size_t k, const Frame& frame) -> Result<> {
    if (frame.info.index != 7) return {};
    return fail(ErrorCode::kFormat, "frame 7 at {}", k);
  };
  EXPECT_EQ(read_frames(frames, Positions{0, 7, 9, 14}, {}, use).error().message, "frame 7 at 1");
  EXPECT_EQ(read_frames(frames, Positions{0, 9, 7, 14}, {}, use).error().message,
            "frame 9 was lost");
  EXPECT_TRUE(read_frames(frames, Positions{0, 1, 2}, {}, use));
}

TEST(ReadFrames, LeavesUnreadableOnesToAUseThatTakesResults) {
  const MemoryFrames frames = some_frames(6);
  std::vector<int> readable(3, -1);
  const auto use = [&](std::size_t k, const Result<Frame>& frame) -> Result<> {
    readable[k] = frame ? 1 : 0;
    return {};
  };
  ASSERT_TRUE(read_frames(frames, Positions{3, 4, 5}, {}, use));
  EXPECT_EQ(readable, (std::vector<int>{1, 0, 1}));
}

TEST(ReadFrames, ReadsNothingOnceItIsCancelled) {
  RunContext context;
  context.cancel();
  const auto use = [](std::size_t, const Frame&) -> Result<> {
    ADD_FAILURE() << "was read";
    return {};
  };
  EXPECT_EQ(read_frames(some_frames(3), Positions{0, 1}, context, use).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
