#pragma once

#include <turnscan/workflow/page/page_fields.hpp>
#include <turnscan/workflow/page/report_facts.hpp>
#include <turnscan/workflow/page/svg_plot.hpp>

namespace turnscan::page {

/// Plots of expected error and deviation, as far as they are known: distribution over the surface,
/// and over height and direction; the speed over the turn; the fit of the frames of each object.
std::vector<Plot> plots_of(const PageInput& input, const std::vector<Field>& fields,
                           const ReportFacts& facts);

}  // namespace turnscan::page
