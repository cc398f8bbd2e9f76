#pragma once
// Files of a plan: scenes, pictures, the report.

#include <turnscan/core/image.hpp>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/workflow/plan/plan_search.hpp>

namespace turnscan::workflow {

/// Succeeds if plans can be written there: the folder does not exist, is empty, or contains the
/// plans of an earlier run, which are replaced. Fails with kAlreadyExists and kIo.
Result<> check_plan_folder(const std::string& folder);

/// One sentence on why the rest is not seen.
std::string unseen_sentence(const CoverageMap& map);

/// Picture of an object, from above and from below, coloured by the expected error: blue over green
/// to yellow, which is three times the median or more; red is not seen well enough, grey not at
/// all.
Result<ColorImage> plan_picture(const PlanField& field, std::size_t object, const Rig& rig,
                                const std::optional<double>& max_error_m,
                                const RunContext& context);

/// Whether plans write files of this name into their folder; the folder of trials is not one.
bool is_plan_file(const std::string& name);

/// Name of a plan's file: plan-K, or for several objects plan-K-N-NAME; NAME is the object's.
std::string plan_file_name(const PlanRequest& request, std::size_t rank, std::size_t object);

}  // namespace turnscan::workflow
