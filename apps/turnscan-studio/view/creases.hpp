#pragma once

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::studio {

/// The mesh with a normal per vertex, for drawing: vertices at which faces meet at more than
/// `angle_rad` are duplicated, each copy with the mean normal of the faces on its side of the
/// crease, so that edges look sharp. Vertices keep their order; new ones are appended.
TriangleMesh split_at_creases(const TriangleMesh& mesh, double angle_rad);

}  // namespace turnscan::studio
