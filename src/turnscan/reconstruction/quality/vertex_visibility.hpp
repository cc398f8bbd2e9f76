#pragma once
// Frames that saw each vertex of a mesh, and the number of their directions.

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
  std::vector<std::uint16_t> frames;     ///< number that measured its neighbourhood
  std::vector<std::uint8_t> directions;  ///< number of sectors from which they did, in the table
                                         ///< frame
};

/// A view saw a vertex if its incidence angle is below 84 degrees and the depth at its pixel is
/// that of the vertex within tolerance_m along the normal. Of many views 128, evenly spread, are
/// examined and represent the others. Fails with kCancelled. The result does not depend on the
/// number of threads.
Result<VertexVisibility> vertex_visibility(const TriangleMesh& mesh,
                                           std::span<const views::DepthView> views,
                                           double tolerance_m, const RunContext& context);

/// What sensors returned from a vertex: kNothing if of the views with incidence angles below 66
/// degrees at least half, and at least three, had no return there, and no occluder before them;
/// kTooNear if for half of these it would lie nearer than anything that any view measured.
enum class NoReturn : std::uint8_t { kNone, kNothing, kTooNear };

/// Only the vertices marked in `asked` are examined, in as many views as above. Fails with
/// kCancelled. The result does not depend on the number of threads.
Result<std::vector<NoReturn>> without_return(const TriangleMesh& mesh,
                                             std::span<const views::DepthView> views,
                                             const std::vector<std::uint8_t>& asked,
                                             const RunContext& context);

/// Smallest depth that any of the views measured, in metres; 0 if it is not known.
float nearest_depth_m(std::span<const views::DepthView> views);

}  // namespace turnscan::quality
