#pragma once
// What moves before what stands still, in depth images from a camera at rest.

#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::motion {

/// Images of some frames, and what is told from all of them. Sizes in pixels, depths in metres.
struct Background {
  int width = 0, height = 0;
  /// Per pixel: returns nearer than this belong to what moves; 0 where nothing moves. Infinite
  /// where nothing that stands still is ever seen.
  std::vector<float> nearer_than;
  double noise_m = 0.0;  ///< standard deviation of a depth value on what moves
};

/// Noise as differences between pixels show it, metres; 0 where it cannot be told.
struct SpatialNoise {
  double sigma_m = 0.0;       ///< of a depth value
  double neighbours_m = 0.0;  ///< the same from pixels side by side: less where these share noise
  /// As behind a filter over neighbouring pixels, which time-of-flight cameras and stereo have.
  bool correlated() const { return neighbours_m < 0.85 * sigma_m; }
};

/// Of these frames (positions), also where nothing stands still. Fails with kCancelled, and what
/// reading fails with.
Result<SpatialNoise> spatial_noise(const FrameSequence& sequence,
                                   const std::vector<std::size_t>& positions,
                                   const RunContext& context);

/// From these frames (positions) of a depth camera. A pixel shows something that moves when its
/// depth changes by more than noise, or comes and goes; what stands still behind it is the farthest
/// depth that it shows more than once; where frames were cut to the object, what shows wide patches
/// of now and then, and what continues it. Lone flickering pixels and small patches do not count.
/// noise_m: standard deviation of a depth value, about. Fails with kTooFewPoints when nothing
/// moves, kCancelled, and what reading fails with.
Result<Background> find_background(const FrameSequence& sequence,
                                   const std::vector<std::size_t>& positions, double noise_m,
                                   const RunContext& context);

}  // namespace turnscan::motion
