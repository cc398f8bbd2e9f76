#pragma once
// Programs that turnscan uses where they are installed.

#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

/// Runs a program that is on the path, and returns what it wrote. Fails with kMissingData and the
/// text `missing` where there is none of that name, with kLibrary and its own words when it fails,
/// and as process::run_child().
Result<std::string> run_installed(const std::string& program,
                                  const std::vector<std::string>& arguments,
                                  std::string_view missing, double seconds,
                                  const RunContext& context, std::string_view input = {});

}  // namespace turnscan
