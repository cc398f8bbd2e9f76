#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <turnscan/reconstruction/outliers/view_grid.hpp>

namespace turnscan::outliers {

namespace {

/// Directions farther from +z than this slope, or cells smaller than this, are left to a tree:
/// between the two, rounding of a direction is far below kRounding cells.
constexpr double kSteepest = 100.0, kLeastCell = 1e-6;
/// Share of a cell that is subtracted from a distance to the cells outside.
constexpr double kRounding = 1e-3;
constexpr std::uint32_t kMostInCell = 24;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct Span {
  double low = kUnbounded, high = -kUnbounded;

  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  double length() const { return high - low; }
};

}  // namespace

void ViewGrid::Axis::divide(double low, double high, double cell) {
  first = low;
  const int cells = int((high - low) / cell) + 1;
  for (int i = 0; i <= cells; ++i) {
    const double at = low + i * cell;
    lines.push_back({at, 1.0 / std::sqrt(1.0 + at * at)});
  }
}

int ViewGrid::Axis::cell_of(double at, double per_cell) const {
  return std::min(int((at - first) * per_cell), cells() - 1);
}

double ViewGrid::Axis::clearance(double sideways, double z, int cell, int reach) const {
  double out = kUnbounded;
  if (cell - reach > 0) {
    const Line& low = lines[std::size_t(cell - reach)];
    out = (sideways - low.at * z) * low.per_length;
  }
  if (cell + reach + 1 < cells()) {
    const Line& high = lines[std::size_t(cell + reach + 1)];
    out = std::min(out, (high.at * z - sideways) * high.per_length);
  }
  return out;
}

std::optional<ViewGrid> ViewGrid::build(std::span<const Vec3f> points) {
  Span across, down;
  for (const Vec3f& p : points) {
    const double x = p.x(), y = p.y(), z = p.z();
    if (!(z > 0.0 && std::max(std::abs(x), std::abs(y)) < kSteepest * z)) return std::nullopt;
    across.add(x / z);
    down.add(y / z);
  }
  // One cell a point, also where all lie along a line.
  const double longest = std::max(across.length(), down.length()), n = double(points.size());
  const double cell = std::max(std::sqrt(across.length() * down.length() / n), longest / n);
  if (!(cell > kLeastCell)) return std::nullopt;
  ViewGrid out;
  out.per_cell_ = 1.0 / cell;
  out.columns_.divide(across.low, across.high, cell);
  out.rows_.divide(down.low, down.high, cell);

  std::vector<std::uint32_t> cell_of_point;
  cell_of_point.reserve(points.size());
  out.begin_.assign(std::size_t(out.columns_.cells()) * std::size_t(out.rows_.cells()) + 1, 0);
  for (const Vec3f& p : points) {
    const double z = p.z();
    const int column = out.columns_.cell_of(double(p.x()) / z, out.per_cell_);
    const int row = out.rows_.cell_of(double(p.y()) / z, out.per_cell_);
    cell_of_point.push_back(std::uint32_t(row * out.columns_.cells() + column));
    if (++out.begin_[cell_of_point.back()] > kMostInCell) return std::nullopt;
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : out.begin_) begin = sum += begin;
  out.points_.resize(points.size());
  // From behind, so that each begin, which still is the end, moves to its place.
  for (std::size_t i = points.size(); i-- > 0;)
    out.points_[--out.begin_[cell_of_point[i]]] = points[i];
  return out;
}

/// The smallest squared distances so far, ascending.
struct ViewGrid::Search {
  const ViewGrid& grid;
  Vec3f from;
  std::size_t k;
  float* squared;
  std::size_t found = 0;

  /// The points of some cells of a row.
  void add(int row, int first, int last) {
    const int columns = grid.columns_.cells();
    if (row < 0 || row >= grid.rows_.cells() || last < 0 || first >= columns) return;
    const std::size_t end = grid.cell_begin(row, std::min(last, columns - 1) + 1);
    for (std::size_t i = grid.cell_begin(row, std::max(first, 0)); i < end; ++i) {
      const Vec3f& p = grid.points_[i];
      const float dx = p.x() - from.x(), dy = p.y() - from.y(), dz = p.z() - from.z();
      add(dx * dx + dy * dy + dz * dz);
    }
  }

  /// The larger of two moves on: no branch, which could not be predicted.
  void add(float distance) {
    ++found;
    if (!(distance < squared[k - 1])) return;
    for (std::size_t i = 0; i < k; ++i) {
      const float here = squared[i];
      squared[i] = std::min(here, distance);
      distance = std::max(here, distance);
    }
  }
};

std::size_t ViewGrid::nearest(const Vec3f& p, std::size_t k, float* squared) const {
  const double x = p.x(), y = p.y(), z = p.z(), rounding = kRounding * z / per_cell_;
  const int column = columns_.cell_of(x / z, per_cell_), row = rows_.cell_of(y / z, per_cell_);
  Search search{*this, p, k, squared};
  std::fill_n(squared, k, std::numeric_limits<float>::infinity());
  // With one point a cell, a disc with k of them does not reach farther.
  int reach = int(std::ceil(std::sqrt(double(k) / std::numbers::pi)));
  for (int r = row - reach; r <= row + reach; ++r) search.add(r, column - reach, column + reach);
  for (;;) {
    const std::size_t count = std::min(k, search.found);
    const double outside =
        std::min(columns_.clearance(x, z, column, reach), rows_.clearance(y, z, row, reach)) -
        rounding;
    if (count == std::min(k, points_.size()) && outside > 0.0 &&
        double(squared[count - 1]) <= outside * outside)
      return count;
    ++reach;
    search.add(row - reach, column - reach, column + reach);
    for (int r = row - reach + 1; r < row + reach; ++r) {
      search.add(r, column - reach, column - reach);
      search.add(r, column + reach, column + reach);
    }
    search.add(row + reach, column - reach, column + reach);
  }
}

}  // namespace turnscan::outliers
