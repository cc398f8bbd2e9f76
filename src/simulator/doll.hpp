#pragma once
// The shape of the built-in doll (private to the simulator).

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// Closed mesh with normals and vertex colours; see Doll in builtin_objects.hpp.
TriangleMesh make_doll();

}  // namespace turnscan
