#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/reconstruction/outliers_bounds.hpp>

namespace turnscan::outliers {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kBefore = kPad + 1;              // entries ahead of the first column
constexpr int kBehind = kPad + kMaxLanes + 1;  // and behind the last

/// Depths below this do not count as in front: ratios of coordinates must stay finite.
constexpr double kNearest = 1e-6;

bool all_in_front(const std::vector<Vec3f>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Vec3f& p) { return p.z() > float(kNearest); });
}

bool choose_forward(const FramePoints& frame, BoundFrame& bounds) {
  if (!bounds.origin.allFinite()) return false;
  Vec3d mean = Vec3d::Zero();
  for (const Vec3f& p : frame.cloud.points) mean += p.cast<double>() - bounds.origin;
  if (!(mean.norm() > 0.0)) return false;
  bounds.w = mean.normalized();
  return std::all_of(frame.cloud.points.begin(), frame.cloud.points.end(),
                     [&bounds](const Vec3f& p) {
                       return (p.cast<double>() - bounds.origin).dot(bounds.w) > kNearest;
                     });
}

/// Calls visit(place across the rays, column, row) for each point.
template <class Visit>
void for_each_place(const FramePoints& frame, const BoundFrame& bounds, const Visit& visit) {
  for (std::size_t i = 0; i < frame.cell.size(); ++i) {
    const Vec3d p = frame.cloud.points[i].cast<double>() - bounds.origin;
    const double depth = p.dot(bounds.w);
    visit(bounds.central() ? Vec3d(p / depth - bounds.w) : p, frame.cell[i] % frame.width,
          frame.cell[i] / frame.width);
  }
}

/// The direction in which the column is best predicted, and the same for the row, by least squares
/// with a ridge that keeps out directions in which the places hardly differ.
void choose_axes(const FramePoints& frame, BoundFrame& bounds) {
  Vec3d place_mean = Vec3d::Zero();
  double column_mean = 0.0, row_mean = 0.0;
  for_each_place(frame, bounds, [&](const Vec3d& place, int column, int row) {
    place_mean += place, column_mean += column, row_mean += row;
  });
  const double n = static_cast<double>(frame.cell.size());
  place_mean /= n, column_mean /= n, row_mean /= n;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Vec3d with_column = Vec3d::Zero(), with_row = Vec3d::Zero();
  for_each_place(frame, bounds, [&](const Vec3d& place, int column, int row) {
    const Vec3d d = place - place_mean;
    spread += d * d.transpose();
    with_column += (column - column_mean) * d, with_row += (row - row_mean) * d;
  });
  spread += (1e-4 * spread.trace() + 1e-30) * Eigen::Matrix3d::Identity();
  const auto axis = [&](const Vec3d& covariance, const Vec3d& otherwise) -> Vec3d {
    Vec3d e = spread.ldlt().solve(covariance);
    if (bounds.central()) e -= e.dot(bounds.w) * bounds.w;
    return e.allFinite() && e.norm() > 0.0 ? Vec3d(e.normalized()) : otherwise;
  };
  const Vec3d any = bounds.w.unitOrthogonal();
  bounds.u = axis(with_column, any);
  bounds.v = axis(with_row, any);
}

}  // namespace

BoundFrame choose_bound_frame(const FramePoints& frame) {
  const Viewpoint& viewpoint = frame.viewpoint;
  BoundFrame bounds;
  if (!viewpoint.parallel && viewpoint.value.isZero(0.0) && all_in_front(frame.cloud.points))
    return bounds;
  bounds.kind = BoundFrame::Kind::kCentral;
  bounds.origin = viewpoint.value;
  if (viewpoint.parallel || !choose_forward(frame, bounds)) {
    bounds = BoundFrame();
    bounds.kind = BoundFrame::Kind::kLinear;
  }
  choose_axes(frame, bounds);
  return bounds;
}

void Extent::reset(int count) {
  low.assign(count, kInfinity);
  high.assign(count, -kInfinity);
}

Border BorderTables::border(int side) const {
  const float* base = values_.data() + std::size_t(side) * 3 * length_ + kBefore;
  return {base, base + length_, base + 2 * length_};
}

/// Beyond: u / w >= plane there, hence (plane * w - u) / sqrt(1 + plane^2) is the distance of
/// (u, w) to all of it; before, with the signs turned.
void BorderTables::set(int side, int i, double plane, bool central) {
  float* entry = values_.data() + std::size_t(side) * 3 * length_ + kBefore + i;
  const double sign = side == 0 ? -1.0 : 1.0;
  float a = 0.0f, b = 0.0f, offset = kInfinity;
  if (std::isfinite(plane)) {
    // u, w and their ratio are each rounded by half a unit of 2^-23.
    const double outer = plane - sign * std::abs(plane) * 0x1p-21;
    const double scale = central ? 1.0 / std::sqrt(1.0 + outer * outer) : 1.0;
    a = static_cast<float>(central ? sign * outer * scale : 0.0);
    b = static_cast<float>(-sign * scale);
    offset = static_cast<float>(central ? 0.0 : sign * outer);
  }
  entry[0] = a;
  entry[length_] = b;
  entry[2 * length_] = offset;
}

void BorderTables::build(const Extent& extent, bool central) {
  count_ = static_cast<int>(extent.low.size());
  length_ = kBefore + count_ + kBehind;
  values_.resize(std::size_t(6) * length_);
  double highest = -kInfinity, lowest = kInfinity;
  for (int i = -kBefore; i < count_ + kBehind; ++i) {
    if (i >= 0 && i < count_) highest = std::fmax(highest, extent.high[i]);
    set(0, i, highest, central);
  }
  for (int i = count_ + kBehind - 1; i >= -kBefore; --i) {
    if (i >= 0 && i < count_) lowest = std::fmin(lowest, extent.low[i]);
    set(1, i, lowest, central);
  }
}

}  // namespace turnscan::outliers
