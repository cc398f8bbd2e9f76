#pragma once
// How well the frames of a scan agree with each other, from how each fits the mesh.

#include <optional>
#include <string>
#include <turnscan/workflow/verdict/frame_residuals.hpp>
#include <vector>

namespace turnscan {

/// Frames in a row that lie elsewhere than the rest.
struct FramesApart {
  std::size_t first = 0, last = 0;  ///< positions among the residuals
  double off_m = 0.0;               ///< the largest of them
};

struct FrameAgreement {
  std::size_t frames = 0;
  double usual_m = 0.0;   ///< median of how far a frame lies off
  double most_m = 0.0;    ///< 95th percentile
  double spread_m = 0.0;  ///< median spread of a frame's measurements
  /// Medians of how differently two frames lie off: of frames next to each other, and of frames
  /// that look from the same place a turn apart; nullopt: there are none.
  std::optional<double> neighbours_m, turn_apart_m;
  /// How differently sensors, and passes, lie off in the median, the two that differ most.
  std::optional<double> sensors_m, passes_m;
  std::vector<FramesApart> apart;  ///< in order of time
};

/// A frame lies elsewhere when it is off by more than 1 mm, four times the median, and its own
/// spread. Zero frames: nothing is known.
FrameAgreement frame_agreement(const std::vector<FrameResidual>& residuals);

/// "3 frames at 12.1 to 12.4 s (4.2 mm)", one for each of `apart`, three at most.
std::string frames_apart_text(const FrameAgreement& agreement,
                              const std::vector<FrameResidual>& residuals);

}  // namespace turnscan
