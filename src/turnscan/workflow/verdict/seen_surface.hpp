#pragma once
// Which part of a mesh its frames could see.

#include <turnscan/workflow/verdict/frame_residuals.hpp>

namespace turnscan {

/// Some of a mesh's vertices, or all, spread over it.
struct SeenVertices {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint8_t> seen;  ///< 1: by views_needed() of the frames
};

/// By rays, as evaluate() tells what was seen of a reference (simulator/coverage): within 75
/// degrees of the normal, and nothing of the mesh in between. Of more than 256 frames 256, evenly
/// spread, stand for all. Empty for an empty mesh. Fails as frame_poses() and Scene::create() do,
/// and with kCancelled.
Result<SeenVertices> seen_vertices(const TriangleMesh& mesh, const std::vector<MeshFrames>& sources,
                                   const RunContext& context);

}  // namespace turnscan
