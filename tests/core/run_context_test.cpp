#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {
namespace {

// Steps through work until it is cancelled, as a long call of the library does.
Result<int> count_to(int n, const RunContext& context) {
  context.begin_phase("count", std::uint64_t(n));
  for (int i = 0; i < n; ++i) {
    TURNSCAN_TRY(context.check());
    context.advance();
  }
  return n;
}

TEST(RunContext, FreshOneIsNotCancelledAndInNoPhase) {
  const RunContext context;
  EXPECT_FALSE(context.cancelled());
  EXPECT_TRUE(context.check());
  EXPECT_EQ(context.progress().phase, "");
  EXPECT_EQ(context.progress().phase_number, 0);
  EXPECT_EQ(context.progress().fraction, 0.0);
}

TEST(RunContext, CancelBeforeTheStartStopsAtTheFirstCheck) {
  const RunContext context;
  context.cancel();
  const Result<int> r = count_to(10, context);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(context.progress().fraction, 0.0);
}

TEST(RunContext, CancelFromAnotherThreadEndsARunningCall) {
  const RunContext context;
  std::thread other([context] { context.cancel(); });
  Result<int> r = 0;
  while (r) r = count_to(1000, context);
  other.join();
  EXPECT_EQ(r.error().code, ErrorCode::kCancelled);
}

TEST(RunContext, CopiesShareOneState) {
  const RunContext a;
  const RunContext b = a;
  b.begin_phase("shared", 2);
  b.advance();
  b.cancel();
  EXPECT_TRUE(a.cancelled());
  EXPECT_EQ(a.progress().phase, "shared");
  EXPECT_EQ(a.progress().fraction, 0.5);
}

TEST(RunContext, TwoContextsShareNothing) {
  const RunContext a, b;
  a.cancel();
  EXPECT_FALSE(b.cancelled());
}

TEST(RunContext, FractionStaysWithinOneWhenMoreStepsComeThanAnnounced) {
  const RunContext context;
  context.begin_phase("p", 3);
  context.advance(7);
  EXPECT_EQ(context.progress().fraction, 1.0);
}

TEST(RunContext, UnknownTotalReportsNoFraction) {
  const RunContext context;
  context.begin_phase("p", 0);
  context.advance(7);
  EXPECT_EQ(context.progress().fraction, 0.0);
}

TEST(RunContext, EachPhaseIsReportedOnceAtItsStart) {
  RunContext context;
  std::vector<Progress> seen;
  context.set_listener([&](const Progress& p) { seen.push_back(p); });
  context.begin_phase("read", 4);
  context.advance(4);
  context.begin_phase("merge", 4);
  ASSERT_GE(seen.size(), 2u);
  EXPECT_EQ(seen.front().phase, "read");
  EXPECT_EQ(seen.front().phase_number, 1);
  EXPECT_EQ(seen.back().phase, "merge");
  EXPECT_EQ(seen.back().phase_number, 2);
  EXPECT_EQ(seen.back().fraction, 0.0);
}

TEST(RunContext, ProgressNeverGoesBackWithinAPhaseWhenManyThreadsAdvance) {
  RunContext context;
  std::atomic<int> inside = 0;
  bool overlapped = false, went_back = false;
  double last = 0.0;
  context.set_listener([&](const Progress& p) {
    overlapped |= ++inside > 1;
    went_back |= p.fraction < last;
    last = p.fraction;
    --inside;
  });
  context.begin_phase("p", 200'000);
  parallel_for(200, 1, [&](std::size_t) {
    for (int i = 0; i < 1000; ++i) context.advance();
  });
  EXPECT_FALSE(overlapped);
  EXPECT_FALSE(went_back);
  EXPECT_EQ(context.progress().fraction, 1.0);
}

TEST(RunContext, ListenerIsCalledAtMostAboutTwentyTimesASecond) {
  using Clock = std::chrono::steady_clock;
  RunContext context;
  int calls = 0;
  context.set_listener([&](const Progress&) { ++calls; });
  const auto start = Clock::now();
  context.begin_phase("p", 0);
  while (calls < 4) context.advance();
  // The first call is the phase's start; the other three are 50 ms apart at least.
  EXPECT_GE(Clock::now() - start, std::chrono::milliseconds(150));
}

TEST(RunContext, WorksTheSameWithAndWithoutListener) {
  RunContext loud;
  loud.set_listener([](const Progress&) {});
  EXPECT_EQ(count_to(50, loud).value(), count_to(50, RunContext()).value());
}

TEST(RunContext, ListenerMayCancel) {
  RunContext context;
  context.set_listener([context](const Progress&) { context.cancel(); });
  EXPECT_FALSE(count_to(10, context));
  context.set_listener(nullptr);  // the listener holds the context
}

}  // namespace
}  // namespace turnscan
