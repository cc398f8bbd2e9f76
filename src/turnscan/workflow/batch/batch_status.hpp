#pragma once

#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// How a batch stands, for people: counts, what runs where, why tasks failed, how long the rest may
/// take. Looks at no input: a task that has changed since still counts as done. Fails as opening
/// the batch does.
Result<std::string> batch_status_text(const std::string& folder);

}  // namespace turnscan
