#pragma once

#include <deque>
#include <string>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// Sets fields from a TOML file. Keys are field names, at the top or under a table with the name of
/// their group. Values are strings as on the command line ("1.5mm", "auto"), plain numbers where a
/// field has no unit, and true or false. Fields that came before an error are set. Fails with
/// kInvalidOption naming file and line for an unknown key (with the nearest one that exists), a key
/// in the wrong table, a value that does not fit or text that is not TOML; with kNotFound when
/// there is no such file.
Result<> read_config_file(const std::string& path, const std::deque<OptionGroup>& groups);

}  // namespace turnscan
