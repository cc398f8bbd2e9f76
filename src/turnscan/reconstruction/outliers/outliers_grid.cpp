#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <turnscan/reconstruction/outliers/outliers_grid.hpp>

namespace turnscan::outliers {

namespace {

/// Row of a cell without a division as long as cells come in order.
class RowOf {
 public:
  explicit RowOf(int width) : width_(width) {}
  int operator()(std::int32_t cell) {
    const std::int64_t ahead = std::int64_t(cell) - begin_;
    if (ahead < 0 || ahead >= width_) {
      row_ = cell / width_;
      begin_ = std::int64_t(row_) * width_;
    }
    return row_;
  }

 private:
  int width_, row_ = 0;
  std::int64_t begin_ = 0;
};

}  // namespace

bool PointGrid::build(const FramePoints& frame) {
  if (!find_box(frame)) return false;
  bounds_ = choose_bound_frame(frame);
  lay_out(frame);
  if (!place(frame)) return false;
  if (bounds_.kind != BoundFrame::Kind::kPinhole) place_bound_coordinates(frame);
  build_borders(bounds_.central());
  move_origin();
  return true;
}

bool PointGrid::find_box(const FramePoints& frame) {
  const std::int64_t cells = std::int64_t(frame.width) * frame.height;
  RowOf row_of(frame.width);
  int left = frame.width, right = -1, top = frame.height, bottom = -1;
  for (const std::int32_t cell : frame.cell) {
    if (cell < 0 || cell >= cells)
      throw std::invalid_argument("statistical_outlier_mask: a cell is outside the grid");
    const int row = row_of(cell), column = static_cast<int>(cell - std::int64_t(row) * frame.width);
    left = std::min(left, column), right = std::max(right, column);
    top = std::min(top, row), bottom = std::max(bottom, row);
  }
  first_column_ = left, first_row_ = top;
  grid_.columns = right - left + 1;
  grid_.rows = bottom - top + 1;
  grid_.stride = grid_.columns + 2 * kPad + kMaxLanes;
  const std::int64_t size = std::int64_t(grid_.stride) * (grid_.rows + 2 * kPad);
  return size <= std::int64_t(64 * frame.cell.size() + 65536);
}

void PointGrid::lay_out(const FramePoints& frame) {
  const std::size_t size =
      std::size_t(grid_.stride) * std::size_t(grid_.rows + 2 * kPad) + kMaxLanes;
  x_.resize(size), y_.resize(size);
  // Stale x and y in empty cells do no harm: z alone makes the distance infinite.
  z_.assign(size, kHole);
  position_.resize(frame.cell.size());
  columns_.reset(grid_.columns, grid_.rows);
  rows_.reset(grid_.rows, grid_.columns);
  const bool own = bounds_.kind == BoundFrame::Kind::kPinhole;
  if (!own) u_.resize(size), v_.resize(size), w_.resize(size);
  grid_.x = x_.data(), grid_.y = y_.data(), grid_.z = z_.data();
  grid_.u = own ? grid_.x : u_.data();
  grid_.v = own ? grid_.y : v_.data();
  grid_.w = own ? grid_.z : w_.data();
  // A bound's two products and its sum are each rounded once, its factors once more.
  grid_.margin = 0.0f;
  grid_.margin_relative = 0x1p-21f;
}

bool PointGrid::place(const FramePoints& frame) {
  RowOf row_of(frame.width);
  const bool pinhole = bounds_.kind == BoundFrame::Kind::kPinhole;
  for (std::size_t i = 0; i < frame.cell.size(); ++i) {
    const int frame_row = row_of(frame.cell[i]);
    const int row = frame_row - first_row_;
    const int column =
        static_cast<int>(frame.cell[i] - std::int64_t(frame_row) * frame.width) - first_column_;
    const std::ptrdiff_t at = (row + kPad) * grid_.stride + column + kPad;
    if (z_[at] != kHole) return false;
    const Vec3f& p = frame.cloud.points[i];
    x_[at] = p.x(), y_[at] = p.y(), z_[at] = p.z();
    position_[i] = static_cast<std::int32_t>(at);
    if (!pinhole) continue;
    columns_.add(column, row, p.x() / p.z());
    rows_.add(row, column, p.y() / p.z());
  }
  return true;
}

void PointGrid::place_bound_coordinates(const FramePoints& frame) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < position_.size(); ++i) {
    const Vec3d p = frame.cloud.points[i].cast<double>() - bounds_.origin;
    const auto u = static_cast<float>(p.dot(bounds_.u)), v = static_cast<float>(p.dot(bounds_.v));
    const auto w = bounds_.central() ? static_cast<float>(p.dot(bounds_.w)) : 1.0f;
    const std::int32_t at = position_[i];
    u_[at] = u, v_[at] = v, w_[at] = w;
    largest = std::max(largest, std::abs(u) + std::abs(v) + std::abs(w));
    const auto row = static_cast<int>(at / grid_.stride) - kPad;
    const auto column = static_cast<int>(at % grid_.stride) - kPad;
    columns_.add(column, row, u / w);
    rows_.add(row, column, v / w);
  }
  grid_.margin = 0x1p-20f * largest;
  grid_.margin_relative = 0.0f;
}

void PointGrid::build_borders(bool central) {
  // Lines of the grid that are bent (by a lens, or by depth in scans that are not from one point)
  // are told apart better within a band.
  constexpr double kBentSteps = 0.5;
  const double width = std::max(column_table_.build_whole(columns_, central),
                                row_table_.build_whole(rows_, central));
  grid_.whole = {column_table_.before(), column_table_.beyond(), row_table_.before(),
                 row_table_.beyond()};
  grid_.bent = width > kBentSteps;
  if (!grid_.bent) return;
  column_bands_.build_bands(columns_, central);
  row_bands_.build_bands(rows_, central);
  grid_.bands = {column_bands_.before(), column_bands_.beyond(), row_bands_.before(),
                 row_bands_.beyond()};
}

/// The arrays as the kernels see them begin at the first cell of the box.
void PointGrid::move_origin() {
  const std::ptrdiff_t origin = kPad * grid_.stride + kPad;
  for (const float** array : {&grid_.x, &grid_.y, &grid_.z, &grid_.u, &grid_.v, &grid_.w})
    *array += origin;
  for (std::int32_t& at : position_) at -= static_cast<std::int32_t>(origin);
}

namespace {

/// Beyond so many cells in windows of single points a tree is faster.
std::uint64_t affordable_cells(std::size_t points) { return 2000 * points + (1u << 24); }

struct Buffers {
  PointGrid grid;
  std::vector<float> mean;
};

}  // namespace

bool grid_mean_distances(const FramePoints& frame, int k, std::span<float> mean) {
  static thread_local Buffers buffers;
  if (k > kMaxK || !buffers.grid.build(frame)) return false;
  const Grid& grid = buffers.grid.grid();
  buffers.mean.resize(buffers.grid.array_size());
  std::uint64_t cells = 0;
  for (int row = 0; row < grid.rows; ++row) {
    cells +=
        OutlierKernels::current().search_row(grid, row, k, buffers.mean.data() + row * grid.stride);
    if (cells > affordable_cells(mean.size())) return false;
  }
  const std::vector<std::int32_t>& position = buffers.grid.position();
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = buffers.mean[position[i]];
  return true;
}

}  // namespace turnscan::outliers
