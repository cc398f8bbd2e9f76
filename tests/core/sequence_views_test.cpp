#include <gtest/gtest.h>

#include <stdexcept>
#include <turnscan/core/sequence_views.hpp>

namespace turnscan {
namespace {

/// Frames 0, 1, 2, ...; the depth of each is 1000 more than its index.
MemoryFrames numbered_frames(std::uint32_t count) {
  SequenceHeader header;
  header.sensors.resize(1);
  header.software = "test";
  MemoryFrames out(std::move(header));
  for (std::uint32_t i = 0; i < count; ++i) {
    Frame frame;
    frame.info.index = i;
    frame.depth = DepthImage(1, 1, static_cast<std::uint16_t>(1000 + i));
    out.add(std::move(frame));
  }
  return out;
}

TEST(MemoryFrames, AreThoseThatWereGiven) {
  const auto shared = std::make_shared<const Frame>(*numbered_frames(2).read(1));
  const MemoryFrames frames(SequenceHeader(), {shared, shared});
  ASSERT_EQ(frames.frames().size(), 2u);
  EXPECT_EQ(frames.frames()[0].index, 1u);
  EXPECT_EQ(frames.read(1)->depth.pixels[0], 1001);
  EXPECT_EQ(shared.use_count(), 3);
}

TEST(MemoryFrames, FailToReadADroppedOne) {
  MemoryFrames frames = numbered_frames(1);
  Frame dropped;
  dropped.info.status = FrameStatus::kDropped;
  frames.add(dropped);
  EXPECT_TRUE(frames.read(0));
  EXPECT_EQ(frames.read(1).error().code, ErrorCode::kMissingData);
}

TEST(SequenceView, IsTheSequenceUntilItIsChanged) {
  const MemoryFrames frames = numbered_frames(3);
  const SequenceView view(frames);
  EXPECT_EQ(view.header().software, "test");
  EXPECT_EQ(view.frames().size(), 3u);
  EXPECT_EQ(view.read(2)->depth.pixels[0], 1002);
  EXPECT_EQ(view.read(2)->info.index, 2u);
}

TEST(SequenceView, TakesPositionsInTheirOrder) {
  const MemoryFrames frames = numbered_frames(5);
  const SequenceView view(frames, {4, 1});
  ASSERT_EQ(view.frames().size(), 2u);
  EXPECT_EQ(view.frames()[0].index, 4u);
  EXPECT_EQ(view.read(1)->depth.pixels[0], 1001);
  EXPECT_EQ(view.positions(), (std::vector<std::size_t>{4, 1}));
  EXPECT_THROW(SequenceView(frames, {5}), std::out_of_range);
}

TEST(SequenceView, GivesItsHeaderAndInfosToWhatIsRead) {
  const MemoryFrames frames = numbered_frames(2);
  SequenceView view(frames);
  SequenceHeader header = frames.header();
  header.software = "another";
  view.set_header(header);
  std::vector<FrameInfo> infos = frames.frames();
  infos[1].angle_rad = 0.5;
  view.set_frames(infos);
  EXPECT_EQ(view.header().software, "another");
  EXPECT_EQ(view.read(1)->info.angle_rad, 0.5);
  EXPECT_THROW(view.set_frames({}), std::invalid_argument);
}

TEST(SequenceView, JoinsFramesOfSeveralSequences) {
  const MemoryFrames some = numbered_frames(3), others = numbered_frames(9);
  SequenceView view(some.header());
  FrameInfo info;
  for (const std::size_t position : {8u, 6u}) {
    info.index = std::uint32_t(view.frames().size());
    view.add(others, position, info);
  }
  info.index = 7;
  view.add(some, 2, info);
  EXPECT_EQ(view.header().software, "test");
  EXPECT_EQ(view.positions(), (std::vector<std::size_t>{8, 6, 2}));
  EXPECT_EQ(view.read(1)->depth.pixels[0], 1006);
  EXPECT_EQ(view.read(1)->info.index, 1u);
  EXPECT_EQ(view.read(2)->depth.pixels[0], 1002);
  EXPECT_EQ(view.read(2)->info.index, 7u);
}

TEST(SequenceView, MapsEachFrameWithItsPositionInTheView) {
  const MemoryFrames frames = numbered_frames(4);
  SequenceView view(frames, {2, 3});
  view.set_map([](Frame frame, std::size_t position) -> Result<Frame> {
    if (position == 1) return fail(ErrorCode::kFormat, "not this one");
    frame.depth.pixels[0] = 7;
    return frame;
  });
  EXPECT_EQ(view.read(0)->depth.pixels[0], 7);
  EXPECT_EQ(view.read(1).error().code, ErrorCode::kFormat);
}

}  // namespace
}  // namespace turnscan
