#pragma once
// How a source of frames is named: SCHEME:ADDRESS?NAME=VALUE&NAME=VALUE

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

/// The scheme ends at the first ':', the address at the first '?'. %XX stands for a byte in address
/// and values; everything else stands for itself ('+', too). Text is at most 4096 bytes long.
/// Fails with kInvalidOption, in one line that says what is wrong: no scheme, a character that a
/// scheme cannot have, a parameter without '=' or without a name, one given twice, a '%' without
/// two hexadecimal digits, a byte 0.
Result<SourceUri> parse_source_uri(std::string_view text);

/// Text that parse_source_uri reads back as the same.
std::string format_source_uri(const SourceUri& uri);

/// Sets the fields of a table from the parameters. Flags may also be written 0 and 1. Fails with
/// kInvalidOption for a name that the table does not have (with the nearest one) and for a value
/// that does not fit or is out of range.
Result<> set_from_uri(const SourceUri& uri, const OptionTable& table);

}  // namespace turnscan
