#pragma once
// Quality of a scan, as far as it can be judged from the scan itself.

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace turnscan {

enum class Level { kGood, kFair, kBad };
/// "good", "fair", "bad".
std::string_view name_of(Level level);

/// Assessment of one property of a scan.
struct VerdictSentence {
  std::string topic;  ///< one word: turn, seen, error, invented, agreement, ...
  Level level = Level::kGood;
  std::string text;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no single number
  std::string unit;
};

/// Its level is that of the worst sentence.
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
