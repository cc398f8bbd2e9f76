#include <meshoptimizer.h>

#include <algorithm>
#include <stdexcept>
#include <turnscan/geometry/mesh/pack_mesh.hpp>
#include <vector>

namespace turnscan {

namespace {

std::string as_text(const std::vector<unsigned char>& bytes, std::size_t size) {
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

PackedMesh pack_mesh(std::span<const std::array<std::uint32_t, 3>> triangles,
                     std::span<const std::uint8_t> records, std::size_t stride) {
  if (stride < 4 || stride > 256 || stride % 4 != 0 || records.size() % stride != 0)
    throw std::invalid_argument("pack_mesh: the stride of the records");
  const std::size_t n = records.size() / stride;
  std::vector<unsigned int> indices;
  indices.reserve(3 * triangles.size());
  for (const auto& t : triangles) indices.insert(indices.end(), t.begin(), t.end());
  if (std::any_of(indices.begin(), indices.end(), [n](unsigned int i) { return i >= n; }))
    throw std::invalid_argument("pack_mesh: a triangle names a vertex that is not there");
  PackedMesh packed;
  packed.triangles = triangles.size();
  if (indices.empty()) return packed;
  meshopt_optimizeVertexCacheStrip(indices.data(), indices.data(), indices.size(), n);
  std::vector<unsigned char> ordered(records.size());
  packed.vertices = meshopt_optimizeVertexFetch(ordered.data(), indices.data(), indices.size(),
                                                records.data(), n, stride);
  meshopt_encodeVertexVersion(0);
  meshopt_encodeIndexVersion(1);
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(packed.vertices, stride));
  packed.vertex_stream =
      as_text(bytes, meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), ordered.data(),
                                                packed.vertices, stride));
  bytes.resize(meshopt_encodeIndexBufferBound(indices.size(), packed.vertices));
  packed.index_stream = as_text(
      bytes, meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return packed;
}

}  // namespace turnscan
