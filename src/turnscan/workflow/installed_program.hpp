#pragma once
// Optional external programs.

#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

/// Runs a program found on the path, and returns its output. Fails with kMissingData and the text
/// `missing` if there is no such program, with kLibrary and the program's message if it fails, and
/// as process::run_child().
Result<std::string> run_installed(const std::string& program,
                                  const std::vector<std::string>& arguments,
                                  std::string_view missing, double seconds,
                                  const RunContext& context, std::string_view input = {});

}  // namespace turnscan
