#pragma once
// URI of a source of frames: SCHEME:ADDRESS?NAME=VALUE&NAME=VALUE

#include <string>
#include <string_view>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <utility>
#include <vector>

namespace turnscan {

struct SourceUri {
  std::string scheme;                                           ///< lower case
  std::string address;                                          ///< may be empty
  std::vector<std::pair<std::string, std::string>> parameters;  ///< in order, decoded
};

/// The scheme ends at the first ':', the address at the first '?'. %XX encodes a byte in address
/// and values; all other characters are literal (including '+'). The text has at most 4096 bytes.
/// Fails with kInvalidOption and a one-line message: no scheme, a character not allowed in a
/// scheme, a parameter without '=' or without a name, a duplicate parameter, a '%' without two
/// hexadecimal digits, a zero byte.
Result<SourceUri> parse_source_uri(std::string_view text);

/// Formats the URI; parse_source_uri() reads the same back.
std::string format_source_uri(const SourceUri& uri);

/// Sets the fields of a table from the parameters. Flags may also be written as 0 and 1. Fails with
/// kInvalidOption for a name that the table does not have (suggesting the nearest one) and for a
/// value that is invalid or out of range.
Result<> set_from_uri(const SourceUri& uri, const OptionTable& table);

}  // namespace turnscan
