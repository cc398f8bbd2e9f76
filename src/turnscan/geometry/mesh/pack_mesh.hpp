#pragma once
// Meshes in few bytes, for a page that is sent.

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace turnscan {

/// Streams of meshoptimizer's codecs (vertex version 0, index version 1), which every decoder of
/// it reads, three.js's among them.
struct PackedMesh {
  std::size_t vertices = 0, triangles = 0;
  std::string vertex_stream, index_stream;
};

/// Vertices and triangles are ordered anew, so that neighbours follow each other; vertices that no
/// triangle names are left out. records: `stride` bytes a vertex. Throws std::invalid_argument when
/// stride is not a multiple of 4 from 4 to 256, or a triangle names a vertex that is not there.
/// Deterministic.
PackedMesh pack_mesh(std::span<const std::array<std::uint32_t, 3>> triangles,
                     std::span<const std::uint8_t> records, std::size_t stride);

}  // namespace turnscan
