#pragma once
// Fills the texels that no view showed, and the gaps between charts.

#include <turnscan/reconstruction/texture/blending.hpp>

namespace turnscan::texture {

/// Unknown texels take colours that diffuse over the surface from their surroundings; gaps in the
/// image take those of the nearest texels. colors are per block and texel.
ColorImage filled_picture(const TriangleMesh& mesh, const TexelBlocks& blocks,
                          const Blended& blended);

/// Share of the covered texels that are unknown.
double filled_share(const TexelBlocks& blocks, const Blended& blended);

}  // namespace turnscan::texture
