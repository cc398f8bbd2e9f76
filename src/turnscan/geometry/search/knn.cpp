#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <stdexcept>
#include <turnscan/core/morton.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/search/knn.hpp>

namespace turnscan {
namespace {

// nanoflann sums its lower bound of a branch in a different order than the distance itself, so that
// a branch with an equal distance can appear farther by some rounding steps.
constexpr float kBoundSlack = 1.0f + 1e-5f;

struct PointStore {
  std::vector<Vec3f> points;       // along a space-filling curve: neighbours share cache lines
  std::vector<std::uint32_t> ids;  // index here -> index outside

  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][Eigen::Index(axis)];
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<float, PointStore, float, std::uint32_t>;
using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, PointStore, 3, std::uint32_t>;

float loosened(float squared_distance) {
  return std::max(squared_distance * kBoundSlack, std::numeric_limits<float>::min());
}

/// The k smallest (distance, id) within reach so far, in order, in the caller's arrays.
class NearestSet {
 public:
  using DistanceType = float;
  NearestSet(const PointStore& store, std::size_t k, std::uint32_t* index, float* distance,
             float squared_reach)
      : store_(store), k_(k), index_(index), distance_(distance), squared_reach_(squared_reach) {}

  std::size_t size() const { return count_; }
  bool full() const { return count_ == k_; }
  void sort() {}  // required by nanoflann 1.5 and later; already in order
  float worstDist() const { return loosened(full() ? distance_[k_ - 1] : squared_reach_); }
  bool addPoint(float distance, std::uint32_t position) {
    if (!(distance <= squared_reach_)) return true;
    const std::uint32_t id = store_.ids[position];
    const auto before = [&](std::size_t i) {
      return distance < distance_[i] || (distance == distance_[i] && id < index_[i]);
    };
    if (full() && !before(k_ - 1)) return true;
    std::size_t i = full() ? k_ - 1 : count_++;
    for (; i > 0 && before(i - 1); --i) {
      distance_[i] = distance_[i - 1];
      index_[i] = index_[i - 1];
    }
    distance_[i] = distance;
    index_[i] = id;
    return true;
  }

 private:
  const PointStore& store_;
  std::size_t k_, count_ = 0;
  std::uint32_t* index_;
  float* distance_;
  float squared_reach_;
};

class WithinRadius {
 public:
  using DistanceType = float;
  WithinRadius(const PointStore& store, float squared_radius,
               std::vector<std::pair<std::uint32_t, float>>& out)
      : store_(store), squared_radius_(squared_radius), out_(out) {}

  std::size_t size() const { return out_.size(); }
  bool full() const { return true; }
  void sort() {}  // done by the caller
  float worstDist() const { return loosened(squared_radius_); }
  bool addPoint(float distance, std::uint32_t position) {
    if (distance <= squared_radius_) out_.emplace_back(store_.ids[position], distance);
    return true;
  }

 private:
  const PointStore& store_;
  float squared_radius_;
  std::vector<std::pair<std::uint32_t, float>>& out_;
};

PointStore sort_along_curve(std::span<const Vec3f> points) {
  Box box;
  for (const Vec3f& p : points) {
    if (p.allFinite()) box.add(p.cast<double>());
  }
  const double longest = std::max(box.size().maxCoeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    const Vec3d cell = (points[i].cast<double>() - box.min) * (2097151.0 / longest);
    order.emplace_back(
        morton_code(std::uint64_t(cell.x()), std::uint64_t(cell.y()), std::uint64_t(cell.z())), i);
  }
  std::sort(order.begin(), order.end());
  PointStore store;
  store.points.reserve(order.size());
  store.ids.reserve(order.size());
  for (const auto& [code, id] : order) {
    store.points.push_back(points[id]);
    store.ids.push_back(id);
  }
  return store;
}

}  // namespace

struct KdTree::Impl {
  explicit Impl(std::span<const Vec3f> points)
      : store(sort_along_curve(points)),
        tree(3, store, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {}
  PointStore store;
  Tree tree;
};

KdTree::KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;
KdTree::~KdTree() = default;

KdTree::KdTree(std::span<const Vec3f> points) {
  if (points.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument("KdTree: more points than 32-bit indices can name");
  }
  impl_ = std::make_unique<Impl>(points);
}

std::size_t KdTree::size() const { return impl_ ? impl_->store.points.size() : 0; }

std::size_t KdTree::knn(const Vec3f& query, std::size_t k, std::uint32_t* index,
                        float* squared_distance, float reach_m) const {
  if (size() == 0 || k == 0 || !query.allFinite() || !(reach_m >= 0.0f)) return 0;
  NearestSet nearest(impl_->store, k, index, squared_distance, reach_m * reach_m);
  impl_->tree.findNeighbors(nearest, query.data(), {});
  return nearest.size();
}

void KdTree::radius(const Vec3f& query, float radius,
                    std::vector<std::pair<std::uint32_t, float>>& out) const {
  out.clear();
  if (size() == 0 || !(radius >= 0.0f) || !std::isfinite(radius) || !query.allFinite()) return;
  WithinRadius within(impl_->store, radius * radius, out);
  impl_->tree.findNeighbors(within, query.data(), {});
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  });
}

}  // namespace turnscan
