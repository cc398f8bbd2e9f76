#pragma once
// Lengths in the sentences of reports.

#include <string>
#include <turnscan/core/figure_text.hpp>

namespace turnscan {

inline std::string mm(double metres) { return length_text(metres); }

}  // namespace turnscan
