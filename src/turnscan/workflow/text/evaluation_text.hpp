#pragma once

#include <string>
#include <turnscan/evaluation/evaluate.hpp>

namespace turnscan {

/// The figures as tables for people, in mm and percent.
std::string evaluation_text(const Evaluation& evaluation);

}  // namespace turnscan
