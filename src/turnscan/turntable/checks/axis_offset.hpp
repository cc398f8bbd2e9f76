#pragma once
// Whether the turntable is where a recording says.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

/// How far the axis about which the frames fit each other lies from the recorded one. Unlike the
/// closure after a turn, which is right about any axis, it shows a table or a sensor that was moved
/// after it was calibrated.
struct AxisOffset {
  double tilt_rad = 0.0;        ///< between the two axes
  double shift_m = 0.0;         ///< between them beside the object
  double tilt_sigma_rad = 0.0;  ///< standard deviations
  double shift_sigma_m = 0.0;
  std::size_t frames = 0;    ///< that were compared
  bool significant() const;  ///< over 1.5 mm or half a degree, and over four standard deviations
};

/// Compares up to 36 frames of the first sensor at the angles that the recording states. nullopt
/// where that is no depth camera (profiles of a line scanner do not overlap), where it shows less
/// than an eighth of a turn, too little of an object, or one whose shape leaves the axis open, as a
/// ball's does: another axis fits no better than the recorded one. Fails with kMissingData when the
/// recording has no turntable or no angles, kCancelled, and what reading fails with.
Result<std::optional<AxisOffset>> measure_axis_offset(const FrameSequence& sequence,
                                                      const RunContext& context,
                                                      PlatterMemory* memory = nullptr);

}  // namespace turnscan
