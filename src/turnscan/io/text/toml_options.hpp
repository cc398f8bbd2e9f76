#pragma once
// TOML files whose keys are options.

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <turnscan/core/option_table.hpp>

namespace turnscan::scene {

/// The file as a table. Fails with kNotFound, with kInvalidOption if it is not a file, longer than
/// 1 MB, has a line of more than 4096 bytes, a key of more than 32 parts or lists nested deeper
/// than 32, or is not TOML (naming file and line).
Result<toml::table> read_toml(const std::filesystem::path& path);

/// The same from a text; `path` is the name used in errors.
Result<toml::table> parse_toml(std::string_view text, const std::filesystem::path& path);

/// Error that names file and line.
tl::unexpected<Error> fail_in_toml(const std::filesystem::path& path, const toml::node& where,
                                   const std::string& message);

/// A value as it would be written on the command line: texts, numbers, true and false.
Result<std::string> toml_text(const std::filesystem::path& path, std::string_view key,
                              const toml::node& value);

/// Sets a field for each key of the table except those in `known`, which the caller reads. Fails
/// with kInvalidOption, naming file and line, for an unknown key or an invalid value.
Result<> set_from_toml(const std::filesystem::path& path, const toml::table& table,
                       const OptionTable& options, std::initializer_list<std::string_view> known);

}  // namespace turnscan::scene
