#pragma once
// What a device did to its depth before anybody got it, told from the frames.

#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

/// A sentence where a sensor smooths over time (temporal_filter_note()), and one for each sensor
/// whose model is that of a preset that triangulates and that fills what one of its two eyes cannot
/// have seen (filled_share() of 0.7 or more). Fails only with kCancelled.
Result<std::vector<std::string>> device_notes(const FrameSequence& sequence,
                                              const RunContext& context);

/// Only the latter.
Result<std::vector<std::string>> filled_depth_notes(const FrameSequence& sequence,
                                                    const RunContext& context);

}  // namespace turnscan
