#pragma once
// The one header through which turnscan runs loops on several threads. The result of a loop must
// not depend on the number of threads: bodies write to places of their own, and reductions go
// through fixed chunks that are combined in order.
// With TURNSCAN_PLAIN_THREADS (the preset tsan) the threads are std::thread's: the thread sanitizer
// cannot follow how oneTBB, which is not built for it, hands work from thread to thread.

#ifndef TURNSCAN_PLAIN_THREADS
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#endif

#include <atomic>
#include <cstddef>
#include <functional>
#include <turnscan/core/run_context.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace turnscan {

/// Limits every parallel loop of the process to `count` threads; 0 means all cores.
void set_thread_count(int count);
int thread_count();

/// Calls body() on this thread. oneTBB loops that it starts, a library's too, stay on this thread.
void run_on_this_thread(const std::function<void()>& body);

#ifdef TURNSCAN_PLAIN_THREADS
namespace parallel {
/// Calls body(begin, end) on threads of its own, in pieces of up to `grain`.
void run_on_threads(std::size_t n, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body);
}  // namespace parallel
#endif

/// Calls body(i) for each i in [0, n), in any order and on any thread. Serial for n <= grain.
template <class Body>
void parallel_for(std::size_t n, std::size_t grain, const Body& body) {
  if (n <= grain) {
    for (std::size_t i = 0; i < n; ++i) body(i);
    return;
  }
#ifdef TURNSCAN_PLAIN_THREADS
  parallel::run_on_threads(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
#else
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n, grain),
                            [&](const oneapi::tbb::blocked_range<std::size_t>& range) {
                              for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                            });
#endif
}

/// As parallel_for(), but once the context is cancelled the calls that have not begun are left out,
/// and it fails with kCancelled. The body may return a Result<>: then calls for larger i are left
/// out after a failure, and it fails with the error of the smallest i that has one. For loops whose
/// body takes less than a tenth of a second.
template <class Body>
Result<> parallel_for(std::size_t n, std::size_t grain, const RunContext& context,
                      const Body& body) {
  if constexpr (std::is_void_v<std::invoke_result_t<const Body&, std::size_t>>) {
    parallel_for(n, grain, [&](std::size_t i) {
      if (!context.cancelled()) body(i);
    });
    return context.check();
  } else {
    std::vector<Result<>> results(n);
    std::atomic<std::size_t> failed{n};  // the smallest i known to fail
    parallel_for(n, grain, [&](std::size_t i) {
      if (context.cancelled() || i > failed) return;
      results[i] = body(i);
      std::size_t before = failed;
      while (!results[i] && i < before && !failed.compare_exchange_weak(before, i)) {
      }
    });
    TURNSCAN_TRY(context.check());
    return failed < n ? std::move(results[failed]) : Result<>();
  }
}

/// Splits [0, n) into chunks of chunk_size (the last may be shorter), computes map(begin, end) of
/// each on any thread, and returns the values in order: the same for every number of threads.
template <class T, class Map>
std::vector<T> parallel_chunks(std::size_t n, std::size_t chunk_size, const Map& map) {
  const std::size_t count = (n + chunk_size - 1) / chunk_size;
  std::vector<T> values(count);
  parallel_for(count, 1, [&](std::size_t c) {
    const std::size_t begin = c * chunk_size;
    values[c] = map(begin, begin + chunk_size < n ? begin + chunk_size : n);
  });
  return values;
}

}  // namespace turnscan
