#pragma once
// A record of a ROS bag: its header, a list of NAME=VALUE, and its data. Follows "Bag file format
// 2.0", https://wiki.ros.org/Bags/Format/2.0. Numbers are little-endian.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::rosbag {

enum class Op : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

inline constexpr std::uint32_t kMaxHeaderBytes = 1U << 20;

/// The fields of a header. Keeps a reference to its bytes.
class RecordHeader {
 public:
  /// Fails with kFormat if a field is longer than the header or has no '='.
  static Result<RecordHeader> parse(std::string_view bytes);

  /// Empty if there is no such field.
  std::string_view text(std::string_view name) const;
  /// A field of exactly this size; nullopt otherwise.
  std::optional<std::uint8_t> u8(std::string_view name) const;
  std::optional<std::uint32_t> u32(std::string_view name) const;
  /// Time stored as seconds and nanoseconds, in nanoseconds.
  std::optional<std::int64_t> time_ns(std::string_view name) const;

 private:
  std::string_view bytes_;
};

/// A record in memory, and the offset of the next one.
struct RecordView {
  RecordHeader header;
  std::string_view data;
  std::size_t end = 0;
};

/// The record at `offset`. Fails with kFormat if it does not end within the bytes.
Result<RecordView> record_at(std::string_view bytes, std::size_t offset);

}  // namespace turnscan::rosbag
