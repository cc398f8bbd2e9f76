#pragma once
// Which part of a mesh its frames could see.

#include <turnscan/workflow/verdict/frame_residuals.hpp>

namespace turnscan {

/// All vertices of a mesh, or a subset spread over it.
struct SeenVertices {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint8_t> seen;  ///< 1: frames tell kSeenInformation of it
};

/// Determined by rays, as evaluate() determines the seen part of a reference
/// (geometry/rays/coverage.hpp): within 75 degrees of the normal, and not occluded by the mesh. Of
/// more than 256 frames an evenly spaced subset of 256 is used. Empty for an empty mesh. Fails as
/// frame_poses() and Scene::create() do, and with kCancelled.
Result<SeenVertices> seen_vertices(const TriangleMesh& mesh, const std::vector<MeshFrames>& sources,
                                   const RunContext& context);

}  // namespace turnscan
