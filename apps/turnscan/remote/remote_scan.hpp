#pragma once
// `turnscan scan --server`: a scan on a rig elsewhere, whose files end here.

#include <turnscan/workflow/scan/scan.hpp>

#include "cli/command.hpp"
#include "remote/remote_rig.hpp"

namespace turnscan::remote {

/// Answers for ScanHooks::another_side; empty: there is nobody to ask.
using Ask = std::function<Result<bool>(const std::string& advice, std::uint32_t pass)>;

/// Scans with the first device and the rig's own options; writes what the request names: mesh,
/// report, page, advice_picture, and the recording if it is named. Prints what a scan here prints.
/// Fails as the scan there did, as RemoteRig does, and for a request that cannot be written.
Result<> run_remote_scan(RemoteRig& rig, const ScanRequest& request, const Ask& ask,
                         cli::Session& session);

}  // namespace turnscan::remote
