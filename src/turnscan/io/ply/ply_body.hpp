#pragma once
// Reads elements of a PLY file into arrays.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/ply/ply_header.hpp>
#include <vector>

namespace turnscan::ply {

/// Target of one scalar property: row i goes to target + i * stride bytes.
struct PlyColumn {
  enum class Kind {
    kFloat,  ///< float
    kColor,  ///< std::uint8_t: integers unchanged (16 bits scaled down), floats times 255
    kIndex   ///< std::uint32_t, clamped
  };
  std::size_t property;
  Kind kind;
  void* target;
  std::size_t stride;
};

/// What to read from an element. Everything else in it is skipped.
struct PlyWanted {
  std::vector<PlyColumn> columns;
  int list = -1;  ///< index of a list property of integers, or -1
  /// Receives the list of each row, in order; returning an error message ends the reading.
  std::function<const char*(std::span<const std::int64_t>)> on_list;
};

/// Reads the rows of `element`, which begin at `position`, and returns the position after them.
/// Fails with kFormat if the file ends too early or a text is not a number.
Result<std::size_t> read_ply_element(std::string_view bytes, std::size_t position, PlyFormat format,
                                     const PlyElement& element, const PlyWanted& wanted);

}  // namespace turnscan::ply
