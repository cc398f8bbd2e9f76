#pragma once
// Subsampled depth images, with no more pixels than a task needs.

#include <turnscan/core/sequence_views.hpp>

namespace turnscan::workflow {

/// Calibration does not benefit from more pixels; all Kinects have fewer, and so do images of
/// 1280x720.
constexpr double kPixelsToCalibrate = 1.6e6;
/// Sufficient to check a calibration; all Kinects have fewer, and so do images of 848x480.
constexpr double kPixelsToCheck = 0.5e6;

/// View of the sequence, which must outlive it, with every n-th column and row of its depth images;
/// n is the smallest number for which they have at most `most_pixels`. For n = 1 it is the sequence
/// itself. Noise, mixed pixels and viewpoints are unchanged. Reduced frames have no colours.
SequenceView reduced_frames(const FrameSequence& sequence, double most_pixels = kPixelsToCalibrate);

/// Whether frames reduced for checks would have fewer pixels than those reduced for calibration.
bool are_coarser_for_checks(const SequenceHeader& header);

}  // namespace turnscan::workflow
