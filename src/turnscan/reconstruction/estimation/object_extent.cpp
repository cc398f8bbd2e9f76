#include <algorithm>
#include <cmath>
#include <cstdint>
#include <turnscan/reconstruction/estimation/object_extent.hpp>

namespace turnscan::estimation {

namespace {

constexpr double kFarthest = 3.0;  // radii
constexpr double kDenseShare = 0.2;
constexpr std::uint32_t kMinReachPoints = 3;
constexpr int kBits = 21;
constexpr std::int64_t kHalf = std::int64_t(1) << (kBits - 1);

struct ReachCell {
  std::uint64_t key = 0;
  std::uint32_t points = 0;
  bool inside = false;  ///< one of them is in the cylinder
  bool reached = false;
  double farthest_m = 0.0;  ///< of its points, from the axis

  void add(const ReachCell& part) {
    points += part.points;
    inside |= part.inside;
    farthest_m = std::max(farthest_m, part.farthest_m);
  }
};

std::uint64_t cell_key(std::int64_t x, std::int64_t y, std::int64_t z) {
  return std::uint64_t(x + kHalf) << (2 * kBits) | std::uint64_t(y + kHalf) << kBits |
         std::uint64_t(z + kHalf);
}

/// In ascending order of their keys.
std::vector<ReachCell> cells_of(const std::vector<Vec3f>& p_table, const Cylinder& cylinder,
                                double cell_m) {
  // Neighbouring pixels mostly fall into the same cell, which leaves little to sort.
  std::vector<ReachCell> runs;
  for (const Vec3f& p : p_table) {
    const double r = std::hypot(double(p.x()), double(p.z()));
    if (p.y() < cylinder.margin_m + cell_m || p.y() > cylinder.height_m ||
        r > kFarthest * cylinder.radius_m)
      continue;
    const auto at = [&](float x) { return std::int64_t(std::floor(double(x) / cell_m)); };
    const std::uint64_t key = cell_key(at(p.x()), at(p.y()), at(p.z()));
    if (runs.empty() || runs.back().key != key) runs.push_back({key});
    runs.back().add({key, 1, r < cylinder.radius_m, false, r});
  }
  std::sort(runs.begin(), runs.end(),
            [](const ReachCell& a, const ReachCell& b) { return a.key < b.key; });
  std::vector<ReachCell> cells;
  for (const ReachCell& run : runs) {
    if (cells.empty() || cells.back().key != run.key) cells.push_back({run.key});
    cells.back().add(run);
  }
  return cells;
}

void drop_sparse(std::vector<ReachCell>& cells) {
  std::vector<std::uint32_t> counts;
  for (const ReachCell& cell : cells)
    if (cell.inside) counts.push_back(cell.points);
  if (counts.empty()) return cells.clear();
  const auto middle = counts.begin() + std::ptrdiff_t(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  const double least = std::max(double(kMinReachPoints), kDenseShare * double(*middle));
  std::erase_if(cells, [&](const ReachCell& cell) { return double(cell.points) < least; });
}

void flood_from_inside(std::vector<ReachCell>& cells) {
  std::vector<std::size_t> work;
  const auto reach = [&](std::size_t i) {
    if (cells[i].reached) return;
    cells[i].reached = true;
    work.push_back(i);
  };
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].inside) reach(i);
  while (!work.empty()) {
    const std::uint64_t key = cells[work.back()].key;
    work.pop_back();
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        // Cells adjacent along z have consecutive keys.
        const std::uint64_t middle = key + std::uint64_t(x * (std::int64_t(1) << (2 * kBits)) +
                                                         y * (std::int64_t(1) << kBits));
        auto at = std::lower_bound(cells.begin(), cells.end(), middle - 1,
                                   [](const ReachCell& c, std::uint64_t k) { return c.key < k; });
        for (; at != cells.end() && at->key <= middle + 1; ++at)
          reach(std::size_t(at - cells.begin()));
      }
    }
  }
}

}  // namespace

std::optional<double> reach_beyond(const std::vector<Vec3f>& p_table, const Cylinder& cylinder,
                                   double cell_m) {
  // Keys can represent three radii.
  if (!(cell_m > 0.0) || kFarthest * cylinder.radius_m > cell_m * double(kHalf / 2) ||
      cylinder.height_m > cell_m * double(kHalf / 2))
    return std::nullopt;
  std::vector<ReachCell> cells = cells_of(p_table, cylinder, cell_m);
  drop_sparse(cells);
  flood_from_inside(cells);
  double reach_m = 0.0;
  for (const ReachCell& cell : cells)
    if (cell.reached && !cell.inside) reach_m = std::max(reach_m, cell.farthest_m);
  if (!(reach_m > cylinder.radius_m)) return std::nullopt;
  return reach_m;
}

}  // namespace turnscan::estimation
