#pragma once
// JSON as bytes: checks before parsing, and edits that preserve the other bytes.

#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/read_budget.hpp>

namespace turnscan::text {

/// Deeper nesting is rejected: the parser's value is destroyed and printed recursively.
inline constexpr int kMaxJsonDepth = 64;

/// Fails with kFormat, naming the line, if lists and objects are nested deeper than kMaxJsonDepth,
/// and as the budget does, which is charged for the memory that the parsed value will take.
Result<> check_json_shape(std::string_view text, const file::ReadBudget& budget);

/// "line 3, column 14" of the byte at an offset, both counted from 1, for error messages.
std::string line_and_column(std::string_view text, std::size_t offset);

/// Offset of the value at a path such as "sensors[0].intrinsics.fx" in a JSON text, or of its
/// deepest existing part. For a duplicate key the last one counts. text must be valid.
std::size_t json_offset(std::string_view text, std::string_view path);

/// The text of a JSON object with one member set to a value, which is itself JSON; all other bytes
/// are preserved. For a duplicate key the last one counts, as in the parser. text must be valid.
std::string with_json_member(std::string text, std::string_view key, std::string_view value);

}  // namespace turnscan::text
