#pragma once
// Detects whether a triangulating depth camera fills depth that it cannot have measured.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

/// Share, 0 to 1, of the pixels beside foreground edges that one of the two eyes cannot see but
/// that have a depth nevertheless. A camera whose eyes are side by side, baseline_m apart, sees
/// beside the rim of a near surface (disparity d1 pixels) in front of a far one (d2) a strip of d1
/// - d2 pixels that is occluded from its other eye. Measured depth has a gap there, on one side of
/// the foreground; filled depth has none on either side. Examines the middle three fifths of such
/// strips, along the rows of at most 12 frames, on either side of all rims with d1 - d2 of 6 pixels
/// or more, and returns the smaller of the two shares.
///
/// nullopt if there are too few data: fewer than 200 rims on a side (a recording that was cropped,
/// nothing behind the object), no depth camera, a baseline that is not positive. Frames that cannot
/// be read are skipped. Fails only with kCancelled. The result does not depend on the number of
/// threads.
Result<std::optional<double>> filled_share(const FrameSequence& sequence, std::uint32_t sensor,
                                           double baseline_m, const RunContext& context);

}  // namespace turnscan
