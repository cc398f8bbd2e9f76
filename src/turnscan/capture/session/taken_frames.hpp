#pragma once
// Frames of a source, held in memory.

#include <memory>
#include <turnscan/capture/source/frame_source.hpp>

namespace turnscan {

/// How long take_frames() waits for a frame before it gives a device up.
inline constexpr double kPatience_s = 5.0;

/// Takes the next `count` frames of each sensor (lost ones do not count), or all until the source
/// ends. Starts the source if need be and stops it. Fails with kDeviceLost when no frame comes for
/// kPatience_s, kTooFewPoints when it ends without one, and as start() and next().
Result<std::unique_ptr<FrameSequence>> take_frames(FrameSource& source, std::size_t count,
                                                   const RunContext& context);

}  // namespace turnscan
