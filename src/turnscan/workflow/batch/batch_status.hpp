#pragma once

#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Human-readable status of a batch: counts, what runs where, why tasks failed, estimated remaining
/// time. Does not check the inputs: a task that has changed since still counts as done. Fails as
/// opening the batch does.
Result<std::string> batch_status_text(const std::string& folder);

}  // namespace turnscan
