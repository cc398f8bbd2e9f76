#pragma once
// A surface thinned to an even density, with nearest-point search.

#include <cstdint>
#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

struct Samples {
  std::vector<Vec3f> points, normals;
  std::vector<float> areas;   ///< m^2
  std::vector<Vec3f> colors;  ///< as PassSurface::colors, or empty
  double spacing_m = 0.0;

  std::size_t size() const { return points.size(); }
};

/// Means of the points in voxels of about the size that leaves `count` of them; the two sides of a
/// thin wall are kept separate.
Samples thinned(const PassSurface& surface, std::size_t count);

/// For any point the sample nearest to the centre of its cell: exact up to the cell's size.
class NearestGrid {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// About `side` cells along the longest side; finds samples within reach_m.
  NearestGrid(const Samples& samples, int side, double reach_m);
  std::uint32_t operator()(const Vec3f& p) const {
    const Vec3f at = (p - origin_) * per_cell_;
    if (!(at.minCoeff() >= 0.0f)) return kNone;
    const Eigen::Vector3i c = at.cast<int>();
    if ((c.array() >= size_.array()).any()) return kNone;
    return nearest_[std::size_t(c.x() + size_.x() * (c.y() + size_.y() * c.z()))];
  }

 private:
  Vec3f origin_;
  float per_cell_ = 1.0f;
  Eigen::Vector3i size_;
  std::vector<std::uint32_t> nearest_;
};

}  // namespace turnscan::passes
