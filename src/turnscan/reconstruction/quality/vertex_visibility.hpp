#pragma once
// Which frames saw each vertex of a mesh, and from how many sides.

#include <cstdint>
#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::quality {

/// Sectors of a full turn that count as directions, in each of three bands of elevation.
inline constexpr int kSectors = 12, kBands = 3;

/// Per vertex.
struct VertexVisibility {
  std::vector<std::uint16_t> frames;     ///< that measured its neighbourhood
  std::vector<std::uint8_t> directions;  ///< sectors from which they did, in the table frame
};

/// A view saw a vertex when it faces the sensor by less than 84 degrees and the depth at its pixel
/// is that of the vertex within tolerance_m along the normal. Of many views 128, evenly spread, are
/// looked at and stand for the others. Fails with kCancelled. The same result for any number of
/// threads.
Result<VertexVisibility> vertex_visibility(const TriangleMesh& mesh,
                                           std::span<const views::DepthView> views,
                                           double tolerance_m, const RunContext& context);

/// Which vertices sensors looked at in vain: of the views that they face by less than 66 degrees at
/// least half, and three or more, had no return there, and nothing before them. Only those marked
/// in `asked` are looked at, in as many views as above. Fails with kCancelled. The same for any
/// number of threads.
Result<std::vector<std::uint8_t>> without_return(const TriangleMesh& mesh,
                                                 std::span<const views::DepthView> views,
                                                 const std::vector<std::uint8_t>& asked,
                                                 const RunContext& context);

}  // namespace turnscan::quality
