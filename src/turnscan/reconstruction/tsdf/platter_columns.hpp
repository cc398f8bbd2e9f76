#pragma once
// What stands on a platter in a way that the crop above it hides: columns of samples along y.

#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// Some of a volume's columns.
class PlatterColumns {
 public:
  /// None.
  PlatterColumns() = default;

  bool none() const { return columns_.empty(); }
  bool column(int i, int k) const {
    return !none() && columns_[std::size_t(i) + std::size_t(width_) * std::size_t(k)] != 0;
  }
  /// Whether the column nearest to a point, in the volume's frame, is one of them.
  bool contains(const Vec3f& p) const;

 protected:
  /// Still none.
  explicit PlatterColumns(const Volume& volume);

  Vec3d origin_m_ = Vec3d::Zero();
  double cell_m_ = 1.0;
  int width_ = 0, depth_ = 0;
  std::vector<std::uint8_t> columns_;
};

/// The columns in which an object on a platter narrows towards it: below the crop margin its walls
/// do not continue straight down there, and unobserved space is closed as it is elsewhere. Up to 30
/// mm from the lowest observed surface.
class TaperedFoot : public PlatterColumns {
 public:
  TaperedFoot() = default;
  /// From a volume whose holes are not closed yet: uses the slope of the observed surface in the
  /// lowest millimetres above layer `floor`, below which the volume has no data.
  TaperedFoot(const Volume& volume, int floor);
};

/// The columns in which a vessel has a floor that rays measured below layer `floor`, too close to
/// the platter for a single return to tell the two apart. They are part of a hollow of that layer,
/// and the surface measured under that hollow, away from its walls, lies higher than the platter
/// beside the object and is as flat: nine tenths of the one are above nine tenths of the other. (A
/// bore that is too narrow for the sensor's pixels looks shallow, but not flat.) None where the
/// platter was not measured.
class MeasuredFloors : public PlatterColumns {
 public:
  MeasuredFloors() = default;
  /// From a volume whose holes are not closed yet, with its measurements below layer `floor`.
  MeasuredFloors(const Volume& volume, int floor);
  /// Whether a point of the closed surface is on such a floor, rather than on the base below it.
  bool contains(const Vec3f& p) const;
};

/// How an object stands on its platter.
struct Foot {
  TaperedFoot round;
  MeasuredFloors floors;
};

/// For each column (i + columns along x * k): 1 where a vessel on a platter has a floor that no ray
/// reached. In some layer the column is part of an observed hollow, which observed surface
/// surrounds, and no column of that hollow was observed to be free all the way from layer `floor`,
/// the lowest that is used. From a volume whose holes are not closed yet.
std::vector<std::uint8_t> hollow_floors(const Volume& volume, int floor);

}  // namespace turnscan::tsdf
