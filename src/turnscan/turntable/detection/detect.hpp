#pragma once
// Detects the platter in an averaged scan, its plane and its round rim, without user input.

#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>

namespace turnscan {

struct DetectOptions {
  std::optional<double> radius_m;  ///< the platter's, if known
  double min_radius_m = 0.05;      ///< of a platter whose radius is not known
  double max_radius_m = 0.6;
  double min_rim_share = 0.3;   ///< refuse if less of the rim is seen
  double min_confidence = 0.7;  ///< refuse below this confidence
  /// Refuse as not round if a smaller share of the pixels beside the rim agrees with it. Simulated
  /// platters have 0.97 and more, clutter up to 0.88. Not a user option: callers that check the
  /// platter by other means may accept a lower value.
  double min_agreement = 0.93;
};
/// Fields platter-radius, platter-min-radius, platter-max-radius, platter-rim, platter-confidence.
OptionTable describe(DetectOptions& options);

struct DetectedPlatter {
  Vec3d axis = Vec3d::UnitY();     ///< sensor frame, upwards
  Vec3d center_m = Vec3d::Zero();  ///< centre of the rim, on the platter's surface
  double radius_m = 0.0;
  double axis_sigma_rad = 0.0, center_sigma_m = 0.0, height_sigma_m = 0.0, radius_sigma_m = 0.0;
  double plane_rms_m = 0.0;  ///< of the surface's pixels from the plane
  double rim_rms_m = 0.0;    ///< of the first circle's points from it, in the plane
  double rim_share = 0.0;    ///< share of 72 bearings at which the platter is seen to end
  /// Share of the pixels beside the rim that are on their side of it, times the share of the disc
  /// that is filled by the plane or occluded by what stands on it.
  double confidence = 0.0;
  std::size_t plane_pixels = 0, rim_points = 0;
};

/// Result of a platter search in a recording, kept for later searches: the platter does not move,
/// whichever frames are examined.
struct PlatterMemory {
  bool searched = false;
  std::optional<DetectedPlatter> platter;  ///< as found; nullopt: none was seen
};

/// Planes are found one after the other (RANSAC); in each, the points where it ends before
/// something farther away give a circle (RANSAC over three of them), then least squares over plane
/// and rim gives an initial estimate. The rim is then estimated by maximum likelihood from what
/// each pixel near the outline of disc and wall sees, and from the wall's depth; the wall's height
/// and the sensor's pixel mixing are unknowns of the fit. The standard deviations account for
/// correlated pixels; a range error that is common to all pixels is not included.
/// Fails with kMissingData if there is no plane with a round rim, if too little of it is seen, and
/// if two are equally good: the message tells which and what would help. Also kInvalidOption,
/// kCancelled.
Result<DetectedPlatter> detect_platter(const AveragedScan& scan, const DetectOptions& options,
                                       const RunContext& context);

/// The same as a calibration.
Calibration calibration_of(const DetectedPlatter& platter, const AveragedScan& scan);

}  // namespace turnscan
