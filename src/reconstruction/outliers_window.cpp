#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/outliers_grid.hpp>

namespace turnscan::outliers {

namespace {

/// The k + 1 nearest of one point, itself among them: rows are looked at from its own outwards,
/// until no row further out can hold a nearer one.
class WindowSearch {
 public:
  WindowSearch(const Grid& grid, const Unsettled& point, int k, std::vector<float>& near)
      : grid_(grid),
        column_(point.column),
        row_(point.row),
        at_(point.row * grid.stride + point.column),
        count_(std::size_t(k) + 1),
        near_(near) {
    margin_ = grid.margin + grid.margin_relative * (std::abs(grid.x[at_]) + std::abs(grid.y[at_]) +
                                                    std::abs(grid.z[at_]));
    near_.resize(std::max(near_.size(), 2 * count_ + 64 + std::size_t(grid.columns) + kMaxLanes));
    limit_ = point.squared_distance;
    if (!std::isfinite(limit_)) limit_ = limit_of_growing_square();
  }

  /// Sum of the roots in double and ascending, rounded once: as PCL does.
  float mean() {
    scan();
    trim();
    std::sort(near_.begin(), near_.begin() + std::ptrdiff_t(count_));
    double sum = 0.0;
    for (std::size_t i = 1; i < count_; ++i) sum += std::sqrt(double(near_[i]));
    return static_cast<float>(sum / double(count_ - 1));
  }

  std::uint64_t cells() const { return cells_; }

 private:
  float limit_of_growing_square();
  bool clear(const Border& border, int i, float u) const {
    const float bound = border.a[i] * grid_.w[at_] + border.b[i] * u + border.offset[i] - margin_;
    return bound > 0.0f && bound * bound * kShrink >= limit_;
  }
  void narrow() {
    const float u = grid_.u[at_];
    int first = column_, last = column_;
    while (first > 0 && !clear(grid_.before_column, first - 1, u)) --first;
    while (last + 1 < grid_.columns && !clear(grid_.beyond_column, last + 1, u)) ++last;
    first_ = first, last_ = last;
  }
  void visit(int row) {
    const int n = last_ - first_ + 1;
    found_ +=
        kernel().collect(grid_, at_, row * grid_.stride + first_, n, limit_, near_.data() + found_);
    cells_ += std::uint64_t(n);
    if (found_ > 2 * count_ + 64) {
      trim();
      narrow();
    }
  }
  void trim() {
    if (found_ < count_) return;
    std::nth_element(near_.begin(), near_.begin() + std::ptrdiff_t(count_ - 1),
                     near_.begin() + std::ptrdiff_t(found_));
    found_ = count_;
    limit_ = near_[count_ - 1];
  }
  void scan();

  const Grid& grid_;
  int column_, row_;
  std::ptrdiff_t at_;
  std::size_t count_;
  std::vector<float>& near_;
  float margin_ = 0.0f;
  float limit_ = 0.0f;  ///< at least count_ points are within this squared distance
  std::size_t found_ = 0;
  int first_ = 0, last_ = 0;
  std::uint64_t cells_ = 0;
};

/// Any square of cells with enough points in it gives a limit.
float WindowSearch::limit_of_growing_square() {
  limit_ = std::numeric_limits<float>::max();
  for (int reach = 1 + static_cast<int>(std::sqrt(double(count_)) / 2.0);; reach *= 2) {
    found_ = 0;
    first_ = std::max(column_ - reach, 0);
    last_ = std::min(column_ + reach, grid_.columns - 1);
    const int top = std::max(row_ - reach, 0), bottom = std::min(row_ + reach, grid_.rows - 1);
    const bool whole = last_ - first_ + 1 == grid_.columns && bottom - top + 1 == grid_.rows;
    for (int row = top; row <= bottom; ++row) {
      found_ += kernel().collect(grid_, at_, row * grid_.stride + first_, last_ - first_ + 1,
                                 limit_, near_.data() + found_);
      cells_ += std::uint64_t(last_ - first_ + 1);
      if (found_ > 2 * count_ + 64) trim();
    }
    if (found_ >= count_ || whole) break;
  }
  trim();
  found_ = 0;
  return limit_;
}

void WindowSearch::scan() {
  narrow();
  visit(row_);
  bool up = true, down = true;
  for (int step = 1; up || down; ++step) {
    up = up && row_ - step >= 0 && !clear(grid_.before_row, row_ - step, grid_.v[at_]);
    if (up) visit(row_ - step);
    down = down && row_ + step < grid_.rows && !clear(grid_.beyond_row, row_ + step, grid_.v[at_]);
    if (down) visit(row_ + step);
  }
}

}  // namespace

float window_mean_distance(const Grid& grid, const Unsettled& point, int k,
                           std::vector<float>& near, std::uint64_t& cells) {
  WindowSearch search(grid, point, k, near);
  const float mean = search.mean();
  cells += search.cells();
  return mean;
}

}  // namespace turnscan::outliers
