#pragma once

#include <string>
#include <turnscan/reconstruction/verdict.hpp>

namespace turnscan {

/// "Verdict: GREEN" and a line for each sentence.
std::string verdict_text(const Verdict& verdict);

}  // namespace turnscan
