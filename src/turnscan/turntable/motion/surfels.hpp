#pragma once
// A model of the turning object's surface: surfels, and what the frames see of them.

#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// A piece of the surface. Sensor frame at angle 0, metres; n is a unit vector.
struct Surfel {
  Vec3d p, n;
};

/// Means of the key frames' samples that share a cell and a side, about max_surfels of them; what
/// was seen at a low angle, by few, or from all sides (a rim), is left out.
std::vector<Surfel> make_surfels(const MotionData& data, const MotionState& state,
                                 std::size_t max_surfels);

/// A frame's distance from a surfel, along the surfel's normal.
struct SurfelObservation {
  std::uint32_t surfel;
  float distance_m;
  float incidence;  ///< weight by the angle of incidence
  float weight;     ///< the same, less where the residual is large
};

class SurfelObservations {
 public:
  /// Where the rays of these frames (positions in data.frames) through the surfels, moved to the
  /// frame's angle, meet its surface within reach_m; inner_only: within its outline.
  /// Weights are 0.
  void observe(const MotionData& data, const MotionState& state,
               const std::vector<std::size_t>& frames, const std::vector<Surfel>& surfels,
               double reach_m, bool inner_only);

  /// Finds the mean heights of the surfels, robustly, and the weights with that. False when too
  /// little is seen.
  bool weigh();

  /// Per frame of observe().
  const std::vector<std::vector<SurfelObservation>>& per_frame() const { return observed_; }
  /// What is left of a distance when the surfel is moved to its mean height.
  float residual(const SurfelObservation& o) const {
    return o.distance_m - float(height_[o.surfel]);
  }
  /// Robust standard deviation of the residuals, metres.
  double scale_m() const { return scale_m_; }

 private:
  std::vector<std::vector<SurfelObservation>> observed_;
  std::vector<double> height_;
  double scale_m_ = 0.0;
};

}  // namespace turnscan::motion
