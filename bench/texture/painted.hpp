#pragma once
// An object with a texture that nobody made with turnscan's views: painted in space.

#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::bench {

/// sRGB of the paint at a place, metres: bands, dots and grain of about a millimetre and more.
Vec3f paint_at(const Vec3f& p);

/// Gives the mesh a texture of that paint. Fails as make_atlas().
Result<> paint(TriangleMesh& mesh, int size_px);

}  // namespace turnscan::bench
