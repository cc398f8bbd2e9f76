#pragma once
// What a recording has seen of the object so far.

#include <cstdint>
#include <optional>
#include <turnscan/core/point_cloud.hpp>
#include <unordered_map>

namespace turnscan::studio {

/// Counts, per cell of a grid that turns with the table, from which sides it was seen. A side is
/// ten degrees of a turn.
class LiveCoverage {
 public:
  static constexpr int kSides = 36;
  static constexpr int kWell = 3;  ///< sides from which a place counts as seen well

  explicit LiveCoverage(double cell_m) : cell_m_(cell_m) {}

  /// Points of one frame in the table's frame as it stood then, turned back by the table's angle.
  void add(const std::vector<Vec3f>& points, double turned_rad);

  /// Surface that more than one frame saw, about: a surface of any slope meets 1.5 cells per area
  /// of a cell's side in the mean (Cauchy's formula).
  double area_m2() const;
  /// Share of it that was seen from kWell sides or more; 0 while nothing was seen.
  double share_well() const;
  /// Sides of the turn from which there is a frame.
  int sides() const;
  /// Colour of the place at p, table frame, by the sides that it was seen from; nullopt where none
  /// or only one frame saw it.
  std::optional<Rgb> color_at(const Vec3f& p) const;
  /// The best of the cell at p and those beside it: for a place that lies on the surface about.
  std::optional<Rgb> color_near(const Vec3f& p) const;
  double cell_m() const { return cell_m_; }
  /// A point per cell, coloured by sides: color_of_sides().
  PointCloud cloud() const;

 private:
  struct Cell {
    Vec3f sum = Vec3f::Zero();
    std::uint32_t points = 0, frames = 0, last_frame = 0;
    std::uint64_t sides = 0;
  };
  /// Sides from which the cell at p was seen; 0: by no frame, or only one.
  int sides_at(const Vec3f& p) const;

  double cell_m_;
  std::uint32_t frame_ = 0;
  std::uint64_t sides_ = 0;
  std::unordered_map<std::uint64_t, Cell> cells_;
};

/// 0: not at all, 1: little, LiveCoverage::kWell and more: well. Colours of M. Okabe and K. Ito,
/// which people with any colour vision tell apart.
Rgb color_of_sides(int sides);

}  // namespace turnscan::studio
