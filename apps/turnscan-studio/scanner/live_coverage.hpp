#pragma once
// Coverage of the object during a recording.

#include <cstdint>
#include <optional>
#include <turnscan/core/point_cloud.hpp>
#include <unordered_map>

namespace turnscan::studio {

/// Counts, per cell of a grid that rotates with the table, the directions from which it was seen. A
/// direction ("side") is ten degrees of a turn.
class LiveCoverage {
 public:
  static constexpr int kSides = 36;
  static constexpr int kWell = 3;  ///< sides from which a well-seen place was seen

  explicit LiveCoverage(double cell_m) : cell_m_(cell_m) {}

  /// Adds the points of one frame, in the table's frame at that time; they are rotated back by the
  /// table's angle.
  void add(const std::vector<Vec3f>& points, double turned_rad);

  /// Approximate area of the surface seen by more than one frame: on average, a surface of any
  /// orientation intersects 1.5 cells per area of a cell's face (Cauchy's formula).
  double area_m2() const;
  /// Share of it that was seen from at least kWell sides; 0 while nothing was seen.
  double share_well() const;
  /// Number of sides of the turn with a frame.
  int sides() const;
  /// Colour at p, table frame, by the number of sides from which it was seen; nullopt if at most
  /// one frame saw it.
  std::optional<Rgb> color_at(const Vec3f& p) const;
  /// The best of the cell at p and its neighbours: for points that are only approximately on the
  /// surface.
  std::optional<Rgb> color_near(const Vec3f& p) const;
  double cell_m() const { return cell_m_; }
  /// One point per cell, coloured by color_of_sides().
  PointCloud cloud() const;

 private:
  struct Cell {
    Vec3f sum = Vec3f::Zero();
    std::uint32_t points = 0, frames = 0, last_frame = 0;
    std::uint64_t sides = 0;
  };
  /// Number of sides from which the cell at p was seen; 0: by at most one frame.
  int sides_at(const Vec3f& p) const;

  double cell_m_;
  std::uint32_t frame_ = 0;
  std::uint64_t sides_ = 0;
  std::unordered_map<std::uint64_t, Cell> cells_;
};

/// 0: not at all, 1: little, LiveCoverage::kWell and more: well. Colours of M. Okabe and K. Ito,
/// which people with any colour vision can distinguish.
Rgb color_of_sides(int sides);

}  // namespace turnscan::studio
