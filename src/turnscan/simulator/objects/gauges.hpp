#pragma once
// Artefacts of known shape, to test a rig with.

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::objects {

TriangleMesh make_ball();
TriangleMesh make_ball_bar();
TriangleMesh make_plate();

}  // namespace turnscan::objects
