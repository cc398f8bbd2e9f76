#pragma once
// Reads the fields of a message or record one after the other.

#include <cstdint>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/rosbag/bag_index.hpp>

namespace turnscan::rosbag {

/// Beyond the end everything is zero, and good() is false.
///
/// ROS 1: little-endian, no gaps, a 32-bit length before text. CDR (OMG's DDS-XTYPES, plain CDR
/// version 1, which rmw writes): four bytes of which the second says the order; then each number at
/// a multiple of its size, and texts end with a zero that their length counts.
class WireFields {
 public:
  explicit WireFields(std::string_view bytes, Wire wire = Wire::kRos1)
      : rest_(bytes), whole_(bytes.size()), cdr_(wire == Wire::kCdr) {
    if (!cdr_) return;
    const std::string_view head = take(4);
    good_ = head.size() == 4 && head[0] == 0 && (head[1] == 0 || head[1] == 1);
    swap_ = good_ && head[1] == 0;
    whole_ = rest_.size();
  }

  template <class T>
  T number() {
    if (cdr_) take((sizeof(T) - (whole_ - rest_.size()) % sizeof(T)) % sizeof(T));
    const std::string_view bytes = take(sizeof(T));
    if (bytes.size() != sizeof(T)) return T();
    return swap_ ? file::load<T, true>(bytes.data()) : file::load<T, false>(bytes.data());
  }
  /// Bytes behind their 32-bit length.
  std::string_view data() { return take(number<std::uint32_t>()); }
  std::string_view text() {
    std::string_view out = data();
    if (cdr_ && out.ends_with('\0')) out.remove_suffix(1);
    return out;
  }
  std::string_view take(std::size_t count) {
    good_ = good_ && count <= rest_.size();
    if (!good_) return {};
    const std::string_view out = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return out;
  }
  std::size_t left() const { return rest_.size(); }
  bool good() const { return good_; }
  bool cdr() const { return cdr_; }
  Result<> check(std::string_view what) const {
    if (good_) return {};
    return fail(ErrorCode::kFormat, "the message {} is shorter than it claims", what);
  }

 private:
  std::string_view rest_;
  std::size_t whole_;  ///< of what numbers are aligned in
  bool cdr_, swap_ = false, good_ = true;
};

}  // namespace turnscan::rosbag
