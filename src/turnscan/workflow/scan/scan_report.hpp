#pragma once

#include <string>
#include <turnscan/workflow/scan/scan.hpp>

namespace turnscan::workflow {

/// JSON of what was recorded and reconstructed; it ends with a line break.
std::string scan_report(const ScanRequest& request, const ScanOutcome& outcome,
                        const SourceInfo& source);

/// The page that the request names, of all passes so far. report: scan_report() of them; found:
/// what took the place of the recorded calibration. Fails as Recording::open() and write_page().
Result<> write_scan_page(const ScanRequest& request, const ScanOutcome& outcome,
                         const std::string& report, const std::optional<Calibration>& found,
                         const RunContext& context);

}  // namespace turnscan::workflow
