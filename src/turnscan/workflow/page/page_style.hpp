#pragma once

#include <string_view>

namespace turnscan::page {

/// The page's style sheet: on a screen of any width, and on paper.
std::string_view style();

}  // namespace turnscan::page
