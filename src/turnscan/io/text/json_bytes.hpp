#pragma once
// JSON as bytes: looked at before it is parsed, changed without being written anew.

#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::text {

/// Deeper lists and objects are refused: the parser's value is destroyed and printed recursively.
inline constexpr int kMaxJsonDepth = 64;

/// Fails with kFormat, naming the line, when lists and objects lie deeper than kMaxJsonDepth.
Result<> check_json_depth(std::string_view text);

/// "line 3, column 14" of the byte at an offset, both counted from 1, for error messages.
std::string line_and_column(std::string_view text, std::size_t offset);

/// Where in a JSON text the value of a path such as "sensors[0].intrinsics.fx" begins, or where the
/// deepest part of it that is there does. Of a key that is there twice the last one counts. text
/// must be valid.
std::size_t json_offset(std::string_view text, std::string_view path);

/// The text of a JSON object with one member of it set to a value, itself JSON; all other bytes
/// stay. Of a key that is there twice the last one counts, as in the parser. text must be valid.
std::string with_json_member(std::string text, std::string_view key, std::string_view value);

}  // namespace turnscan::text
