#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/process/thread_priority.hpp>

namespace turnscan::process {
namespace {

int niceness() { return ::getpriority(PRIO_PROCESS, 0); }

TEST(ThreadPriority, OneThreadStepsBackAndTheOthersDoNot) {
  const int before = niceness();
  int lowered = before;
  std::thread([&] {
    lower_thread_priority();
    lower_thread_priority();
    lowered = niceness();
  }).join();
  EXPECT_EQ(lowered, std::max(before, 5));
  EXPECT_EQ(niceness(), before);
}

TEST(ThreadPriority, WorkersOfLoopsStepBackAndWhoStartsALoopDoesNot) {
#ifdef TURNSCAN_PLAIN_THREADS
  GTEST_SKIP() << "loops have no lasting workers there";
#endif
  lower_worker_priority();
  lower_worker_priority();
  const int before = niceness();
  const auto caller = std::this_thread::get_id();
  std::atomic<int> wrong{0}, by_workers{0};
  for (int round = 0; round < 200 && (by_workers == 0 || round < 5); ++round)
    parallel_for(64, 1, [&](std::size_t) {
      const bool worker = std::this_thread::get_id() != caller;
      wrong += niceness() != (worker ? std::max(before, 5) : before) ? 1 : 0;
      by_workers += worker ? 1 : 0;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    });
  EXPECT_EQ(wrong, 0);
  if (thread_count() > 1) {
    EXPECT_GT(by_workers, 0);
  }
}

}  // namespace
}  // namespace turnscan::process
