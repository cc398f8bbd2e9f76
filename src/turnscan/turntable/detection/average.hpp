#pragma once
// One scan from several of a scene that stands still: the input of calibration by picking and by
// detection (thesis 3.3.1, step 2).

#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

struct AverageOptions {
  int frames = 30;         ///< how many are averaged, at most
  double min_share = 0.3;  ///< of the frames in which a pixel must have a return to be valid
};
/// Fields average-frames, average-share.
OptionTable describe(AverageOptions& options);

/// Images of one size. The mean and the noise are over the frames in which a pixel had a return.
struct AveragedScan {
  CameraIntrinsics intrinsics;
  Image<float> depth_m;        ///< mean distance along z; 0 where not valid
  Image<float> noise_m;        ///< standard deviation of one frame (n - 1); NaN where n < 2
  Image<std::uint16_t> count;  ///< frames with a return there
  std::size_t frames = 0;

  /// Noise of what stands still: from the lower quartile of the valid pixels, since what moves may
  /// fill most of the image; 0 with one frame.
  double typical_noise_m() const;
};

/// Averages the frames at these positions of the sequence, which must be depth images of one
/// sensor. The same bytes for any number of threads and any order of positions. Fails with
/// kUnsupported when the sensor gives points, kTooFewPoints without a position or when no pixel is
/// valid, kInvalidOption, kFormat when sizes do not fit, kCancelled, and what reading fails with.
Result<AveragedScan> average_frames(const FrameSequence& sequence,
                                    const std::vector<std::size_t>& positions,
                                    const AverageOptions& options, const RunContext& context);

/// Positions of at most `count` frames of a sensor that are not dropped, spread evenly.
std::vector<std::size_t> spread_positions(const FrameSequence& sequence, std::uint32_t sensor,
                                          std::size_t count);

/// The valid pixels as points, sensor frame.
FramePoints points_of(const AveragedScan& scan);

}  // namespace turnscan
