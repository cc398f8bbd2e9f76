#pragma once
// Sections of a page, as HTML. They escape all texts.

#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/workflow/page/page.hpp>
#include <turnscan/workflow/page/report_facts.hpp>

namespace turnscan::page {

/// Empty if the report has no verdict.
std::string verdict_section(const PageInput& input, const ReportFacts& facts);
/// Container of the 3D view, hidden until the viewer shows it.
std::string view_section();
/// Pictures of all objects from six sides, as JPEG. Fails as render_picture().
Result<std::string> pictures_section(const PageInput& input, const RunContext& context);
Result<std::string> dimensions_section(const PageInput& input, const RunContext& context);
/// Empty without a comparison.
std::string comparison_section(const PageInput& input);
/// Empty without elements.
std::string elements_section(const PageInput& input);
std::string plots_section(const PageInput& input, const ReportFacts& facts);
/// Statistics of the scan, parameters with their reasons, notes. Empty if the report has none.
std::string making_section(const ReportFacts& facts);

}  // namespace turnscan::page
