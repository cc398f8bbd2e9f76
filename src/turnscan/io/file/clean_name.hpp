#pragma once

#include <string>
#include <string_view>

namespace turnscan::file {

/// The name of an object so that every format can hold it: one line of valid UTF-8, at most
/// about 200 bytes; what does not fit becomes '?', control characters become spaces.
std::string clean_name(std::string_view name);

}  // namespace turnscan::file
