#pragma once
// Who operates the rig: the first who asks, until they give it up, or somebody else asks after they
// were silent for a while.

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

namespace turnscan::serve {

class OperatorLease {
 public:
  /// Long enough for a page that is reloaded, short enough for the next person at the table.
  static constexpr std::chrono::seconds kKept{30};

  /// The key of the operator, given a key from before (or any text). nullopt: somebody else
  /// operates.
  std::optional<std::string> take(const std::string& key);
  /// Whether this is the operator's key; if so, the lease is renewed.
  bool holds(const std::string& key);
  void give_up(const std::string& key);
  bool taken() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool valid(const std::string& key) const;

  mutable std::mutex mutex_;
  std::string key_;  // empty: nobody's
  Clock::time_point until_;
};

/// 128 bits of the system's randomness as 32 hexadecimal digits.
std::string random_key();

/// Compares in a time that does not depend on where they differ.
bool same_secret(const std::string& a, const std::string& b);

}  // namespace turnscan::serve
