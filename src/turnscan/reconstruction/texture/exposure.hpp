#pragma once
// Exposure and white balance of each view.

#include <turnscan/reconstruction/texture/texel_samples.hpp>

namespace turnscan::texture {

/// Mean colour (linear light) of each slot of each block; negative where it does not show the whole
/// block.
using BlockMeans = std::vector<std::array<Vec3f, kSlots>>;
BlockMeans block_means(const TexelBlocks& blocks, const ChosenViews& chosen,
                       const TexelSamples& samples);

/// Whether it is neither so dark nor so bright that its ratio to another one says nothing.
bool tells_of_exposure(const Vec3f& mean);

/// By what the red, green and blue (linear light) of each view are multiplied so that views agree
/// where they show the same: least squares of logarithms over all pairs of views, outliers weighed
/// down. The more the pairs contradict each other, the nearer gains stay to 1. Views that share
/// nothing with others stay as they are.
std::vector<Vec3f> solve_gains(const ChosenViews& chosen, const BlockMeans& means,
                               std::size_t views);

}  // namespace turnscan::texture
