#include <oneapi/tbb/task_scheduler_observer.h>

#include <cstddef>
#include <new>
#include <turnscan/core/process/thread_priority.hpp>

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace turnscan::process {

void lower_thread_priority() {
#ifdef __linux__
  // Linux keeps a niceness per thread, where POSIX has one per process; 0 is the caller.
  constexpr int kNiceness = 5;
  if (::getpriority(PRIO_PROCESS, 0) < kNiceness) ::setpriority(PRIO_PROCESS, 0, kNiceness);
#endif
}

void lower_worker_priority() {
  class Lower : public oneapi::tbb::task_scheduler_observer {
   public:
    Lower() { observe(true); }
    void on_scheduler_entry(bool is_worker) override {
      thread_local bool lowered = false;
      if (is_worker && !lowered) lower_thread_priority();
      lowered = lowered || is_worker;
    }
  };
  // Never destroyed: workers may outlive static objects.
  alignas(Lower) static std::byte storage[sizeof(Lower)];
  static const Lower* const lower = new (storage) Lower;
  static_cast<void>(lower);
}

}  // namespace turnscan::process
