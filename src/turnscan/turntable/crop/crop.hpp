#pragma once
// Keep what stands on the platter: the cylinder above it (thesis eq. 3.5 to 3.7, algorithm 2).

#include <cmath>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

struct CropOptions {
  bool enabled = true;
  /// Lowest height above the platter that is kept; nullopt: found from the platter's own returns.
  std::optional<double> margin_m;
  /// Radius of the cylinder; nullopt: the platter's, or more where the object reaches beyond it.
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

/// The same cylinder seen from a sensor: one multiply-add row per axis, no full transform.
class SensorCrop {
 public:
  SensorCrop(const Cylinder& cylinder, const Pose& T_table_sensor);
  bool keeps(const Vec3f& p_sensor) const;

 private:
  Eigen::Matrix3f rotation_;
  Vec3f translation_;
  float margin_, height_, radius_squared_;
};

/// The points for which keeps() holds (in order); cells are kept with them.
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

/// Those inside.
FramePoints crop(const FramePoints& points, const SensorCrop& crop);

/// How far the platter's own returns lie from y = 0.
struct PlatterReturns {
  std::size_t count = 0;     ///< returns within 15 mm of the plane, inside the radius
  double height_m = 0.0;     ///< their median height
  double sigma_m = 0.0;      ///< robust standard deviation of their height
  double dense_share = 0.0;  ///< of the returns that lie in the 3 mm that hold most of them
  static constexpr double kReach_m = 0.015, kMaxSigma_m = 0.0045;

  /// Whether they lie at one height. Of what is spread evenly over 15 mm or more, 3 mm hold a fifth
  /// at most.
  bool lie_flat(double most_sigma_m) const { return dense_share > 0.25 && sigma_m < most_sigma_m; }
  /// Whether they are a platter's. Without one, what is seen at its height are the object's own
  /// feet and walls; where it widens upwards, most returns lie at the upper end.
  bool plane(double most_sigma_m = kMaxSigma_m) const {
    return lie_flat(most_sigma_m) && std::abs(height_m) < 0.0115;
  }
};

/// Measures them on points in the table frame. The lower half of their distribution decides, so
/// that the object's foot does not count as noise. count = 0 when fewer than 200 are there.
PlatterReturns measure_platter(const std::vector<Vec3f>& p_table, double radius_m);

/// Radius at which the platter's returns end: outwards from the ring (of 4 mm) in which they lie
/// densest, the first ring with less than 0.3 times that density. p_table must hold whole frames
/// (not cropped), spread over a turn. nullopt where they do not end within 0.6 m, e.g. on a plane
/// that goes on beyond the platter, where there are too few, or where they lie in no plane.
std::optional<double> find_platter_radius(const std::vector<Vec3f>& p_table,
                                          const PlatterReturns& platter);

}  // namespace turnscan
