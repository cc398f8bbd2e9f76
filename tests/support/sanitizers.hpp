#pragma once
// Whether this build runs under a sanitizer, which takes address space that limits would deny it,
// and many times as long.

namespace turnscan::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

/// How often to repeat what only statistics need: a sanitizer judges the code, not the figures.
constexpr int repetitions(int many, int few = 1) { return kSanitized ? few : many; }

}  // namespace turnscan::testing
