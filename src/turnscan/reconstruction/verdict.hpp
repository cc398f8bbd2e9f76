#pragma once
// How good a scan is, as far as the scan itself tells.

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace turnscan {

enum class Level { kGood, kFair, kBad };
/// "good", "fair", "bad".
std::string_view name_of(Level level);

/// What one property of a scan says.
struct VerdictSentence {
  std::string topic;  ///< one word: turn, seen, error, invented, agreement, ...
  Level level = Level::kGood;
  std::string text;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no single figure
  std::string unit;
};

/// The worst sentence decides.
struct Verdict {
  std::vector<VerdictSentence> sentences;

  Level level() const {
    Level worst = Level::kGood;
    for (const VerdictSentence& s : sentences) worst = std::max(worst, s.level);
    return worst;
  }
  /// "green", "amber", "red".
  std::string_view colour() const;
};

}  // namespace turnscan
