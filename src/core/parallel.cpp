#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <memory>
#include <mutex>
#include <turnscan/core/parallel.hpp>

namespace turnscan {

void set_thread_count(int count) {
  using oneapi::tbb::global_control;
  static std::mutex mutex;
  static std::unique_ptr<global_control> control;
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
