#pragma once
// What the first frames of a scan tell: how fine, how noisy, and what stands on the platter.

#include <span>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/profiles.hpp>

namespace turnscan {

struct FirstLook {
  /// Median distance between neighbouring points of a frame; of a line scanner, whose profiles may
  /// lie farther apart than the points on them, the larger of both distances.
  double spacing_m = 0.0;
  double even_spacing_m = 0.0;  ///< the same as if points in no order lay on a grid
  double noise_m = 0.0;         ///< of a depth along its ray
  std::vector<std::optional<LightSheet>> sheets;  ///< per sensor: of line scanners
  bool profiles = false;                          ///< all sensors looked at are line scanners
  std::optional<Cylinder> cylinder;               ///< the crop; nullopt: everything is kept
  std::vector<Choice> choices;
  std::vector<std::string> notes;
};

/// How many frames make a good first look: about a second of a camera's, more where the edge of the
/// platter has to be found in them.
std::size_t frames_of_first_look(const SequenceHeader& header, const CropOptions& crop);

/// The sheets of light of the sensors nearly all of whose frames lie in one.
Result<std::vector<std::optional<LightSheet>>> find_sheets(std::span<const Frame> frames,
                                                           const SequenceHeader& header,
                                                           const std::vector<RayTable>& rays);

/// Looks at up to 12 of the frames, evenly spread. poses: T_table_sensor of each; rays: per sensor.
/// Fails with kTooFewPoints when no frame shows 10 points on the object, and as points_of does.
Result<FirstLook> look_at(std::span<const Frame> frames, std::span<const Pose> poses,
                          const SequenceHeader& header, const std::vector<RayTable>& rays,
                          const CropOptions& crop);

}  // namespace turnscan
