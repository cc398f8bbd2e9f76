#pragma once

#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh {

/// The vertices that share an edge with each vertex.
class VertexNeighbours {
 public:
  explicit VertexNeighbours(const TriangleMesh& mesh);

  std::span<const std::uint32_t> of(std::uint32_t v) const {
    return std::span(neighbours_).subspan(start_[v], start_[v + 1] - start_[v]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> neighbours_;
};

}  // namespace turnscan::mesh
