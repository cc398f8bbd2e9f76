#pragma once
// The built-in objects that have a source of their own.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::objects {

/// Closed meshes with normals and vertex colours; see builtin_objects.hpp. They fail with
/// kCancelled.
Result<TriangleMesh> make_doll(const RunContext& context);
Result<TriangleMesh> make_scorpion(const RunContext& context);
Result<TriangleMesh> make_skull(const RunContext& context);
Result<TriangleMesh> make_action_figure(const RunContext& context);
Result<TriangleMesh> make_robed_figure(const RunContext& context);

/// The artefacts to test a rig with.
TriangleMesh make_ball();
TriangleMesh make_ball_bar();
TriangleMesh make_plate();

}  // namespace turnscan::objects
