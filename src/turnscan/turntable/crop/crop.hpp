#pragma once
// Crops to the cylinder above the platter (thesis eq. 3.5 to 3.7, algorithm 2).

#include <cmath>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

struct CropOptions {
  bool enabled = true;
  /// Lowest height above the platter that is kept; nullopt: determined from the platter's own
  /// returns.
  std::optional<double> margin_m;
  /// Radius of the cylinder; nullopt: the platter's, or larger if the object extends beyond it.
  std::optional<double> radius_m;
  double height_m = 2.0;  ///< height of the cylinder
};
OptionTable describe(CropOptions& options);

/// A cylinder in the table frame: y in [margin, height], distance from the axis below radius.
struct Cylinder {
  double margin_m = 0.0;
  double height_m = 2.0;
  double radius_m = 1e9;

  bool contains(const Vec3d& p_table) const {
    return p_table.y() > margin_m && p_table.y() < height_m &&
           p_table.x() * p_table.x() + p_table.z() * p_table.z() < radius_m * radius_m;
  }
};

/// The same cylinder in a sensor's frame: one multiply-add row per axis, no full transform.
class SensorCrop {
 public:
  SensorCrop(const Cylinder& cylinder, const Pose& T_table_sensor);
  bool keeps(const Vec3f& p_sensor) const;

 private:
  Eigen::Matrix3f rotation_;
  Vec3f translation_;
  float margin_, height_, radius_squared_;
};

/// The points for which keeps() holds, in order, with their cells.
template <class Keeps>
FramePoints kept_points(const FramePoints& points, const Keeps& keeps) {
  FramePoints out;
  out.width = points.width;
  out.height = points.height;
  out.viewpoint = points.viewpoint;
  const bool colored = !points.cloud.colors.empty();
  for (std::size_t i = 0; i < points.cloud.size(); ++i) {
    if (!keeps(points.cloud.points[i])) continue;
    out.cloud.points.push_back(points.cloud.points[i]);
    if (colored) out.cloud.colors.push_back(points.cloud.colors[i]);
    if (!points.cell.empty()) out.cell.push_back(points.cell[i]);
  }
  return out;
}

/// The points inside the cylinder.
FramePoints crop(const FramePoints& points, const SensorCrop& crop);

/// Distribution of the heights of the platter's own returns about y = 0.
struct PlatterReturns {
  std::size_t count = 0;     ///< returns within 15 mm of the plane, inside the radius
  double height_m = 0.0;     ///< their median height
  double sigma_m = 0.0;      ///< robust standard deviation of their height
  double dense_share = 0.0;  ///< share of the returns within the most populated 3 mm
  static constexpr double kReach_m = 0.015, kMaxSigma_m = 0.0045;

  /// Whether the returns are at one height. Of returns spread evenly over 15 mm or more, 3 mm
  /// contain at most a fifth.
  bool lie_flat(double most_sigma_m) const { return dense_share > 0.25 && sigma_m < most_sigma_m; }
  /// Whether the returns come from a platter. Without a platter, the returns at its height are the
  /// object's own feet and walls; where these widen upwards, most returns are near the upper end.
  bool plane(double most_sigma_m = kMaxSigma_m) const {
    return lie_flat(most_sigma_m) && std::abs(height_m) < 0.0115;
  }
};

/// Measures the returns on points in the table frame. Uses the lower half of their distribution, so
/// that the object's foot does not count as noise. count = 0 if there are fewer than 200.
PlatterReturns measure_platter(const std::vector<Vec3f>& p_table, double radius_m);

/// Radius at which the platter's returns end: going outwards from the densest 4 mm ring, the first
/// ring with less than 0.3 times its density. p_table must contain whole frames (not cropped),
/// spread over a turn. nullopt if the returns do not end within 0.6 m, e.g. on a plane that extends
/// beyond the platter, if there are too few, or if they are not in a plane.
std::optional<double> find_platter_radius(const std::vector<Vec3f>& p_table,
                                          const PlatterReturns& platter);

}  // namespace turnscan
