#pragma once

#include <nlohmann/json_fwd.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>

namespace turnscan::workflow {

/// For reports: areas, text and poses.
nlohmann::ordered_json next_pass_json(const NextPassAdvice& advice);

}  // namespace turnscan::workflow
