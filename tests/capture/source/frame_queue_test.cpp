#include <gtest/gtest.h>

#include <thread>
#include <turnscan/capture/source/frame_queue.hpp>

namespace turnscan::source {
namespace {

using QueuedKind = Delivery::Kind;

Delivery frame(std::uint32_t index) {
  Delivery out;
  out.kind = QueuedKind::kFrame;
  out.frame.info.index = index;
  out.frame.depth = DepthImage(2, 2, 7);
  return out;
}

void put(FrameQueue& queue, std::uint32_t index) {
  Delivery delivery = frame(index);
  ASSERT_TRUE(queue.push(delivery));
}

TEST(FrameQueue, GivesFramesInTheOrderInWhichTheyCame) {
  FrameQueue queue(8, true);
  for (std::uint32_t i = 0; i < 5; ++i) put(queue, i);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(queue.pop(0.0)->frame.info.index, i);
  EXPECT_EQ(queue.pop(0.0)->kind, QueuedKind::kNothing);
  EXPECT_EQ(queue.most_waiting(), 5u);
}

TEST(FrameQueue, AFullLiveQueueDropsTheOldestImagesAndKeepsTheirInfo) {
  FrameQueue queue(3, true);
  for (std::uint32_t i = 0; i < 5; ++i) put(queue, i);
  EXPECT_EQ(queue.dropped(), 2u);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const auto out = queue.pop(0.0);
    EXPECT_EQ(out->frame.info.index, i);
    EXPECT_EQ(out->frame.info.status, i < 2 ? FrameStatus::kDropped : FrameStatus::kOk);
    EXPECT_EQ(out->frame.depth.empty(), i < 2);
  }
  EXPECT_EQ(queue.most_waiting(), 3u);
}

TEST(FrameQueue, AFullQueueOfASourceThatCanWaitWaits) {
  FrameQueue queue(2, false);
  std::thread producer([&] {
    for (std::uint32_t i = 0; i < 50; ++i) put(queue, i);
    queue.close(std::nullopt);
  });
  for (std::uint32_t i = 0; i < 50; ++i) EXPECT_EQ(queue.pop(10.0)->frame.info.index, i);
  EXPECT_EQ(queue.pop(10.0)->kind, QueuedKind::kEnd);
  producer.join();
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(FrameQueue, ClosingEndsAWaitingPushAndLeavesTheFrameWithItsOwner) {
  FrameQueue queue(1, false);
  put(queue, 0);
  Delivery second = frame(1);
  bool pushed = true;
  std::thread producer([&] { pushed = queue.push(second); });
  queue.close(std::nullopt);
  producer.join();
  EXPECT_FALSE(pushed);
  EXPECT_EQ(second.frame.depth.pixels.size(), 4u);
}

TEST(FrameQueue, WhatWaitsIsTakenBeforeTheError) {
  FrameQueue queue(4, true);
  put(queue, 0);
  queue.close(Error{ErrorCode::kDeviceLost, "gone", ""});
  EXPECT_EQ(queue.pop(0.0)->kind, QueuedKind::kFrame);
  EXPECT_EQ(queue.pop(0.0).error().code, ErrorCode::kDeviceLost);
  EXPECT_EQ(queue.pop(0.0).error().code, ErrorCode::kDeviceLost);
  queue.reopen();
  EXPECT_EQ(queue.pop(0.0)->kind, QueuedKind::kNothing);
}

}  // namespace
}  // namespace turnscan::source
