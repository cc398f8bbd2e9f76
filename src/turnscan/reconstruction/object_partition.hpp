#pragma once
// Partitions the space above a table between several objects.

#include <cstdint>
#include <memory>
#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// The region in which one of the chosen objects is the nearest of all. Copies share one grid.
class ObjectPartition {
 public:
  /// From reconstructed objects in the table frame; there must be at least one and at most 65536,
  /// with vertices. All are chosen.
  explicit ObjectPartition(std::span<const TriangleMesh* const> objects);
  /// The same partition with other objects chosen, by their index.
  ObjectPartition of(std::span<const std::size_t> chosen) const;

  bool contains(const Vec3f& p_table) const;

 private:
  struct Cells;
  std::shared_ptr<const Cells> cells_;
  std::vector<bool> chosen_;
};

}  // namespace turnscan
