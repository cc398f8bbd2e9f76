#pragma once
// Surfel model of the object's surface, and its observations by the frames.

#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// A surface element. Sensor frame at angle 0, metres; n is a unit vector.
struct Surfel {
  Vec3d p, n;
};

/// Means of the key frames' samples that share a cell and an orientation, about max_surfels of
/// them; surface seen at grazing incidence, by few frames, or from all sides (a rim) is omitted.
std::vector<Surfel> make_surfels(const MotionData& data, const MotionState& state,
                                 std::size_t max_surfels);

/// A frame's distance from a surfel, along the surfel's normal.
struct SurfelObservation {
  std::uint32_t surfel;
  float distance_m;
  float incidence;  ///< weight by the incidence angle
  float weight;     ///< the same, reduced if the residual is large
};

class SurfelObservations {
 public:
  /// Intersects the rays of these frames (positions in data.frames) through the surfels, moved to
  /// the frame's angle, with its surface, within reach_m; inner_only: only within its outline. Sets
  /// all weights to 0.
  void observe(const MotionData& data, const MotionState& state,
               const std::vector<std::size_t>& frames, const std::vector<Surfel>& surfels,
               double reach_m, bool inner_only);

  /// Robustly estimates the mean heights of the surfels, and the weights with them. False if too
  /// little is seen.
  bool weigh();

  /// Per frame of observe().
  const std::vector<std::vector<SurfelObservation>>& per_frame() const { return observed_; }
  /// Residual of a distance after the surfel is moved to its mean height.
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
