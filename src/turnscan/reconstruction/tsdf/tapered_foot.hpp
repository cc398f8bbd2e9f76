#pragma once

#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// Where what stands on a platter narrows towards it: below the crop margin its walls do not go
/// straight down there, and what no view saw is closed as it is elsewhere. Columns of samples along
/// y, up to 30 mm from the lowest surface that was seen.
class TaperedFoot {
 public:
  /// Nowhere.
  TaperedFoot() = default;
  /// Of a volume whose holes are not closed: by the slope of the surface that was seen in the
  /// lowest millimetres above layer `floor`, up to which it says nothing.
  TaperedFoot(const Volume& volume, int floor);

  bool none() const { return columns_.empty(); }
  bool column(int i, int k) const {
    return !none() && columns_[std::size_t(i) + std::size_t(width_) * std::size_t(k)] != 0;
  }
  /// Whether the column nearest to a place, in the volume's frame, is one.
  bool contains(const Vec3f& p) const;

 private:
  Vec3d origin_m_ = Vec3d::Zero();
  double cell_m_ = 1.0;
  int width_ = 0, depth_ = 0;
  std::vector<std::uint8_t> columns_;
};

}  // namespace turnscan::tsdf
