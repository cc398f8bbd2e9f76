#pragma once
// A textured mesh in the colours of the views that its texture came from.

#include <turnscan/reconstruction/result.hpp>

#include "explorer/scan_quality.hpp"

namespace turnscan::studio {

/// Each square of texels in the colour of the view that gave it most of its own; grey where none
/// did. The legend lists the views with the largest shares, by their frames and the directions
/// they look from. Without the report's squares, or without a texture on the mesh, no drawable.
ColoredMesh color_by_view(const TriangleMesh& mesh, const TextureReport& report);

}  // namespace turnscan::studio
