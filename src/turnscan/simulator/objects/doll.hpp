#pragma once
// The shape of the built-in doll.

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::objects {

/// Closed mesh with normals and vertex colours; see Doll in builtin_objects.hpp.
TriangleMesh make_doll();

}  // namespace turnscan::objects
