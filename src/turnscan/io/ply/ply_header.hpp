#pragma once
// Parser for the header of a PLY file (G. Turk, The PLY polygon file format, 1994).

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::ply {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };
enum class PlyType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat,
  kDouble
};

std::size_t size_of(PlyType type);
bool is_floating(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;  ///< of the items, for a list
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< lists only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;  ///< at least one

  /// Index of the first property with one of the names, or -1.
  int find(std::initializer_list<std::string_view> names) const;
  bool has_list() const;
  /// Minimum size of one row in a file.
  std::uint64_t min_row_bytes(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::vector<std::string> obj_info;  ///< the text after the keyword
  std::size_t body = 0;               ///< offset at which the header ends

  const PlyElement* find(std::string_view name) const;
  /// The text after "obj_info KEY", or empty.
  std::string_view info(std::string_view key) const;
};

bool looks_like_ply(std::string_view bytes);

/// Fails with kFormat on a damaged header, and if the bytes after the header cannot hold the rows
/// that it declares; with kUnsupported on a type that PLY does not have.
Result<PlyHeader> parse_ply_header(std::string_view bytes);

}  // namespace turnscan::ply
