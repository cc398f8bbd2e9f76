#pragma once

#include <string>
#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

/// What was made, which parameters were used and why, and how long it took: a few tables for
/// people, lines of ASCII.
std::string reconstruction_text(const Reconstruction& reconstruction);

}  // namespace turnscan
