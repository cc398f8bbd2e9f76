#pragma once

#include <string>
#include <turnscan/evaluation/artefact.hpp>
#include <turnscan/evaluation/evaluate.hpp>

namespace turnscan {

/// Evaluation results as human-readable tables, in mm and percent.
std::string evaluation_text(const Evaluation& evaluation);
std::string artefact_text(const ArtefactFigures& figures);

}  // namespace turnscan
