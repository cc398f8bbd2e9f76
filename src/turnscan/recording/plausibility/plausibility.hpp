#pragma once
// What cannot be in recorded data, or hardly: said before work begins.

#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

enum class Plausibility { kDoubtful, kImplausible };
/// "doubtful", "implausible".
std::string_view name_of(Plausibility level);

struct PlausibilityFinding {
  Plausibility level = Plausibility::kDoubtful;
  std::string text;    ///< one sentence: what it is and what to do
  std::string option;  ///< of turnscan import, which settles it; empty: none does
};

/// What stands on a turntable, at its widest: a file that is smaller or larger is in another unit.
inline constexpr double kSmallestObject_m = 0.004, kLargestObject_m = 2.5;

/// Looks at headers, times, angles and at most 40 frames of each sensor. Frames that cannot be read
/// are passed over. Fails only with kCancelled.
Result<std::vector<PlausibilityFinding>> find_implausible(const FrameSequence& sequence,
                                                          const RunContext& context);

}  // namespace turnscan
