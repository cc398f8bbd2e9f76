#pragma once
// The platter in an averaged scan, found without a click: its plane and its round rim.

#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>

namespace turnscan {

struct DetectOptions {
  std::optional<double> radius_m;  ///< the platter's, if known
  double min_radius_m = 0.05;      ///< of a platter whose radius is not known
  double max_radius_m = 0.6;
  double min_rim_share = 0.3;   ///< refuse when less of the rim is seen
  double min_confidence = 0.7;  ///< refuse below
  /// Refuse as not round when less of what is seen beside the rim fits it. Simulated platters have
  /// 0.97 and more, clutter up to 0.88. Not for people to choose: who checks the platter by other
  /// means may take a worse one.
  double min_agreement = 0.93;
};
/// Fields platter-radius, platter-min-radius, platter-max-radius, platter-rim, platter-confidence.
OptionTable describe(DetectOptions& options);

struct DetectedPlatter {
  Vec3d axis = Vec3d::UnitY();     ///< sensor frame, up
  Vec3d center_m = Vec3d::Zero();  ///< of the rim, on the platter's surface
  double radius_m = 0.0;
  double axis_sigma_rad = 0.0, center_sigma_m = 0.0, height_sigma_m = 0.0, radius_sigma_m = 0.0;
  double plane_rms_m = 0.0;  ///< of the surface's pixels from the plane
  double rim_rms_m = 0.0;    ///< of the first circle's points from it, in the plane
  double rim_share = 0.0;    ///< of 72 bearings, those at which the platter is seen to end
  /// Share of the pixels beside the rim that are on their side of it, times the share of the disc
  /// that is filled by the plane or hidden by what stands on it.
  double confidence = 0.0;
  std::size_t plane_pixels = 0, rim_points = 0;
};

/// What a search for the platter of a recording found, for the searches that follow: it stands
/// where it stood, whichever frames are looked at.
struct PlatterMemory {
  bool searched = false;
  std::optional<DetectedPlatter> platter;  ///< as searched; nullopt: none was seen
};

/// Planes are found one after the other (RANSAC); in each, the places where it ends before
/// something farther give a circle (RANSAC over three of them), then least squares over plane and
/// rim give a start. The rim is then estimated by maximum likelihood from what each pixel about the
/// outline of disc and wall sees, and from the wall's depth; the wall's height and how the sensor
/// mixes pixels are unknowns of the fit. The deviations count correlated pixels once; an error of
/// range that is common to all pixels is not in them.
/// Fails with kMissingData when no plane with a round rim is there, when too little of it is seen,
/// and when two are equally good: the sentence says which and what would help. Also kInvalidOption,
/// kCancelled.
Result<DetectedPlatter> detect_platter(const AveragedScan& scan, const DetectOptions& options,
                                       const RunContext& context);

/// The same as a calibration.
Calibration calibration_of(const DetectedPlatter& platter, const AveragedScan& scan);

}  // namespace turnscan
