#pragma once
// Which name somebody may have meant.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace turnscan {

/// The nearest of the names of which at most a third of the letters differ, or which begin so.
std::optional<std::string> near_name(std::string_view name, const std::vector<std::string>& names);

}  // namespace turnscan
