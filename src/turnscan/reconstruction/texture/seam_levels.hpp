#pragma once
// Brightness and tint of each view, place by place, so that nothing jumps where a view begins.

#include <turnscan/reconstruction/texture/exposure.hpp>

namespace turnscan::texture {

/// Per block and slot: what the view's linear light is multiplied by there, by colour.
using BlockLevels = std::vector<std::array<Vec3f, kSlots>>;

/// For each view factors that vary smoothly over the surface, near 1, with which the views of each
/// place agree. They take out what a gain per view leaves: vignetting, lamps that stand still while
/// the object turns, shadows wider than a cell of this. Means are those after gain and shading.
BlockLevels seam_levels(const TexelBlocks& blocks, const ChosenViews& chosen,
                        const BlockMeans& means, std::size_t views);

}  // namespace turnscan::texture
