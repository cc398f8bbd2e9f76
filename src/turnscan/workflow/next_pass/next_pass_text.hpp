#pragma once

#include <string>
#include <turnscan/workflow/next_pass/next_pass.hpp>

namespace turnscan {

/// "No view saw 63 cm2 of its surface of 512 cm2: base 31 cm2, sides 32 cm2."
std::string unseen_text(const UnseenSurface& unseen);

/// "lay it on its left side"; front is the side that the sensor saw in the pass's first frame.
std::string deed_text(const NextPose& pose);

/// What to do with the object: one sentence for people, in which front is the side that the sensor
/// saw in the pass's first frame.
std::string pose_text(const NextPose& pose, const std::string& pass);

/// Both in one line; where there is no pose it says that.
std::string next_pass_text(const NextPassAdvice& advice);

}  // namespace turnscan
