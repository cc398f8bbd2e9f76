#pragma once
// The round rim of a plane in a depth image.

#include <optional>
#include <turnscan/turntable/detection/plane_fit.hpp>

namespace turnscan::detection {

/// A point, between two pixels, where the surface ends before something farther away.
struct RimPoint {
  Eigen::Vector2d at;         ///< coordinates in the plane
  Eigen::Matrix2d footprint;  ///< metres in the plane per pixel across and down
  /// Behind it the depth jumps, so that mixed pixels may hide the true end; false at an edge from
  /// which a wall descends.
  bool jump = true;
};

/// Coordinates in a plane. The origin is that given to the constructor.
class PlaneFrame {
 public:
  PlaneFrame(const Plane& plane, const Vec3d& origin);
  Eigen::Vector2d to_plane(const Vec3d& p) const { return {u_.dot(p - o_), v_.dot(p - o_)}; }
  Vec3d to_space(const Eigen::Vector2d& q) const { return o_ + q.x() * u_ + q.y() * v_; }
  Vec3d u() const { return u_; }
  Vec3d v() const { return v_; }

 private:
  Vec3d o_, u_, v_;
};

/// Image, plane and mask of the pixels in the plane.
struct PlaneView {
  const ScanPixels& scan;
  const CameraIntrinsics& camera;
  const RayTable& rays;
  Plane plane;
  double tolerance_m;
  PlaneFrame frame;
  std::vector<std::uint8_t> in;  ///< per pixel

  Vec3d ray(double column, double row) const { return camera.ray(column, row); }
  /// +1 if the pixel is above the plane (occludes it), -1 if behind it or empty, 0 if in it.
  int side(int column, int row) const;
};

/// All ends of the plane except where something occludes them.
std::vector<RimPoint> rim_points(const PlaneView& view);

/// The ends of the plane's largest connected part, whatever is behind them.
std::vector<RimPoint> part_ends(const PlaneView& view);

/// On the side of a disc that faces the sensor, a thick platter shows its wall, whose upper end
/// passes for the plane. If enough of the points there are on walls, the others are dropped.
/// to_sensor: direction in the plane.
void drop_false_ends(const Eigen::Vector2d& center, const Eigen::Vector2d& to_sensor,
                     std::vector<RimPoint>& points);

struct RimCircle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  double edge_px = 0.0;  ///< distance of the rim outwards from half way between the pixels
  Eigen::Matrix2d center_covariance = Eigen::Matrix2d::Zero();
  double radius_sigma_m = 0.0;
  double rms_m = 0.0;
  std::size_t points = 0;
};

/// The circles with the most points, in that order; some may be nearly identical. The radius is
/// within [min, max]. Empty if no circle has enough points all round.
std::vector<RimCircle> find_circles(const std::vector<RimPoint>& points, double min_radius_m,
                                    double max_radius_m, std::optional<double> radius_m,
                                    std::uint64_t seed);

}  // namespace turnscan::detection
