#pragma once
// The picture of a mesh out of its texels: what no view showed, and the gaps between charts.

#include <turnscan/reconstruction/texture/blending.hpp>

namespace turnscan::texture {

/// Texels that are not known take colours that spread over the surface from around them; the
/// picture's gaps those of the nearest texels. colors are per block and texel.
ColorImage filled_picture(const TriangleMesh& mesh, const TexelBlocks& blocks,
                          const Blended& blended);

/// Share of the covered texels that are not known.
double filled_share(const TexelBlocks& blocks, const Blended& blended);

}  // namespace turnscan::texture
