#include "limits.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>

namespace {

constexpr rlim_t kGiB = rlim_t(1) << 30;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  (void)::setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

}  // namespace

void limit_this_process() {
  if (!kSanitized) limit(RLIMIT_AS, 2 * kGiB);
  limit(RLIMIT_FSIZE, 2 * kGiB);
  limit(RLIMIT_CPU, 60);
  limit(RLIMIT_CORE, 0);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
}
