#pragma once
// Separates moving foreground from static background in depth images of a camera at rest.

#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::motion {

/// Images of some frames, and what is derived from all of them. Sizes in pixels, depths in metres.
struct Background {
  int width = 0, height = 0;
  /// Per pixel: returns nearer than this belong to the moving part; 0 where nothing moves. Infinite
  /// where no static surface is ever seen.
  std::vector<float> nearer_than;
  double noise_m = 0.0;  ///< standard deviation of a depth value on the moving part
};

/// Noise estimated from differences between pixels, metres; 0 if it cannot be estimated.
struct SpatialNoise {
  double sigma_m = 0.0;       ///< of a depth value
  double neighbours_m = 0.0;  ///< the same from adjacent pixels: smaller if these share noise
  /// Whether neighbouring pixels share noise, as behind the spatial filters of time-of-flight
  /// cameras and stereo.
  bool correlated() const { return neighbours_m < 0.85 * sigma_m; }
};

/// Noise of these frames (positions); works without any static background. Fails with kCancelled
/// and with the errors of reading.
Result<SpatialNoise> spatial_noise(const FrameSequence& sequence,
                                   const std::vector<std::size_t>& positions,
                                   const RunContext& context);

/// Separates moving from static pixels in these frames (positions) of a depth camera. A pixel is
/// moving if its depth changes by more than noise, or comes and goes. The static background behind
/// it is the farthest depth that it shows more than once; if frames were cropped to the object,
/// wide patches that are visible now and then, and what continues them. Isolated flickering pixels
/// and small patches are ignored. noise_m: approximate standard deviation of a depth value. Fails
/// with kTooFewPoints if nothing moves, with kCancelled, and with the errors of reading.
Result<Background> find_background(const FrameSequence& sequence,
                                   const std::vector<std::size_t>& positions, double noise_m,
                                   const RunContext& context);

}  // namespace turnscan::motion
