#pragma once

#include <string>
#include <turnscan/workflow/next_pass/next_pass.hpp>

namespace turnscan {

/// "No view saw 63 cm2 of its surface of 512 cm2: base 31 cm2, sides 32 cm2."
std::string unseen_text(const UnseenSurface& unseen);

/// "lay it on its left side"; front is the side facing the sensor in the pass's first frame.
std::string deed_text(const NextPose& pose);

/// Instruction for the user in one sentence; front is the side facing the sensor in the pass's
/// first frame.
std::string pose_text(const NextPose& pose, const std::string& pass);

/// Both texts in one line; says so if there is no pose.
std::string next_pass_text(const NextPassAdvice& advice);

}  // namespace turnscan
