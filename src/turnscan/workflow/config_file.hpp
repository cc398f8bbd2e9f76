#pragma once

#include <deque>
#include <string>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// Sets fields from a TOML file. Keys are field names, at the top level or in a table with the name
/// of their group. Values are strings as on the command line ("1.5mm", "auto"), plain numbers where
/// a field has no unit, and true or false. On an error, fields before it stay set. Fails with
/// kInvalidOption, naming file and line, for an unknown key (suggesting the nearest existing one),
/// a key in the wrong table, an invalid value or text that is not TOML; with kNotFound if there is
/// no such file.
Result<> read_config_file(const std::string& path, const std::deque<OptionGroup>& groups);

}  // namespace turnscan
