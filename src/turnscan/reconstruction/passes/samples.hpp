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
  std::uint32_t operator()(const Vec3f& p) const { return (*this)(p.x(), p.y(), p.z()); }
  std::uint32_t operator()(float px, float py, float pz) const {
    const float x = (px - origin_.x()) * per_cell_, y = (py - origin_.y()) * per_cell_,
                z = (pz - origin_.z()) * per_cell_;
    // Compares as float: points far outside would overflow an int.
    if (!(x >= 0.0f && y >= 0.0f && z >= 0.0f && x < float(size_.x()) && y < float(size_.y()) &&
          z < float(size_.z())))
      return kNone;
    return nearest_[std::size_t(int(x) + size_.x() * (int(y) + size_.y() * int(z)))];
  }

 private:
  Vec3f origin_;
  float per_cell_ = 1.0f;
  Eigen::Vector3i size_;
  std::vector<std::uint32_t> nearest_;
};

}  // namespace turnscan::passes
