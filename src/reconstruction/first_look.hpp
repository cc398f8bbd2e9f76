#pragma once
// What the first frames of a scan tell: how fine, how noisy, and what stands on the platter.

#include <span>
#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

struct FirstLook {
  double spacing_m = 0.0;            ///< median distance between neighbouring points of a frame
  double noise_m = 0.0;              ///< of a depth along its ray
  std::optional<Cylinder> cylinder;  ///< the crop; nullopt: everything is kept
  std::vector<Choice> choices;
  std::vector<std::string> notes;
};

/// How many frames make a good first look: about a second of a camera's, more where the edge of the
/// platter has to be found in them.
std::size_t frames_of_first_look(const SequenceHeader& header, const CropOptions& crop);

/// Looks at up to 12 of the frames, evenly spread. poses: T_table_sensor of each; rays: per sensor.
/// Fails with kTooFewPoints when no frame shows 10 points on the object, and as points_of does.
Result<FirstLook> look_at(std::span<const Frame> frames, std::span<const Pose> poses,
                          const SequenceHeader& header, const std::vector<RayTable>& rays,
                          const CropOptions& crop);

}  // namespace turnscan
