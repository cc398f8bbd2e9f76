#pragma once
// Whether the turntable is where a recording states it to be.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

/// Offset between the axis about which the frames fit each other and the recorded axis. Unlike the
/// closure error after a turn, which is small about any axis, it shows that the table or the sensor
/// was moved after calibration.
struct AxisOffset {
  double tilt_rad = 0.0;        ///< angle between the two axes
  double shift_m = 0.0;         ///< distance between them, at the object
  double tilt_sigma_rad = 0.0;  ///< standard deviations
  double shift_sigma_m = 0.0;
  std::size_t frames = 0;    ///< number of frames compared
  bool visible() const;      ///< over 1.5 mm or half a degree
  bool significant() const;  ///< visible, and over four standard deviations
};

/// From the recorded axis to another, with that one's standard deviations.
AxisOffset axis_offset_between(const TurntableInfo& recorded, const TurntableInfo& found,
                               double tilt_sigma_rad, double shift_sigma_m);

/// Compares up to 36 frames of the first sensor at the angles that the recording states. nullopt if
/// that sensor is not a depth camera (profiles of a line scanner do not overlap), if it covers less
/// than an eighth of a turn, if too little of an object is visible, or if the object's shape leaves
/// the axis undetermined, as a ball's does: another axis then fits no better than the recorded one.
/// Fails with kMissingData if the recording has no turntable or no angles, with kCancelled, and
/// with the errors of reading.
Result<std::optional<AxisOffset>> measure_axis_offset(const FrameSequence& sequence,
                                                      const RunContext& context,
                                                      PlatterMemory* memory = nullptr);

}  // namespace turnscan
