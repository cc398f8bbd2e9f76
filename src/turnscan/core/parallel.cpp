#include <oneapi/tbb/task_arena.h>

#include <turnscan/core/parallel.hpp>

void turnscan::run_on_this_thread(const std::function<void()>& body) {
  oneapi::tbb::task_arena(1).execute(body);
}

#ifdef TURNSCAN_PLAIN_THREADS

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <turnscan/core/parallel.hpp>

namespace turnscan {

namespace {
std::atomic<int> limit{0};
}

void set_thread_count(int count) { limit = std::max(count, 0); }

int thread_count() {
  const int chosen = limit;
  return chosen > 0 ? chosen : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel::run_on_threads(std::size_t n, std::size_t grain,
                              const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t step = std::max<std::size_t>(grain, 1);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;  // guards failure
  const auto work = [&] {
    try {
      for (std::size_t begin = next.fetch_add(step); begin < n; begin = next.fetch_add(step))
        body(begin, std::min(begin + step, n));
    } catch (...) {
      next = n;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < thread_count(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace turnscan

#else

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <memory>
#include <mutex>
#include <turnscan/core/parallel.hpp>

namespace turnscan {

void set_thread_count(int count) {
  using oneapi::tbb::global_control;
  static std::mutex mutex;
  // Never destroyed: after TBB has failed to allocate while holding one of its locks, its
  // destructor would wait for that lock forever, and the process would not end.
  static auto& control = *new std::unique_ptr<global_control>;
  std::lock_guard lock(mutex);
  control.reset();
  if (count > 0) {
    control = std::make_unique<global_control>(global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(count));
  }
}

int thread_count() {
  using oneapi::tbb::global_control;
  return static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
}

}  // namespace turnscan

#endif
