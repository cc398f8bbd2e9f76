#pragma once

#include <string>
#include <string_view>

namespace turnscan::file {

/// Makes an object's name valid in every format: one line of valid UTF-8, at most about 200 bytes;
/// invalid bytes become '?', control characters become spaces.
std::string clean_name(std::string_view name);

}  // namespace turnscan::file
