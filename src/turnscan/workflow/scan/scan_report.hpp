#pragma once

#include <string>
#include <turnscan/workflow/scan/scan.hpp>

namespace turnscan::workflow {

/// JSON report of what was recorded and reconstructed; it ends with a line break.
std::string scan_report(const ScanRequest& request, const ScanOutcome& outcome,
                        const SourceInfo& source);

}  // namespace turnscan::workflow
