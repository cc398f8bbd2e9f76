#pragma once
// The shape of the built-in skull.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::objects {

/// Closed mesh with normals and vertex colours; see Skull in builtin_objects.hpp. Fails with
/// kCancelled.
Result<TriangleMesh> make_skull(const RunContext& context);

}  // namespace turnscan::objects
