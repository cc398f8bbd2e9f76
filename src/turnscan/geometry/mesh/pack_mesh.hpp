#pragma once
// Compact encoding of meshes for transmission.

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace turnscan {

/// Streams of meshoptimizer's codecs (vertex version 0, index version 1), which all of its decoders
/// read, including three.js's.
struct PackedMesh {
  std::size_t vertices = 0, triangles = 0;
  std::string vertex_stream, index_stream;
};

/// Reorders vertices and triangles for locality; unreferenced vertices are dropped. records:
/// `stride` bytes per vertex. Throws std::invalid_argument if stride is not a multiple of 4 from 4
/// to 256, or a triangle references a vertex that does not exist. Deterministic.
PackedMesh pack_mesh(std::span<const std::array<std::uint32_t, 3>> triangles,
                     std::span<const std::uint8_t> records, std::size_t stride);

}  // namespace turnscan
