#pragma once
// The files of a plan: scenes, pictures, the report.

#include <turnscan/core/image.hpp>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/workflow/plan/plan_search.hpp>

namespace turnscan::workflow {

/// Succeeds when plans can be written there: there is no such folder, it is empty, or it holds an
/// earlier run's plans, which are replaced. Fails with kAlreadyExists and kIo.
Result<> check_plan_folder(const std::string& folder);

/// Why the rest stays unseen, in a sentence.
std::string unseen_sentence(const CoverageMap& map);

/// An object, from above and from below, coloured by the error expected: blue over green to yellow,
/// which is three times the median and more; red is not seen well enough, grey not at all.
Result<ColorImage> plan_picture(const PlanField& field, std::size_t object, const Rig& rig,
                                const std::optional<double>& max_error_m,
                                const RunContext& context);

/// Whether a plan writes files of this name into its folder, beside the folder of its trials.
bool is_plan_file(const std::string& name);

/// The name of a plan's file: plan-K, or with several objects plan-K-N-NAME; NAME from the object.
std::string plan_file_name(const PlanRequest& request, std::size_t rank, std::size_t object);

}  // namespace turnscan::workflow
