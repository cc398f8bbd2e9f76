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

/// The text of a JSON object with one member of it set to a value, itself JSON; all other bytes
/// stay. Of a key that is there twice the last one counts, as in the parser. text must be valid.
std::string with_json_member(std::string text, std::string_view key, std::string_view value);

}  // namespace turnscan::text
