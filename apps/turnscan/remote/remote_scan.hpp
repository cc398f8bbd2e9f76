#pragma once
// `turnscan scan --server` and `capture --server`: a scan on a rig elsewhere, whose files end here.

#include <turnscan/workflow/scan/scan.hpp>

#include "cli/command.hpp"
#include "cli/command_line.hpp"
#include "remote/remote_rig.hpp"

namespace turnscan::remote {

/// Fails with kInvalidOption if an option was given that is neither one of these nor one of all
/// commands: the rig has its own.
Result<> check_given(const cli::CommandLine& line, const std::vector<std::string>& here);

/// Answers for ScanHooks::another_side; empty: there is nobody to ask.
using Ask = std::function<Result<bool>(const std::string& advice, std::uint32_t pass)>;

/// Scans with the first device and the rig's own options; writes what the request names: mesh,
/// report, page, advice_picture, and the recording if it is named. Prints what a scan here prints.
/// Fails as the scan there did, as RemoteRig does, and for a request that cannot be written.
Result<> run_remote_scan(RemoteRig& rig, const ScanRequest& request, const Ask& ask,
                         cli::Session& session);

/// Records one pass, and copies it to the recording that is named. Prints what a capture here
/// prints; fails as run_remote_scan().
Result<> run_remote_capture(RemoteRig& rig, const ScanRequest& request, cli::Session& session);

}  // namespace turnscan::remote
