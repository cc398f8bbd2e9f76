#pragma once
// From options by name to the fields of the option tables.

#include <string_view>
#include <turnscan/api/options.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::api {

/// Options that may be given more than once, which a table cannot hold, beside those of a table.
struct RepeatableOption {
  std::string name, help;
};

/// The values of an option in their order; they are removed from the options.
std::vector<std::string> take(Options& options, std::string_view name);

/// Sets the fields of the table. Fails with kInvalidOption as OptionTable::set() does.
Result<> set_fields(const OptionTable& table, const Options& options);

std::vector<OptionDescription> describe_fields(const OptionTable& table,
                                               const std::vector<RepeatableOption>& more = {});

}  // namespace turnscan::api
