#pragma once
// Frames of a source, held in memory.

#include <memory>
#include <turnscan/capture/source/frame_source.hpp>

namespace turnscan {

/// How long take_frames() waits for a frame before it gives up on a device.
inline constexpr double kPatience_s = 5.0;

/// Takes the next `count` frames of each sensor (dropped ones do not count), or all until the
/// source ends. Starts the source if necessary and stops it. Fails with kDeviceLost if no frame
/// arrives for kPatience_s, kTooFewPoints if it ends without one, and as start() and next().
Result<std::unique_ptr<FrameSequence>> take_frames(FrameSource& source, std::size_t count,
                                                   const RunContext& context);

}  // namespace turnscan
