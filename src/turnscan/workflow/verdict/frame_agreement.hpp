#pragma once
// Agreement of the frames of a scan with each other, from the fit of each to the mesh.

#include <optional>
#include <string>
#include <turnscan/workflow/verdict/frame_residuals.hpp>
#include <vector>

namespace turnscan {

/// Consecutive frames that are displaced from the others.
struct FramesApart {
  std::size_t first = 0, last = 0;  ///< positions among the residuals
  double off_m = 0.0;               ///< largest offset among them
};

struct FrameAgreement {
  std::size_t frames = 0;
  double usual_m = 0.0;   ///< median offset of a frame
  double most_m = 0.0;    ///< 95th percentile
  double spread_m = 0.0;  ///< median residual spread of a frame
  /// Median differences between the offsets of two frames: of consecutive frames, and of frames
  /// that view the object from the same direction one turn apart; nullopt: there are none.
  std::optional<double> neighbours_m, turn_apart_m;
  /// Differences between the median offsets of sensors, and of passes; of the two that differ most.
  std::optional<double> sensors_m, passes_m;
  std::vector<FramesApart> apart;  ///< sorted by time
};

/// A frame is displaced if its offset exceeds 1 mm, four times the median, and its own spread. Zero
/// frames: nothing is known.
FrameAgreement frame_agreement(const std::vector<FrameResidual>& residuals);

/// "3 frames at 12.1 to 12.4 s (4.2 mm)", for each entry of `apart`, three at most.
std::string frames_apart_text(const FrameAgreement& agreement,
                              const std::vector<FrameResidual>& residuals);

}  // namespace turnscan
