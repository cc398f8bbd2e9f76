#pragma once
// Whether a recording comes back, after a turn, to the view that it had before.

#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

/// How far the same view, one turn later, lies from where the calibration puts it.
struct ClosureError {
  double turn_rad = 0.0;  ///< median turn about the axis that is missing; NaN where the shape does
                          ///< not show it
  double shift_m = 0.0;   ///< median of sqrt(3) times the root mean square of how far the object's
                          ///< points lie off along their normals
  double noise_m = 0.0;   ///< the same of a frame and the next one, less than 12 degrees on, which
                          ///< hardly more than noise sets apart; 0 where there are none
  std::size_t pairs = 0;  ///< pairs of frames that were compared
  /// Standard deviations of turn_rad, and of shift_m squared minus noise_m squared, from how the
  /// pairs and the neighbours differ among each other.
  double turn_sigma_rad = 0.0, excess_sigma_m2 = 0.0;
  /// Over 1.5 mm beyond the noise (squares), or 1 degree, and more than chance makes of so few
  /// pairs.
  bool significant() const;
  /// "2.31 mm and +0.42 deg", or without the turn where it is not known.
  std::string offset_text() const;
  /// "noise alone makes 0.31 mm", or that it was not measured.
  std::string noise_text() const;
};

/// Compares up to six pairs of frames whose angles, as recorded or from the recorded speed, differ
/// by one turn. nullopt where there are none, or where the object is not seen well enough.
/// Fails with kMissingData when the recording has no turntable or no angles, kCancelled, and what
/// reading fails with.
Result<std::optional<ClosureError>> measure_closure(const FrameSequence& sequence,
                                                    const RunContext& context,
                                                    PlatterMemory* memory = nullptr);

}  // namespace turnscan
