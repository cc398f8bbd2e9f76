#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/reconstruction/outliers/outliers_bounds.hpp>

namespace turnscan::outliers {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kBefore = kBand + 1;              // entries ahead of the first line
constexpr int kBehind = kBand + kMaxLanes + 1;  // and behind the last
static_assert(kPad <= kBand && kMaxLanes <= kBand);

/// Depths below this do not count as in front: ratios of coordinates must stay finite.
constexpr double kNearest = 1e-6;

bool all_in_front(const FramePoints& frame, const Vec3d& origin, const Vec3d& forward) {
  return std::all_of(frame.cloud.points.begin(), frame.cloud.points.end(), [&](const Vec3f& p) {
    return (p.cast<double>() - origin).dot(forward) > kNearest;
  });
}

/// Places across the rays against grid positions, on a sample of the points: axes need not be
/// exact.
struct Sample {
  double n = 0.0, column = 0.0, row = 0.0;  ///< means, once closed
  Vec3d place = Vec3d::Zero();
  double column_column = 0.0, row_row = 0.0;  ///< sums of products of deviations
  Eigen::Matrix3d place_place = Eigen::Matrix3d::Zero();
  Vec3d place_column = Vec3d::Zero(), place_row = Vec3d::Zero();
};

/// Calls visit(place, column, row) for the points of the sample.
template <class Visit>
void for_each_place(const FramePoints& frame, const BoundFrame& bounds, const Visit& visit) {
  const std::size_t step = frame.cell.size() / 1024 + 1;
  for (std::size_t i = 0; i < frame.cell.size(); i += step) {
    const Vec3d p = frame.cloud.points[i].cast<double>() - bounds.origin;
    visit(bounds.central() ? Vec3d(p / p.dot(bounds.w) - bounds.w) : p,
          double(frame.cell[i] % frame.width), double(frame.cell[i] / frame.width));
  }
}

Sample sample(const FramePoints& frame, const BoundFrame& bounds) {
  Sample s;
  for_each_place(frame, bounds, [&s](const Vec3d& place, double column, double row) {
    s.n += 1.0, s.place += place, s.column += column, s.row += row;
  });
  s.place /= s.n, s.column /= s.n, s.row /= s.n;
  for_each_place(frame, bounds, [&s](const Vec3d& place, double column, double row) {
    const Vec3d d = place - s.place;
    column -= s.column, row -= s.row;
    s.column_column += column * column, s.row_row += row * row;
    s.place_place += d * d.transpose();
    s.place_column += column * d, s.place_row += row * d;
  });
  return s;
}

/// x / z grows with the column and y / z with the row, and hardly with anything else.
bool axes_fit(const Sample& s) {
  const auto fits = [](double covariance, double a, double b) {
    return a == 0.0 || b == 0.0 || covariance > 0.99 * std::sqrt(a * b);
  };
  return fits(s.place_column.x(), s.place_place(0, 0), s.column_column) &&
         fits(s.place_row.y(), s.place_place(1, 1), s.row_row);
}

/// The direction in which the column is best predicted, and the same for the row, by least squares
/// with a ridge that keeps out directions in which the places hardly differ.
void choose_axes(const Sample& s, BoundFrame& bounds) {
  const Eigen::Matrix3d ridge =
      (1e-4 * s.place_place.trace() + 1e-30) * Eigen::Matrix3d::Identity();
  const Eigen::LDLT<Eigen::Matrix3d> spread(s.place_place + ridge);
  const auto axis = [&](const Vec3d& covariance) -> Vec3d {
    Vec3d e = spread.solve(covariance);
    if (bounds.central()) e -= e.dot(bounds.w) * bounds.w;
    return e.allFinite() && e.norm() > 0.0 ? Vec3d(e.normalized()) : bounds.w.unitOrthogonal();
  };
  bounds.u = axis(s.place_column);
  bounds.v = axis(s.place_row);
}

/// Rays from the viewpoint, all forward.
bool choose_central(const FramePoints& frame, BoundFrame& bounds) {
  bounds.kind = BoundFrame::Kind::kCentral;
  bounds.origin = frame.viewpoint.value;
  if (frame.viewpoint.parallel || !bounds.origin.allFinite()) return false;
  Vec3d mean = Vec3d::Zero();
  for (const Vec3f& p : frame.cloud.points) mean += p.cast<double>() - bounds.origin;
  if (!(mean.norm() > 0.0)) return false;
  bounds.w = mean.normalized();
  return all_in_front(frame, bounds.origin, bounds.w);
}

}  // namespace

BoundFrame choose_bound_frame(const FramePoints& frame) {
  BoundFrame bounds;
  const bool at_origin = !frame.viewpoint.parallel && frame.viewpoint.value.isZero(0.0);
  if (at_origin && all_in_front(frame, bounds.origin, bounds.w) && axes_fit(sample(frame, bounds)))
    return bounds;
  if (!choose_central(frame, bounds)) {
    bounds = BoundFrame();
    bounds.kind = BoundFrame::Kind::kLinear;
  }
  choose_axes(sample(frame, bounds), bounds);
  return bounds;
}

void Extents::reset(int lines, int across) {
  lines_ = lines;
  blocks_ = (across + kBand - 1) / kBand;
  low_.assign(std::size_t(lines_) * std::size_t(blocks_), kInfinity);
  high_.assign(std::size_t(lines_) * std::size_t(blocks_), -kInfinity);
}

void Extents::merge(int begin, int end, std::vector<float>& low, std::vector<float>& high) const {
  low.assign(std::size_t(lines_), kInfinity);
  high.assign(std::size_t(lines_), -kInfinity);
  for (int block = std::max(begin, 0); block < std::min(end, blocks_); ++block) {
    const float* block_low = low_.data() + std::ptrdiff_t(block) * lines_;
    const float* block_high = high_.data() + std::ptrdiff_t(block) * lines_;
    for (int i = 0; i < lines_; ++i) {
      low[i] = std::min(low[i], block_low[i]);
      high[i] = std::max(high[i], block_high[i]);
    }
  }
}

void BorderTables::resize(int lines, int bands) {
  lines_ = lines;
  bands_ = bands;
  length_ = kBefore + lines + kBehind;
  values_.resize(std::size_t(6 * length_) * std::size_t(bands));
  planes_.resize(std::size_t(length_));
}

Border BorderTables::border(int side) const {
  const float* base = values_.data() + 3 * length_ * side + kBefore;
  return {base, base + length_, base + 2 * length_, bands_ > 1 ? 6 * length_ : 0};
}

/// Beyond: u / w >= plane there, hence (plane * w - u) / sqrt(1 + plane^2) is the distance of
/// (u, w) to all of it; before, with the signs turned.
void BorderTables::fill(int band, int side, bool central) {
  float* a = values_.data() + 6 * length_ * band + 3 * length_ * side;
  float *b = a + length_, *offset = b + length_;
  const double sign = side == 0 ? -1.0 : 1.0;
  for (std::ptrdiff_t i = 0; i < length_; ++i) {
    const bool there = std::abs(planes_[i]) < double(kInfinity);
    // u, w and their ratio are each rounded by half a unit of 2^-23.
    const double plane = there ? planes_[i] - sign * std::abs(planes_[i]) * 0x1p-21 : 0.0;
    const double scale = there ? (central ? 1.0 / std::sqrt(1.0 + plane * plane) : 1.0) : 0.0;
    a[i] = static_cast<float>(central ? sign * plane * scale : 0.0);
    b[i] = static_cast<float>(-sign * scale);
    offset[i] = there ? static_cast<float>(central ? 0.0 : sign * plane) : kInfinity;
  }
}

void BorderTables::build(int band, bool central) {
  double highest = -kInfinity, lowest = kInfinity;
  for (std::ptrdiff_t i = 0; i < length_; ++i) {
    const std::ptrdiff_t line = i - kBefore;
    if (line >= 0 && line < lines_) highest = std::max(highest, double(high_[line]));
    planes_[i] = highest;
  }
  fill(band, 0, central);
  for (std::ptrdiff_t i = length_ - 1; i >= 0; --i) {
    const std::ptrdiff_t line = i - kBefore;
    if (line >= 0 && line < lines_) lowest = std::min(lowest, double(low_[line]));
    planes_[i] = lowest;
  }
  fill(band, 1, central);
}

double BorderTables::build_whole(const Extents& extents, bool central) {
  resize(extents.lines(), 1);
  extents.merge(0, extents.blocks(), low_, high_);
  build(0, central);
  double width = 0.0, low = kInfinity, high = -kInfinity;
  for (int i = 0; i < lines_; ++i) {
    if (low_[i] > high_[i]) continue;
    width += double(high_[i]) - double(low_[i]);
    low = std::min(low, double(low_[i])), high = std::max(high, double(high_[i]));
  }
  return high > low ? width / (high - low) : 0.0;
}

void BorderTables::build_bands(const Extents& extents, bool central) {
  resize(extents.lines(), extents.blocks());
  for (int band = 0; band < extents.blocks(); ++band) {
    extents.merge(band - 1, band + 2, low_, high_);
    build(band, central);
  }
}

}  // namespace turnscan::outliers
