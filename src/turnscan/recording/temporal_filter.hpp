#pragma once
// Whether a depth camera smooths over time, told from the noise of pixels on which nothing moves.

#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

/// The noise of one frame's correlation with the next one's, 0 to 1, as a recursive filter of first
/// order leaves it: with a share a of the new frame it is 1 - a. Independent frames have 0.
///
/// Looks at 24 frames in a row of the sensor, and at 8 more over the whole sequence: a pixel is
/// still where the latter differ by no more than noise. Of a still pixel's depth x the mean squares
/// of the second differences x(t - k) - 2 x(t) + x(t + k), k = 1, 2 and 4, are 6 - 8 r^k + 2 r^2k
/// variances; r is what fits the medians of their ratios over the pixels.
///
/// Nothing where too little tells: fewer than 240 frames, frames with poses of their own (the
/// sensor moved), too few still pixels (a recording that was cropped), noise below the step of
/// depth, or ratios that no such filter makes. Frames that cannot be read are passed over. Fails
/// only with kCancelled. The same for any number of threads.
Result<std::optional<double>> temporal_correlation(const FrameSequence& sequence,
                                                   std::uint32_t sensor, const RunContext& context);

/// A sentence for people where the correlation of a sensor's noise is 0.3 or more; else nothing.
Result<std::optional<std::string>> temporal_filter_note(const FrameSequence& sequence,
                                                        const RunContext& context);

}  // namespace turnscan
