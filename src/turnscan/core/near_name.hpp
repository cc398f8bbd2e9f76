#pragma once
// Suggests the name that a user may have meant.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace turnscan {

/// The nearest name in which at most a third of the letters differ, or of which `name` is a prefix.
std::optional<std::string> near_name(std::string_view name, const std::vector<std::string>& names);

}  // namespace turnscan
