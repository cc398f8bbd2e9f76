#pragma once
// The turntable from points that a user picked on the platter's rim (thesis 3.3.1).

#include <span>
#include <turnscan/core/calibration.hpp>

namespace turnscan {

/// A circle in space.
struct Circle {
  Vec3d center = Vec3d::Zero();
  Vec3d axis = Vec3d::UnitY();  ///< unit normal of its plane
  double radius_m = 0.0;
};

/// Mean absolute and root mean square distance of points from a circle's rim, as distances from its
/// centre minus its radius (thesis eq. 3.4; as printed there, errors of different sign could
/// cancel).
struct CircleError {
  double mean_abs_m = 0.0;
  double rms_m = 0.0;
};
CircleError circle_error(std::span<const Vec3d> points, const Circle& circle);

/// The thesis's formulas over the circumcircles of all triples: the centre is their plain mean
/// (3.1), the radius the mean weighted with the triangles' areas (3.2; as printed, the weight is
/// missing in the numerator), the axis the mean normal weighted with the areas (3.3). Collinear
/// triples are skipped. The axis points towards the side of `sensor`, away from the floor.
/// Fails, naming the points (counted from 1), with kTooFewPoints for fewer than 3, and with
/// kInvalidOption for one that is not finite, for two that coincide, for more than 300 and for
/// points that are all collinear.
Result<Circle> circle_from_triples(std::span<const Vec3d> points, const Vec3d& sensor);

struct PickedCircle {
  Circle triples;             ///< circle_from_triples
  CircleError triples_error;  ///< of the points from it
  Circle circle;              ///< least squares; this is the one used
  CircleError error;
  /// Standard deviations, from the residuals; NaN with 3 points, which a circle fits exactly.
  double axis_sigma_rad, center_sigma_m, height_sigma_m, radius_sigma_m;
};

/// The circle with the least sum of squared distances of the points from its rim, by the
/// Levenberg-Marquardt method starting at circle_from_triples. Fails as that does.
Result<PickedCircle> fit_picked_points(std::span<const Vec3d> points, const Vec3d& sensor);

/// The same as a calibration. radius_m is the circle's.
Result<Calibration> calibrate_from_points(std::span<const Vec3d> points, const Vec3d& sensor);

}  // namespace turnscan
