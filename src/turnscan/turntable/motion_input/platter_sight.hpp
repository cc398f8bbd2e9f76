#pragma once
// Pose of the platter in a single frame, which reveals a wobbling table.

#include <optional>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/eigen.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan::motion {

/// The plane through a platter's pixels in one depth image, relative to the detected platter.
struct PlatterObservation {
  Vec3d axis = Vec3d::UnitY();  ///< its normal, unit, sensor frame
  double height_m = 0.0;        ///< along the detected axis, at the detected center
  double slope_sigma = 0.0;     ///< from the noise alone, in the worse direction, rad
};

/// Robust (Tukey) least squares over the pixels within the rim and near the plane. noise_m:
/// standard deviation of a depth value. nullopt if too little of the platter is seen, as in a frame
/// that was cropped while recording.
std::optional<PlatterObservation> fit_platter(const DepthImage& depth, const SensorInfo& sensor,
                                              const RayTable& rays, const DetectedPlatter& platter,
                                              double noise_m);

/// Rotations of the frames in which a wobbling platter is at rest.
struct Levelling {
  Vec3d axis = Vec3d::UnitY();  ///< the platter's after levelling: the middle of the cone that it
                                ///< describes
  std::vector<Pose> T_level_sensor;
};

/// Levels each frame by its observation of the platter (nullopt: it has none); frames without one
/// are rotated as the nearest one with. nullopt if the platter does not wobble: its tilts scatter
/// by less than 0.1 degrees, or hardly more than successive ones differ; and if a fifth of the
/// frames do not show it.
std::optional<Levelling> level(const std::vector<std::optional<PlatterObservation>>& sights,
                               const DetectedPlatter& platter);

}  // namespace turnscan::motion
