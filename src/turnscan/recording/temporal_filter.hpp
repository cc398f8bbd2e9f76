#pragma once
// Detects temporal smoothing by a depth camera from the noise of static pixels.

#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

/// Correlation of the noise of consecutive frames, 0 to 1, as caused by a first-order recursive
/// filter: 1 - a for a share a of the new frame. 0 for independent frames.
///
/// Uses 24 consecutive frames of the sensor, and 8 more over the whole sequence: a pixel is static
/// if the latter differ by no more than noise. For a static pixel's depth x, the mean squares of
/// the second differences x(t - k) - 2 x(t) + x(t + k), k = 1, 2 and 4, are 6 - 8 r^k + 2 r^2k
/// variances; r is the value that fits the medians of their ratios over the pixels.
///
/// nullopt if there are too few data: fewer than 240 frames, frames with poses of their own (the
/// sensor moved), too few static pixels (a recording that was cropped), noise below the depth step,
/// or ratios that no such filter produces. Frames that cannot be read are skipped. Fails only with
/// kCancelled. The result does not depend on the number of threads.
Result<std::optional<double>> temporal_correlation(const FrameSequence& sequence,
                                                   std::uint32_t sensor, const RunContext& context);

/// A sentence for display if the correlation of a sensor's noise is 0.3 or more; else nullopt.
Result<std::optional<std::string>> temporal_filter_note(const FrameSequence& sequence,
                                                        const RunContext& context);

}  // namespace turnscan
