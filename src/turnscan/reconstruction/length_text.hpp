#pragma once
// Lengths in the sentences of reports.

#include <string>
#include <turnscan/core/units.hpp>

namespace turnscan {

inline std::string mm(double metres) { return format_quantity(metres, Quantity::kLength); }

}  // namespace turnscan
