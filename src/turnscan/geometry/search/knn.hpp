#pragma once
// Exact nearest neighbours among points in space, with a fixed order of ties.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <turnscan/core/pose.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// A kd-tree over points (metres, any frame). Neighbours are ordered by (squared distance, index),
/// so that the order of equal distances, including duplicates, is well-defined: the result equals
/// that of sorting all points. Squared distances are dx*dx + dy*dy + dz*dz in float32. Points that
/// are not finite keep their index but are never neighbours. Queries may run from many threads.
class KdTree {
 public:
  KdTree();
  /// Copies the points. At most 2^32 - 1 of them (more throw std::invalid_argument).
  explicit KdTree(std::span<const Vec3f> points);
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;
  ~KdTree();

  /// Number of finite points.
  std::size_t size() const;

  /// The k nearest points of query, nearest first, in index[0..k) and squared_distance[0..k)
  /// (metres squared). Returns the number found: min(k, size()), fewer if reach_m bounds their
  /// distance, 0 for a query that is not finite. A query that is one of the points finds itself,
  /// too. A tight bound makes the search faster.
  std::size_t knn(const Vec3f& query, std::size_t k, std::uint32_t* index, float* squared_distance,
                  float reach_m = std::numeric_limits<float>::infinity()) const;

  /// All points with squared distance <= radius * radius, nearest first, as (index, squared
  /// distance); replaces the contents of out. Empty for a radius that is negative or not finite.
  void radius(const Vec3f& query, float radius,
              std::vector<std::pair<std::uint32_t, float>>& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
