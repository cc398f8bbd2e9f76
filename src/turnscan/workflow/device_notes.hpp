#pragma once
// Detects from the frames what a device did to its depth before delivering it.

#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

/// One sentence if a sensor smooths over time (temporal_filter_note()), and one for each sensor
/// whose model is that of a triangulating preset and which fills areas that one of its two cameras
/// cannot have seen (filled_share() of 0.7 or more). Fails only with kCancelled.
Result<std::vector<std::string>> device_notes(const FrameSequence& sequence,
                                              const RunContext& context);

/// Only the notes on filled depth.
Result<std::vector<std::string>> filled_depth_notes(const FrameSequence& sequence,
                                                    const RunContext& context);

}  // namespace turnscan
