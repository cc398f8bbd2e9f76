#pragma once
// Options by name. The names and values are those of the command line, without the dashes, and of
// its configuration files; docs/reference/options.md lists them.

#include <optional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/units.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Names and values, e.g. {{"voxel-size", "1.5mm"}, {"colour", "true"}}. A quantity is written with
/// its unit. The value "auto" lets turnscan determine an option from the data, where the option
/// allows it. If a name occurs more than once, the last value applies, unless the option is
/// repeatable: then all of them do.
///
/// Functions that take options fail with ErrorCode::kInvalidOption for an unknown name, and for a
/// value that cannot be read or is out of range; the message says what is allowed.
using Options = std::vector<std::pair<std::string, std::string>>;

/// What a manual or a user interface needs to know about one option.
struct OptionDescription {
  std::string name;           ///< lower case with hyphens
  std::string help;           ///< one sentence
  std::string default_value;  ///< as text that can be given
  Quantity quantity = Quantity::kNone;
  std::optional<Range> range;        ///< inclusive limits in SI units; numbers only
  std::vector<std::string> choices;  ///< allowed values, where only some are
  bool is_flag = false;              ///< "true" or "false"
  bool may_be_auto = false;          ///< whether "auto" is allowed
  bool repeatable = false;           ///< whether it may be given more than once
};

}  // namespace turnscan
