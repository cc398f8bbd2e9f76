#pragma once

#include <string>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan {

/// JSON report of a reconstruction: counts, choices, times, mesh checks, peak memory, version.
std::string report_json(const Reconstruction& reconstruction, const ReconstructOptions& options);

}  // namespace turnscan
