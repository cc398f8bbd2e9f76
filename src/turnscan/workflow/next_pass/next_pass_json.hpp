#pragma once

#include <nlohmann/json_fwd.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>

namespace turnscan::workflow {

/// Areas, text and poses for reports.
nlohmann::ordered_json next_pass_json(const NextPassAdvice& advice);

}  // namespace turnscan::workflow
