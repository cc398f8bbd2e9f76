#pragma once
// Depth images no finer than calibration needs them.

#include <turnscan/core/sequence_views.hpp>

namespace turnscan::workflow {

/// The sequence, which must outlive the view, with every n-th column and row of its depth images,
/// n the smallest number with which they have at most 1.6 million pixels. Where n is 1, as for all
/// Kinects and for images of 1280x720, it is the sequence. Noise, mixed pixels and viewpoints stay
/// as they are. Reduced frames have no colours.
SequenceView reduced_frames(const FrameSequence& sequence);

}  // namespace turnscan::workflow
