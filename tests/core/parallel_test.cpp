#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <turnscan/core/parallel.hpp>

namespace turnscan {
namespace {

class ThreadLimit {
 public:
  explicit ThreadLimit(int count) { set_thread_count(count); }
  ~ThreadLimit() { set_thread_count(0); }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
};

TEST(Parallel, ForVisitsEveryIndexOnce) {
  for (const std::size_t n : {0u, 1u, 7u, 8u, 9u, 1000u}) {
    std::vector<int> visits(n, 0);
    parallel_for(n, 8, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(n, 1));
  }
}

TEST(Parallel, ForUpToTheGrainRunsInOrderOnTheCallingThread) {
  std::vector<std::size_t> order;
  parallel_for(8, 8, [&](std::size_t i) { order.push_back(i); });
  std::vector<std::size_t> expected(8);
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(order, expected);
}

TEST(Parallel, ChunksCoverTheRangeInOrder) {
  using Span = std::pair<std::size_t, std::size_t>;
  const auto span = [](std::size_t begin, std::size_t end) { return Span(begin, end); };
  EXPECT_EQ(parallel_chunks<Span>(10, 4, span), (std::vector<Span>{{0, 4}, {4, 8}, {8, 10}}));
  EXPECT_EQ(parallel_chunks<Span>(8, 4, span), (std::vector<Span>{{0, 4}, {4, 8}}));
  EXPECT_TRUE(parallel_chunks<Span>(0, 4, span).empty());
}

// A float sum depends on the order of its terms: the same bits mean the same order.
float sum_in_chunks() {
  const auto parts = parallel_chunks<float>(100'000, 1000, [](std::size_t begin, std::size_t end) {
    float sum = 0.0f;
    for (std::size_t i = begin; i < end; ++i) sum += 1.0f / std::sqrt(float(i) + 1.0f);
    return sum;
  });
  return std::accumulate(parts.begin(), parts.end(), 0.0f);
}

TEST(Parallel, ChunksGiveTheSameBitsForAnyNumberOfThreads) {
  float one = 0.0f, four = 0.0f;
  {
    ThreadLimit limit(1);
    one = sum_in_chunks();
  }
  {
    ThreadLimit limit(4);
    four = sum_in_chunks();
  }
  EXPECT_EQ(one, four);
  EXPECT_EQ(one, sum_in_chunks());
}

#ifndef TURNSCAN_PLAIN_THREADS
TEST(Parallel, RunOnThisThreadKeepsLoopsThere) {
  const auto here = std::this_thread::get_id();
  std::atomic<int> elsewhere{0};
  run_on_this_thread([&] {
    parallel_for(1000, 1, [&](std::size_t) {
      if (std::this_thread::get_id() != here) ++elsewhere;
    });
  });
  EXPECT_EQ(elsewhere, 0);
}
#endif

TEST(Parallel, ThreadCountIsWhatWasSet) {
  const int all = thread_count();
  {
    ThreadLimit limit(3);
    EXPECT_EQ(thread_count(), 3);
    set_thread_count(1);
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_EQ(thread_count(), all);
  EXPECT_GE(all, 1);
}

TEST(Parallel, ABodyThatFailsGivesTheErrorOfTheSmallestIndex) {
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    for (const std::size_t n : {1u, 7u, 500u}) {
      for (const std::size_t first : {0u, 3u, 499u, 1000u}) {
        const auto body = [&](std::size_t i) -> Result<> {
          if (i < first || i % 2 != first % 2) return {};
          return fail(ErrorCode::kFormat, "{}", i);
        };
        const Result<> result = parallel_for(n, 2, RunContext(), body);
        ASSERT_EQ(result.has_value(), first >= n);
        EXPECT_EQ(result ? "" : result.error().message, first < n ? std::to_string(first) : "");
      }
    }
  }
}

TEST(Parallel, WhatFollowsAFailureIsLeftOut) {
  std::vector<std::size_t> called;  // in order: as many as the grain run on the calling thread
  const auto body = [&](std::size_t i) -> Result<> {
    called.push_back(i);
    if (i == 3) return fail(ErrorCode::kFormat, "3");
    return {};
  };
  EXPECT_FALSE(parallel_for(100, 100, RunContext(), body));
  EXPECT_EQ(called, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(Parallel, AnExceptionOfTheBodyReachesTheCaller) {
  const auto body = [](std::size_t i) {
    if (i == 500) throw std::invalid_argument("500");
  };
  EXPECT_THROW(parallel_for(1000, 10, body), std::invalid_argument);
}

}  // namespace
}  // namespace turnscan
