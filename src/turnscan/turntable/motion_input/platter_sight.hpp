#pragma once
// How the platter lies in a single frame: a table that wobbles shows it there.

#include <Eigen/Core>
#include <optional>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan::motion {

/// The plane through what one depth image sees of a platter, relative to the one that was detected.
struct PlatterObservation {
  Vec3d axis = Vec3d::UnitY();  ///< its normal, unit, sensor frame
  double height_m = 0.0;        ///< along the detected axis, at the detected center
  double slope_sigma = 0.0;     ///< by the noise alone, of the worse direction, rad
};

/// Robust (Tukey) least squares over the pixels within the rim and near the plane. noise_m:
/// standard deviation of a depth. nullopt where too little of the platter is seen, as in a frame
/// that was cut out while recording.
std::optional<PlatterObservation> fit_platter(const DepthImage& depth, const SensorInfo& sensor,
                                              const RayTable& rays, const DetectedPlatter& platter,
                                              double noise_m);

/// How frames are turned so that a wobbling platter lies still in them.
struct Levelling {
  Vec3d axis = Vec3d::UnitY();  ///< the platter's then: the middle of the cone that it goes round
  std::vector<Pose> T_level_sensor;
};

/// By the platter as each frame shows it (nullopt: it does not); frames that do not are turned as
/// the nearest one. nullopt where it lies still: its tilts scatter by less than 0.1 degrees, or
/// hardly more than successive ones differ, or where a fifth of the frames do not show it.
std::optional<Levelling> level(const std::vector<std::optional<PlatterObservation>>& sights,
                               const DetectedPlatter& platter);

}  // namespace turnscan::motion
