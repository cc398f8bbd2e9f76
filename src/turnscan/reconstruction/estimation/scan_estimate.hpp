#pragma once
// What the first frames of a scan tell: how fine, how noisy, and what stands on the platter.

#include <span>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/views/profiles.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan::estimation {

struct ScanEstimate {
  /// Median distance between neighbouring points of a frame; of a line scanner, whose profiles may
  /// lie farther apart than the points on them, the larger of both distances.
  double spacing_m = 0.0;
  double even_spacing_m = 0.0;  ///< the same as if points in no order lay on a grid
  double noise_m = 0.0;         ///< of a depth along its ray
  std::vector<std::optional<views::LightSheet>> sheets;  ///< per sensor: of line scanners
  bool profiles = false;             ///< all sensors that the estimate saw are line scanners
  std::optional<Cylinder> cylinder;  ///< the crop; nullopt: everything is kept
  std::vector<ResolvedParameter> choices;
  std::vector<std::string> notes;
};

/// How many frames an estimate needs: about a second of a camera's, more where the edge of the
/// platter has to be found in them.
std::size_t frames_for_estimate(const SequenceHeader& header, const CropOptions& crop);

/// The sheets of light of the sensors nearly all of whose frames lie in one.
Result<std::vector<std::optional<views::LightSheet>>> find_sheets(
    std::span<const Frame> frames, const SequenceHeader& header, const std::vector<RayTable>& rays);

/// From up to 12 of the frames, evenly spread. poses: T_table_sensor of each; rays: per sensor.
/// Fails with kTooFewPoints when no frame shows 10 points on the object, and as points_of does.
Result<ScanEstimate> estimate_scan(std::span<const Frame> frames, std::span<const Pose> poses,
                                   const SequenceHeader& header, const std::vector<RayTable>& rays,
                                   const CropOptions& crop);

}  // namespace turnscan::estimation
