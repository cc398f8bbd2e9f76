#pragma once
// Averages frames of a static scene into one scan, the input of calibration by picked points and by
// detection (thesis 3.3.1, step 2).

#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

struct AverageOptions {
  int frames = 30;         ///< maximum number of frames averaged
  double min_share = 0.3;  ///< share of the frames in which a pixel must have a return to be valid
};
/// Fields average-frames, average-share.
OptionTable describe(AverageOptions& options);

/// Images of one size. Mean and noise are over the frames in which a pixel had a return.
struct AveragedScan {
  CameraIntrinsics intrinsics;
  Image<float> depth_m;        ///< mean distance along z; 0 where not valid
  Image<float> noise_m;        ///< standard deviation of a single frame (n - 1); NaN if n < 2
  Image<std::uint16_t> count;  ///< number of frames with a return
  std::size_t frames = 0;

  /// Noise of the static scene: from the lower quartile of the valid pixels, since moving parts may
  /// fill most of the image; 0 with one frame.
  double typical_noise_m() const;
};

/// Averages the frames at these positions of the sequence, which must be depth images of one
/// sensor. The result is identical for any number of threads and any order of positions. Fails with
/// kUnsupported if the sensor delivers points, with kTooFewPoints if there is no position or no
/// valid pixel, with kInvalidOption, with kFormat if sizes do not match, with kCancelled, and with
/// the errors of reading.
Result<AveragedScan> average_frames(const FrameSequence& sequence,
                                    const std::vector<std::size_t>& positions,
                                    const AverageOptions& options, const RunContext& context);

/// Evenly spaced positions of at most `count` frames of a sensor that are not dropped.
std::vector<std::size_t> spread_positions(const FrameSequence& sequence, std::uint32_t sensor,
                                          std::size_t count);

/// The valid pixels as points in the sensor frame.
FramePoints points_of(const AveragedScan& scan);

}  // namespace turnscan
