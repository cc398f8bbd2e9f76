#pragma once
// Colours a textured mesh by the views that contributed to its texture.

#include <turnscan/reconstruction/result.hpp>

#include "explorer/scan_quality.hpp"

namespace turnscan::studio {

/// Each square of texels gets the colour of the view that contributed most to it; grey if none did.
/// The legend lists the views with the largest shares, with their frames and viewing directions. No
/// drawable if the report has no squares, or the mesh no texture.
ColoredMesh color_by_view(const TriangleMesh& mesh, const TextureReport& report);

}  // namespace turnscan::studio
