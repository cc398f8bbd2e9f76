#pragma once

#include <string>

namespace turnscan::text {

/// A field of a table for people, quoted if necessary: on one line, and no spreadsheet takes it for
/// a formula (it begins with an apostrophe if one would).
std::string sheet_field(std::string text);

}  // namespace turnscan::text
