#pragma once

#include <string_view>

namespace turnscan::page {

/// The page's style sheet, for screens of any width and for print.
std::string_view style();

}  // namespace turnscan::page
