#pragma once
// Loop closure of a recording: whether the view of one turn earlier comes back.

#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan {

/// Offset between the same view one turn later and the pose that the calibration predicts for it.
struct ClosureError {
  double turn_rad = 0.0;  ///< median missing rotation about the axis; NaN if the shape does not
                          ///< determine it
  double shift_m = 0.0;   ///< median of sqrt(3) times the root mean square of the point-to-plane
                          ///< distances of the object's points
  double noise_m = 0.0;   ///< the same between a frame and the next one, less than 12 degrees on,
                          ///< which differ by hardly more than noise; 0 if there are no such frames
  std::size_t pairs = 0;  ///< number of pairs of frames compared
  /// Standard deviations of turn_rad, and of shift_m squared minus noise_m squared, from the
  /// scatter among the pairs and among the neighbours.
  double turn_sigma_rad = 0.0, excess_sigma_m2 = 0.0;
  /// Whether the error exceeds the noise by more than 1.5 mm (difference of squares), or 1 degree,
  /// and is larger than chance explains for so few pairs.
  bool significant() const;
  /// "2.31 mm and +0.42 deg"; the rotation is omitted if it is not known.
  std::string offset_text() const;
  /// "noise alone makes 0.31 mm", or a statement that it was not measured.
  std::string noise_text() const;
};

/// Compares up to six pairs of frames whose angles, as recorded or from the recorded speed, differ
/// by one turn. nullopt if there are no such pairs, or if the object is not seen well enough. Fails
/// with kMissingData if the recording has no turntable or no angles, with kCancelled, and with the
/// errors of reading.
Result<std::optional<ClosureError>> measure_closure(const FrameSequence& sequence,
                                                    const RunContext& context,
                                                    PlatterMemory* memory = nullptr);

}  // namespace turnscan
