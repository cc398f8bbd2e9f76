#pragma once

#include <string>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/verdict.hpp>

namespace turnscan {

/// The verdict and the notes, then what was made, which parameters were used and why, and how long
/// it took, as human-readable ASCII tables.
std::string reconstruction_text(const Reconstruction& reconstruction);

/// "Verdict: GREEN" and one line per sentence.
std::string verdict_text(const Verdict& verdict);

}  // namespace turnscan
