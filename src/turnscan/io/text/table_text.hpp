#pragma once
// Tables as spreadsheets of any country write them.

#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::text {

/// Text in UTF-8 without a byte order mark, from UTF-8, or from UTF-16 with a byte order mark.
/// Fails with kFormat if the text is neither.
Result<std::string> utf8_of(std::string_view bytes);

/// What separates the fields of a table by its first line: the most frequent of semicolon,
/// tabulator and comma, in this order where equal.
char delimiter_of(std::string_view header_line);

/// As parse_number(), also with a decimal comma.
Result<double> parse_decimal(std::string_view text);

/// The name of a column in lower case, without its unit: "Angle [deg]", "angle (deg)" and
/// "angle_deg" are "angle" in "deg".
struct ColumnName {
  std::string base;
  std::string unit;  ///< empty: none is stated
};
ColumnName column_name(std::string_view text);

}  // namespace turnscan::text
