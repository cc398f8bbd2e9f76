#pragma once
// Parser for the header of a PCD file.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::pcd {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
  std::string name;
  std::uint64_t size = 4;   ///< 1, 2, 4 or 8 bytes
  char type = 'F';          ///< I, U or F
  std::uint64_t count = 1;  ///< values per point
  std::uint64_t bytes() const { return size * count; }
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t width = 0;
  std::uint64_t height = 1;
  std::uint64_t points = 0;
  std::optional<Viewpoint> viewpoint;
  PcdData data = PcdData::kAscii;
  std::size_t body = 0;  ///< offset at which the header ends

  std::uint64_t point_bytes() const;
  std::uint64_t values_per_point() const;
  /// Index of a field, or -1.
  int find(std::string_view name) const;
};

/// Fails with kFormat. The number of points is checked against the length of the file, except in
/// compressed files.
Result<PcdHeader> parse_pcd_header(std::string_view bytes);

}  // namespace turnscan::pcd
