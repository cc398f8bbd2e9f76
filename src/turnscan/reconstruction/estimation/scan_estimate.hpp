#pragma once
// Estimate from the first frames of a scan: resolution, noise, and the region of the object.

#include <span>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/views/profiles.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan::estimation {

struct ScanEstimate {
  /// Median distance between neighbouring points of a frame; for a line scanner, whose profiles may
  /// be farther apart than the points on them, the larger of both distances.
  double spacing_m = 0.0;
  double even_spacing_m = 0.0;  ///< the same for a regular grid with as many points
  double noise_m = 0.0;         ///< of a depth value along its ray
  std::vector<std::optional<views::LightSheet>> sheets;  ///< per sensor; only for line scanners
  bool profiles = false;             ///< all sensors of the estimate are line scanners
  std::optional<Cylinder> cylinder;  ///< the crop; nullopt: everything is kept
  std::vector<ResolvedParameter> choices;
  std::vector<std::string> notes;
};

/// Number of frames that an estimate needs: about a second of a camera's, more if the edge of the
/// platter has to be found in them.
std::size_t frames_for_estimate(const SequenceHeader& header, const CropOptions& crop);

/// The light sheets of the sensors of which nearly all frames lie in one.
Result<std::vector<std::optional<views::LightSheet>>> find_sheets(
    std::span<const Frame> frames, const SequenceHeader& header, const std::vector<RayTable>& rays);

/// Uses up to 12 of the frames, evenly spread. poses: T_table_sensor of each; rays: per sensor.
/// Fails with kTooFewPoints if no frame shows 10 points on the object, and as points_of does.
Result<ScanEstimate> estimate_scan(std::span<const Frame> frames, std::span<const Pose> poses,
                                   const SequenceHeader& header, const std::vector<RayTable>& rays,
                                   const CropOptions& crop);

}  // namespace turnscan::estimation
