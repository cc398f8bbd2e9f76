#include "scanner/live_coverage.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <turnscan/core/angles.hpp>

namespace turnscan::studio {

namespace {

constexpr std::int64_t kCellLimit = 1 << 20;  // per axis, in both directions

/// 21 bits per axis.
std::uint64_t key_of(const Vec3f& p, double cell_m) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::int64_t>(std::floor(double(p[axis]) / cell_m));
    key = key << 21 | static_cast<std::uint64_t>(at + kCellLimit);
  }
  return key;
}

}  // namespace

void LiveCoverage::add(const std::vector<Vec3f>& points, double turned_rad) {
  ++frame_;
  const double share = turned_rad / kTurn - std::floor(turned_rad / kTurn);
  const std::uint64_t side = std::uint64_t(1) << std::min(kSides - 1, int(share * kSides));
  sides_ |= side;
  const double reach = cell_m_ * double(kCellLimit - 1);
  for (const Vec3f& p : points) {
    if (!p.allFinite() || double(p.cwiseAbs().maxCoeff()) >= reach) continue;
    Cell& cell = cells_[key_of(p, cell_m_)];
    cell.sum += p;
    ++cell.points;
    cell.sides |= side;
    if (cell.last_frame == frame_) continue;
    cell.last_frame = frame_;
    ++cell.frames;
  }
}

double LiveCoverage::area_m2() const {
  const auto seen = std::count_if(cells_.begin(), cells_.end(),
                                  [](const auto& entry) { return entry.second.frames > 1; });
  return double(seen) * cell_m_ * cell_m_ / 1.5;
}

double LiveCoverage::share_well() const {
  std::size_t all = 0, well = 0;
  for (const auto& [key, cell] : cells_) {
    if (cell.frames < 2) continue;
    ++all;
    well += std::popcount(cell.sides) >= kWell ? 1 : 0;
  }
  return all == 0 ? 0.0 : double(well) / double(all);
}

int LiveCoverage::sides() const { return std::popcount(sides_); }

int LiveCoverage::sides_at(const Vec3f& p) const {
  if (!p.allFinite() || double(p.cwiseAbs().maxCoeff()) >= cell_m_ * double(kCellLimit - 2))
    return 0;
  const auto found = cells_.find(key_of(p, cell_m_));
  if (found == cells_.end() || found->second.frames < 2) return 0;
  return std::popcount(found->second.sides);
}

std::optional<Rgb> LiveCoverage::color_at(const Vec3f& p) const {
  const int sides = sides_at(p);
  return sides > 0 ? std::optional<Rgb>(color_of_sides(sides)) : std::nullopt;
}

std::optional<Rgb> LiveCoverage::color_near(const Vec3f& p) const {
  int best = sides_at(p);
  const auto step = float(cell_m_);
  for (int i = 0; i < 27 && best < kWell; ++i)
    best = std::max(
        best, sides_at(p + step * Vec3f(float(i % 3 - 1), float(i / 3 % 3 - 1), float(i / 9 - 1))));
  return best > 0 ? std::optional<Rgb>(color_of_sides(best)) : std::nullopt;
}

PointCloud LiveCoverage::cloud() const {
  PointCloud out;
  for (const auto& [key, cell] : cells_) {
    if (cell.frames < 2) continue;
    out.points.push_back(cell.sum / float(cell.points));
    out.colors.push_back(color_of_sides(std::popcount(cell.sides)));
  }
  return out;
}

Rgb color_of_sides(int sides) {
  if (sides >= LiveCoverage::kWell) return {0, 158, 115};
  if (sides == 2) return {240, 228, 66};
  return sides == 1 ? Rgb{230, 159, 0} : Rgb{204, 121, 167};
}

}  // namespace turnscan::studio
