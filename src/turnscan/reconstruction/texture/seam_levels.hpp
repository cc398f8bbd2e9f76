#pragma once
// Local brightness and tint corrections of each view, which avoid seams where a view begins.

#include <turnscan/reconstruction/texture/exposure.hpp>

namespace turnscan::texture {

/// Per block and slot: factors of the view's linear light there, per colour channel.
using BlockLevels = std::vector<std::array<Vec3f, kSlots>>;

/// For each view, factors near 1 that vary smoothly over the surface and with which the views of
/// each point agree. They compensate what a gain per view leaves: vignetting, lamps that stand
/// still while the object turns, shadows wider than a cell of this grid. Means are those after gain
/// and shading.
BlockLevels seam_levels(const TexelBlocks& blocks, const ChosenViews& chosen,
                        const BlockMeans& means, std::size_t views);

}  // namespace turnscan::texture
