#pragma once

#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

/// Names of the options that are not at their defaults although the method does not look at them.
std::vector<std::string> unused_options(const ReconstructOptions& options);

}  // namespace turnscan
