#pragma once
// Depth images no finer than what is asked of them needs.

#include <turnscan/core/sequence_views.hpp>

namespace turnscan::workflow {

/// Calibrating gains from pixels up to here; all Kinects have fewer, and images of 1280x720.
constexpr double kPixelsToCalibrate = 1.6e6;
/// Whether a calibration holds is seen with so many; all Kinects have fewer, and images of 848x480.
constexpr double kPixelsToCheck = 0.5e6;

/// The sequence, which must outlive the view, with every n-th column and row of its depth images,
/// n the smallest number with which they have at most `most_pixels`. Where n is 1 it is the
/// sequence. Noise, mixed pixels and viewpoints stay as they are. Reduced frames have no colours.
SequenceView reduced_frames(const FrameSequence& sequence, double most_pixels = kPixelsToCalibrate);

/// Whether these frames would have fewer pixels than those for calibration.
bool are_coarser_for_checks(const SequenceHeader& header);

}  // namespace turnscan::workflow
