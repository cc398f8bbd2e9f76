#pragma once
// The file of `turnscan evaluate --elements`: which elements to fit, and what to report about them.
// docs/reference/evaluation.md describes it.

#include <filesystem>
#include <string_view>
#include <turnscan/core/run_context.hpp>
#include <turnscan/evaluation/elements/elements.hpp>

namespace turnscan::workflow {

/// Fails with kFormat; the message names the element, or line and column.
Result<ElementPlan> parse_elements(std::string_view json, const RunContext& context);
/// The same for a file, whose path the errors have. Also fails as read_file().
Result<ElementPlan> read_elements(const std::filesystem::path& path, const RunContext& context);

}  // namespace turnscan::workflow
