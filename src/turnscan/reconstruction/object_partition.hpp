#pragma once
// Several objects on a table: which part of the space above it belongs to which.

#include <cstdint>
#include <memory>
#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Where one of the chosen objects is the nearest of all. Copies share one grid.
class ObjectPartition {
 public:
  /// Of objects as they were reconstructed, table frame; there must be some, with vertices, and at
  /// most 65536. All are chosen.
  explicit ObjectPartition(std::span<const TriangleMesh* const> objects);
  /// The same with other objects chosen, by their number.
  ObjectPartition of(std::span<const std::size_t> chosen) const;

  bool contains(const Vec3f& p_table) const;

 private:
  struct Cells;
  std::shared_ptr<const Cells> cells_;
  std::vector<bool> chosen_;
};

}  // namespace turnscan
