#pragma once

#include <turnscan/workflow/page/page_fields.hpp>
#include <turnscan/workflow/page/report_facts.hpp>
#include <turnscan/workflow/page/svg_plot.hpp>

namespace turnscan::page {

/// Of expected error and deviation, as far as they are known: how they are distributed over the
/// surface, and over height and direction; of the turn its speed; of each object how its frames
/// fit.
std::vector<Plot> plots_of(const PageInput& input, const std::vector<Field>& fields,
                           const ReportFacts& facts);

}  // namespace turnscan::page
