#include <algorithm>
#include <limits>
#include <queue>
#include <turnscan/geometry/mesh/hole_patch.hpp>

namespace turnscan::mesh {
namespace {

constexpr std::uint32_t kLargestExact = 200;  // cubic time, quadratic memory
constexpr double kInwardPenalty = 100.0;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Area; short edges decide between triangulations of equal area.
double cost(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double lengths = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 0.5 * (b - a).cross(c - a).norm() + 1e-3 * lengths;
}

/// Least cost over all triangulations of a closed polygon (Barequet and Sharir 1995).
class ExactTriangulation {
 public:
  ExactTriangulation(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& polygon,
                     const EdgeTaken& taken)
      : points_(points), polygon_(polygon), taken_(taken), n_(polygon.size()) {
    cost_.assign(n_ * n_, 0.0);
    middle_.assign(n_ * n_, 0);
  }

  /// False if every triangulation needs an edge that is taken.
  bool run(std::vector<Triangle>& triangles) {
    for (std::size_t span = 2; span < n_; ++span) {
      for (std::size_t i = 0; i + span < n_; ++i) fill_entry(i, i + span);
    }
    if (cost_[n_ - 1] == kInfinite) return false;
    std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n_ - 1}};
    while (!open.empty()) {
      const auto [i, k] = open.back();
      open.pop_back();
      if (k - i < 2) continue;
      const std::size_t m = middle_[i * n_ + k];
      triangles.push_back({polygon_[i], polygon_[m], polygon_[k]});
      open.emplace_back(i, m);
      open.emplace_back(m, k);
    }
    return true;
  }

 private:
  void fill_entry(std::size_t i, std::size_t k) {
    double best = kInfinite;
    const bool chord = k - i + 1 < n_;  // (0, n - 1) is an edge of the polygon
    if (!chord || !taken_(polygon_[i], polygon_[k])) {
      for (std::size_t m = i + 1; m < k; ++m) {
        const double rest = cost_[i * n_ + m] + cost_[m * n_ + k];
        if (!(rest < best)) continue;
        const double total =
            rest + cost(points_[polygon_[i]], points_[polygon_[m]], points_[polygon_[k]]);
        if (!(total < best)) continue;
        best = total;
        middle_[i * n_ + k] = std::uint16_t(m);
      }
    }
    cost_[i * n_ + k] = best;
  }

  const std::vector<Vec3d>& points_;
  const std::vector<std::uint32_t>& polygon_;
  const EdgeTaken& taken_;
  std::size_t n_;
  std::vector<double> cost_;
  std::vector<std::uint16_t> middle_;
};

/// Cuts off the cheapest corners of a polygon until it is small enough for the exact method.
class CornerCutter {
 public:
  CornerCutter(const std::vector<Vec3d>& points, const EdgeTaken& taken)
      : points_(points),
        taken_(taken),
        next_(points.size()),
        previous_(points.size()),
        version_(points.size(), 0) {
    const auto n = std::uint32_t(points.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      facing_ += (points[i] - points[0]).cross(points[next_[i]] - points[0]);
    }
    for (std::uint32_t i = 0; i < n; ++i) offer(i);
  }

  std::vector<std::uint32_t> run(std::vector<Triangle>& triangles) {
    std::size_t left = points_.size();
    std::uint32_t some = 0;
    while (left > kLargestExact && !corners_.empty()) {
      const Corner corner = corners_.top();
      corners_.pop();
      const std::uint32_t i = corner.at;
      if (corner.version != version_[i]) continue;
      const std::uint32_t a = previous_[i], b = next_[i];
      triangles.push_back({a, i, b});
      next_[a] = b;
      previous_[b] = a;
      ++version_[i];
      some = a;
      --left;
      offer(a);
      offer(b);
    }
    std::vector<std::uint32_t> rest(1, some);
    for (std::uint32_t i = next_[some]; i != some; i = next_[i]) rest.push_back(i);
    return rest;
  }

 private:
  struct Corner {
    double cost;
    std::uint32_t at, version;
    bool operator<(const Corner& o) const {  // the top of the queue is the cheapest, then the
                                             // lowest
      return cost > o.cost || (cost == o.cost && at > o.at);
    }
  };

  void offer(std::uint32_t i) {
    ++version_[i];
    const std::uint32_t a = previous_[i], b = next_[i];
    if (taken_(a, b)) return;
    // A corner that bends the wrong way is outside a flat hole.
    const Vec3d normal = (points_[i] - points_[a]).cross(points_[b] - points_[i]);
    const double factor = normal.dot(facing_) > 0.0 ? 1.0 : kInwardPenalty;
    corners_.push({factor * (points_[b] - points_[a]).squaredNorm(), i, version_[i]});
  }

  const std::vector<Vec3d>& points_;
  const EdgeTaken& taken_;
  std::vector<std::uint32_t> next_, previous_, version_;
  std::priority_queue<Corner> corners_;
  Vec3d facing_ = Vec3d::Zero();  // twice the area vector of the loop
};

void fan_around_mean(HolePatch& patch, const std::vector<std::uint32_t>& polygon) {
  Vec3d mean = Vec3d::Zero();
  for (const std::uint32_t v : polygon) mean += patch.points[v] / double(polygon.size());
  const auto center = std::uint32_t(patch.points.size());
  const std::size_t third = polygon.size() / 3;
  patch.points.push_back(mean);
  patch.parents.push_back({polygon[0], polygon[third], polygon[2 * third]});
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    patch.triangles.push_back({polygon[i], polygon[(i + 1) % polygon.size()], center});
  }
}

}  // namespace

HolePatch triangulate_loop(std::vector<Vec3d> loop, const EdgeTaken& taken) {
  HolePatch patch;
  patch.loop_size = std::uint32_t(loop.size());
  patch.points = std::move(loop);
  const std::vector<std::uint32_t> polygon = CornerCutter(patch.points, taken).run(patch.triangles);
  // There are so many taken edges that no corner can be cut: the rest may still be large.
  const bool small = polygon.size() <= kLargestExact;
  if (!small || !ExactTriangulation(patch.points, polygon, taken).run(patch.triangles)) {
    fan_around_mean(patch, polygon);
  }
  return patch;
}

}  // namespace turnscan::mesh
