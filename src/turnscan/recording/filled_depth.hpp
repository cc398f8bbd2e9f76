#pragma once
// Whether a depth camera that triangulates fills what it cannot have measured.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

/// Of the pixels that one of the two eyes cannot see, beside what stands out, the share that have a
/// depth all the same, 0 to 1. A camera whose eyes stand side by side, baseline_m apart, sees
/// beside the rim of a near surface (disparity d1 pixels) before a far one (d2) a strip of d1 - d2
/// pixels that is hidden from its other eye. Measured depth has a gap there, on one side of what is
/// near; depth that was filled has none on either side. So the middle three fifths of such strips
/// are looked at, along the rows of at most 12 frames, on either side of all rims with d1 - d2 of 6
/// pixels or more, and the smaller of the two shares counts.
///
/// Nothing where too little tells: fewer than 200 rims on a side (a recording that was cropped,
/// nothing behind the object), no depth camera, a baseline that is not positive. Frames that cannot
/// be read are passed over. Fails only with kCancelled. The same for any number of threads.
Result<std::optional<double>> filled_share(const FrameSequence& sequence, std::uint32_t sensor,
                                           double baseline_m, const RunContext& context);

}  // namespace turnscan
